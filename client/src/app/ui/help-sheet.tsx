import type { Studio } from "../studio";
import { Sheet } from "./sheet";

type Line = readonly [string, string];

const DRAWING: readonly Line[] = [
  ["One finger, pen, left button", "Brush: the tree grows into the stroke"],
  ["Begin on a branch", "Draw at that branch’s depth"],
  ["Rest the finger", "Growth goes on under it"],
  ["Radius at the bottom", "Sketch: one limb, exactly along the stroke"],
  ["Lasso", "Draw an outline: the tree grows to fill it"],
  ["Press and hold a branch, or Alt click", "Only this branch grows, until you hold elsewhere"],
  ["Plant a seed", "Tap the ground; trees shade and crowd each other"],
  ["Scene", "Walls and models to grow around; drag them"],
];

const SHAPING: readonly Line[] = [
  ["Bend", "One finger holds the base, another drags the end, more between"],
  ["Bend with a mouse or pen", "Drag a branch; click first where it shall bend from"],
  ["Width", "Pinch around a limb, or tap it and pull the ring"],
  ["Prune", "Tap a branch, or draw a line through many"],
  ["Branch", "Drag turns it about its base, a second finger or the wheel twists; then move or copy it"],
  ["What if?", "A ghost shows how the tree grows on without a branch"],
  ["Double tap, double click a branch", "Cut it off, without leaving the brush"],
];

const TRAVELLING: readonly Line[] = [
  ["Drag along the strip at the bottom", "Travel through growth and edits, back and forth"],
  ["Tap a sign on it", "Go to where that was done"],
  ["A fork above it", "Other futures: what was ahead when someone went back"],
];

const LOOKING: readonly Line[] = [
  ["Two fingers, middle button", "Move and zoom"],
  ["Three fingers, right button", "Turn around the tree"],
  ["Grow, pushed up or pulled down", "Grow on alone, or backwards"],
];

const KEYS: readonly Line[] = [
  ["[  ]", "Narrower, wider"],
  ["B  L  P", "Brush, lasso, plant a seed"],
  ["N  W  X", "Bend, width, prune"],
  ["Esc", "Cancel, let go"],
  ["G  U", "Grow, ungrow while held"],
  [",  .", "A step back, forth; with Shift an operation"],
  ["T  ← ↑ → ↓", "Hold a branch, turn it; with Shift about itself"],
  ["F", "Show the whole tree"],
  ["Ctrl Z", "Undo, with Shift redo"],
  ["Space", "Held: drag to move"],
  ["Alt wheel", "Radius; twists a branch that is held"],
];

/** The gestures and keys on one card, and the few settings. */
export function HelpSheet({ studio }: { studio: Studio }) {
  const { side, pressureWidens } = studio.settings;
  return (
    <Sheet studio={studio} title="How to draw a tree" wide>
      <div class="help">
        <div>
          <Gestures lines={DRAWING} />
          <Gestures lines={SHAPING} />
        </div>
        <div>
          <Gestures lines={LOOKING} />
          <Gestures lines={TRAVELLING} />
          <dl class="keys">
            {KEYS.map(([keys, effect]) => (
              <div key={keys}>
                <dt>
                  <kbd>{keys}</kbd>
                </dt>
                <dd>{effect}</dd>
              </div>
            ))}
          </dl>
        </div>
      </div>
      <div class="options">
        <fieldset class="segments">
          <legend>Tools at the</legend>
          {(["left", "right"] as const).map((choice) => (
            <label key={choice}>
              <input
                type="radio"
                name="side"
                checked={side.value === choice}
                onChange={() => {
                  side.value = choice;
                }}
              />
              <span>{choice}</span>
            </label>
          ))}
        </fieldset>
        <label class="switch">
          <input
            type="checkbox"
            checked={pressureWidens.value}
            onChange={(event) => {
              pressureWidens.value = event.currentTarget.checked;
            }}
          />
          <span>Pen pressure widens the brush</span>
        </label>
      </div>
    </Sheet>
  );
}

function Gestures({ lines }: { lines: readonly Line[] }) {
  return (
    <dl>
      {lines.map(([gesture, effect]) => (
        <div key={gesture}>
          <dt>{gesture}</dt>
          <dd>{effect}</dd>
        </div>
      ))}
    </dl>
  );
}
