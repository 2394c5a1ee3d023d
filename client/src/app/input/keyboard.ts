import { type ShownName, shownOfKey } from "../../scene/mode/shown";
import { type ToolName, toolOfKey } from "../tools/tools";

/** What the keyboard can do. */
export interface KeyActions {
  undo(): void;
  redo(): void;
  fit(): void;
  help(): void;
  /** Hides everything but the workspace, or brings it back. */
  bare(): void;
  /** Shows the tree in the next way there is, or the one before. */
  drawMode(direction: -1 | 1): void;
  /** Switches a part of how the picture is drawn, or all of them back. */
  shown(name: ShownName | null): void;
  tool(tool: ToolName): void;
  escape(): void;
  widen(notches: number): void;
  /** Goes on to the next kind of symmetry. */
  symmetry(): void;
  /** Turns what is held, in small steps: sideways, up, or about itself; false if nothing is. */
  turn(right: number, up: number, twist: number): boolean;
  /** Travels so many steps in time, or (`edge`) to where an operation begins or ends. */
  travel(direction: -1 | 1, edge: boolean): void;
  /** 1 grows, −1 takes back, 0 rests. */
  grow(direction: -1 | 0 | 1): void;
  /** Whether a sheet is open, which then has the keys. */
  busy(): boolean;
}

const ARROWS: Record<string, readonly [number, number]> = {
  arrowleft: [-1, 0],
  arrowright: [1, 0],
  arrowup: [0, 1],
  arrowdown: [0, -1],
};

/** Where the signs for back and forth in time are on most keyboards, whatever Shift makes of them. */
const TIME_KEYS: Record<string, -1 | 1> = { Comma: -1, Period: 1 };
const TIME_SIGNS: Record<string, -1 | 1> = { ",": -1, "<": -1, ".": 1, ">": 1 };

/** Listens to the keyboard; `panHeld` says whether the space bar is down. */
export function listenToKeys(actions: KeyActions): { panHeld(): boolean; stop(): void } {
  let space = false;
  let growing: string | null = null;
  const stop = new AbortController();

  const rest = () => {
    space = false;
    if (growing !== null) {
      growing = null;
      actions.grow(0);
    }
  };
  const press = (event: KeyboardEvent) => {
    if (actions.busy() || typing(event.target) || event.defaultPrevented) {
      return;
    }
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      if (key === "z" || key === "y") {
        event.preventDefault();
        (key === "y" || event.shiftKey ? actions.redo : actions.undo)();
      }
      return;
    }
    const [right, up] = ARROWS[key] ?? [0, 0];
    if ((right !== 0 || up !== 0) && !takesArrows(event.target)) {
      if (actions.turn(event.shiftKey ? 0 : right, up, event.shiftKey ? right : 0)) {
        event.preventDefault();
      }
      return;
    }
    switch (key) {
      case " ":
        if (!takesSpace(event.target)) {
          space = true;
          event.preventDefault();
        }
        break;
      case "g":
      case "u":
        if (!event.repeat && growing === null) {
          growing = key;
          actions.grow(key === "g" ? 1 : -1);
        }
        break;
      case "[":
        actions.widen(-1);
        break;
      case "]":
        actions.widen(1);
        break;
      case "escape":
        actions.escape();
        break;
      case "f":
        actions.fit();
        break;
      case "d":
        actions.drawMode(event.shiftKey ? -1 : 1);
        break;
      case "h":
        actions.bare();
        break;
      case "y":
        if (!event.repeat) {
          actions.symmetry();
        }
        break;
      case "?":
        actions.help();
        break;
      default: {
        const tool = toolOfKey(key);
        const shown = shownOfKey(key);
        if (tool) {
          actions.tool(tool);
        } else if (shown || key === "0") {
          if (!event.repeat && !event.altKey) {
            actions.shown(shown);
          }
        } else {
          travel(event, actions);
        }
      }
    }
  };
  const release = (event: KeyboardEvent) => {
    const key = event.key.toLowerCase();
    if (key === " ") {
      space = false;
    } else if (key === growing) {
      rest();
    }
  };
  addEventListener("keydown", press, { signal: stop.signal });
  addEventListener("keyup", release, { signal: stop.signal });
  // A window that loses the focus never hears of the key's release.
  addEventListener("blur", rest, { signal: stop.signal });
  return { panHeld: () => space, stop: () => stop.abort() };
}

/** The character gives the direction; where Shift or Alt has changed the character, the place of the key does. */
function travel({ key, code, shiftKey, altKey }: KeyboardEvent, actions: KeyActions): void {
  const placed = shiftKey || altKey ? TIME_KEYS[code] : undefined;
  const direction = TIME_SIGNS[key] ?? placed;
  if (direction !== undefined) {
    // A sign that takes Shift to type, as "." does on a French keyboard, means a step all the same.
    actions.travel(direction, altKey || placed === direction || key === "<" || key === ">");
  }
}

/** Whether the arrow keys already mean something there: a slider, a choice, a list. */
function takesArrows(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) {
    return target.type !== "checkbox";
  }
  return target instanceof HTMLElement && (target.localName === "select" || target.getAttribute("role") === "slider");
}

/** Whether the space bar already means something there: it presses a button, flips a switch, unfolds a section. */
function takesSpace(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) {
    return target.type !== "range";
  }
  return target instanceof HTMLElement && ["button", "summary", "select", "a"].includes(target.localName);
}

/** Whether letters go into a text there. */
export function typing(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) {
    // A slider or a switch takes no letters.
    return ["text", "number", "search"].includes(target.type);
  }
  return target instanceof HTMLTextAreaElement;
}
