import { effect } from "@preact/signals";
import { nextDrawMode } from "../scene/mode/draw-mode";
import { blows } from "../scene/motion/air-settings";
import { Viewport } from "../scene/viewport";
import { deflectionFor, KEY_RATE } from "./document/growth/grow-pacer";
import { listenToKeys } from "./input/keyboard";
import { listenToPointers } from "./input/pointer-source";
import { StrokesAsTurns } from "./input/strokes-as-turns";
import { publishFacts } from "./page/page-facts";
import { followPageLife } from "./page/page-life";
import type { Studio } from "./studio";
import { stepRadius } from "./tools/brush/brush-radius";
import { stepBack } from "./tools/step-back";
import { nextKind } from "./tools/symmetry/symmetry";
import { symmetryText } from "./tools/symmetry/symmetry-text";
import { SHOWN_SWITCH, SLOWNESS, WIND } from "./ui/parts";
import { PictureLoss } from "./view/picture-loss";
import { say } from "./words/say";

/** So many of the wheel's notches are one doubling of what it changes, roughly. */
const NOTCHES = 8;
/** How far an arrow key turns the tree, in radians. */
const KEY_TURN = (5 * Math.PI) / 180;

/** Takes the canvas into use: picture, pointers and keys; returns what releases it. */
export function attachWorkspace(studio: Studio, canvas: HTMLCanvasElement): () => void {
  const loss = new PictureLoss(studio.hindrance);
  let viewport: Viewport;
  try {
    viewport = new Viewport(
      canvas,
      studio.table,
      loss.tell,
      () => studio.stage.moved(),
      (cardless) => {
        studio.slowness.value = cardless ? "cardless" : "tree";
      },
      () => {
        studio.stage.opened.value = true;
      },
      () => SLOWNESS.load(),
    );
  } catch (error) {
    console.error(error);
    studio.stage.darken();
    studio.hindrance.value = "no-webgl";
    return () => {};
  }
  viewport.onPaintLost(() => studio.toasts.show(say("notices.paint-lost")));
  studio.stage.attach(viewport, canvas);
  studio.branches.attach(viewport);
  studio.tools.attach(viewport);
  const keys = followKeys(studio);
  const stopPointers = followPointers(studio, canvas, keys.panHeld);
  const stopPublishing = effect(() => publishFacts(studio));
  const stopLeaves = effect(() => {
    const parameters = studio.parameters.value;
    if (parameters !== null) {
      viewport.setLeafSize(parameters.leaf_size);
    }
  });
  const stopDyes = effect(() => viewport.setDyes(studio.design.dyed.value));
  const stopLooks = effect(() => studio.stage.setAppearance(studio.appearance.value));
  // The wind is loaded when it first blows, whoever has set it.
  const stopWaiting = effect(() => {
    if (blows(studio.appearance.value.wind)) {
      void WIND.load().then(() => WIND.content.peek()?.(studio));
    }
  });
  const stopThorough = effect(() => viewport.setThorough(studio.settings.thorough.value));
  const stopDrawMode = effect(() => studio.stage.show(studio.drawMode.value, studio.settings.shown.value));
  const stopFollowing = effect(() => {
    if (studio.document.value) {
      studio.stage.follow();
    }
  });
  const stopScene = effect(() => {
    const chosen = studio.layout.panel.value === "scene" ? studio.obstacles.chosen.value : null;
    viewport.showObstacles(studio.obstacles.drawn.value, chosen);
  });
  const stopLife = followPageLife(studio.link);
  return () => {
    stopLife();
    stopScene();
    stopFollowing();
    stopLeaves();
    stopDyes();
    stopLooks();
    stopWaiting();
    stopThorough();
    stopDrawMode();
    stopPublishing();
    stopPointers();
    keys.stop();
    studio.link.leave();
    studio.tools.detach();
    studio.bends.detach();
    studio.branches.detach();
    studio.stage.detach();
    viewport.dispose();
    loss.stop();
  };
}

function followKeys(studio: Studio): ReturnType<typeof listenToKeys> {
  /** Says to somebody who only looks that a key changes trees. */
  const mayChange = () => {
    const may = studio.rights.mayChange.peek();
    if (!may) {
      studio.toasts.show(say("notices.looking-only"));
    }
    return may;
  };
  return listenToKeys({
    undo: () => studio.undo.undo(),
    redo: () => studio.undo.redo(),
    fit: () => studio.stage.fitTree(),
    help: () => {
      studio.layout.sheet.value = "help";
    },
    drawMode: (direction) => {
      studio.drawMode.value = nextDrawMode(studio.drawMode.peek(), direction);
    },
    shown: (name) => void SHOWN_SWITCH.load().then(() => SHOWN_SWITCH.content.peek()?.(studio, name)),
    bare: () => {
      studio.layout.bare.value = !studio.layout.bare.peek();
    },
    tool: (tool) => mayChange() && studio.tools.choose(tool),
    escape: () => stepBack(studio),
    widen: (notches) => studio.stage.setRadius(stepRadius(studio.stage.radius, notches)),
    symmetry: () => {
      if (!mayChange()) {
        return;
      }
      const { symmetry } = studio.settings;
      symmetry.value = { ...symmetry.peek(), kind: nextKind(symmetry.peek().kind) };
      studio.toasts.show(symmetryText(symmetry.peek()));
    },
    turn: (right, up, twist) => studio.branches.step(right, up, twist) || turnTree(studio, right),
    travel: (direction, edge) => (edge ? studio.time.toEdge(direction) : studio.time.by(direction)),
    grow: (direction) => {
      if (direction === 0) {
        studio.growth.release();
      } else if (mayChange()) {
        studio.growth.to(direction * deflectionFor(KEY_RATE));
      }
    },
    busy: () => studio.layout.sheet.peek() !== null,
  });
}

/** While no branch is held the arrow keys turn the tree; false where they mean nothing. */
function turnTree(studio: Studio, right: number): boolean {
  if (right !== 0) {
    studio.stage.turn(right * KEY_TURN);
  }
  return right !== 0;
}

function followPointers(studio: Studio, canvas: HTMLCanvasElement, panHeld: () => boolean): () => void {
  const turns = new StrokesAsTurns();
  const mayChange = () => studio.rights.mayChange.peek();
  return listenToPointers(canvas, {
    gesture: (gesture) => {
      studio.stage.radiusSeen();
      const { hands } = studio.design;
      const meant = hands ? hands(gesture) : mayChange() ? gesture : turns.seen(gesture);
      if (meant !== null) {
        studio.tools.gesture(meant);
      }
    },
    doubles: () => mayChange() && !studio.design.hands && studio.tools.doubles(),
    loading: () => (mayChange() ? studio.tools.loading() : null),
    grip: (x, y) => (studio.design.hands ? null : studio.tools.grip(x, y)),
    hover: (place) => studio.tools.hover(mayChange() && !studio.design.hands ? place : null),
    widen: (factor) => {
      const notches = Math.log(factor) * NOTCHES;
      if (!studio.branches.step(0, 0, notches)) {
        studio.stage.setRadius(stepRadius(studio.stage.radius, notches));
      }
    },
    panHeld,
    holdable: (x, y) => !studio.design.hands && studio.tools.holdable(x, y),
  });
}
