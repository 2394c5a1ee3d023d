import { effect, type ReadonlySignal, signal } from "@preact/signals";
import type { Vec3 } from "../../../scene/vector";
import type { Command, GrammarBody, GrammarInForce } from "../../../wire/generated";
import type { OutlineTrace } from "../../tools/lasso/outline-trace";
import type { ToolName } from "../../tools/tools";

export interface SpacePage {
  readonly inForce: ReadonlySignal<GrammarInForce | null>;
  readonly outline: OutlineTrace;
  readonly chosen: ReadonlySignal<ToolName>;
  readonly choose: (tool: ToolName) => void;
  readonly submit: (command: Command) => number;
}

/** The space that the grammar in force may fill: drawn with the lasso, and taken away again. */
export class GrammarSpace {
  /** Whether the next outline on the picture is the space. */
  readonly drawing = signal(false);
  readonly #page: SpacePage;
  #before: ToolName | null = null;
  #stopWatching = () => {};

  constructor(page: SpacePage) {
    this.#page = page;
  }

  /** The next outline is the space. */
  draw(): void {
    const { inForce, outline, chosen, choose, submit } = this.#page;
    const at = inForce.peek()?.at;
    if (at === undefined || this.drawing.peek()) {
      return;
    }
    this.#before = chosen.peek();
    choose("lasso");
    outline.taker = {
      through: at,
      take: (within) => {
        this.stop();
        submit({ kind: "set_grammar_body", within });
      },
    };
    this.drawing.value = true;
    // Who takes another tool wants something else.
    this.#stopWatching = effect(() => {
      if (chosen.value !== "lasso") {
        this.#before = null;
        this.stop();
      } else if (inForce.value === null) {
        this.stop();
      }
    });
  }

  /** No outline is waited for any more; the tool of before is taken up again. */
  stop(): void {
    this.#stopWatching();
    this.#stopWatching = () => {};
    this.#page.outline.taker = null;
    this.drawing.value = false;
    const before = this.#before;
    this.#before = null;
    if (before !== null && before !== this.#page.chosen.peek()) {
      this.#page.choose(before);
    }
  }

  /** All space is the plant's again. */
  clear(): void {
    this.#page.submit({ kind: "set_grammar_body" });
  }
}

/** The outline of a body as places in the world. */
export function outlineOf({ outline, plane: { origin, right, up } }: GrammarBody): Vec3[] {
  return outline.map(([x, y]) => [
    origin[0] + x * right[0] + y * up[0],
    origin[1] + x * right[1] + y * up[1],
    origin[2] + x * right[2] + y * up[2],
  ]);
}

/** Whether a place on the plane of a body's outline lies in the outline. */
export function surrounds({ outline, plane: { origin, right, up } }: GrammarBody, place: Vec3): boolean {
  const along = (axis: readonly [number, number, number]) =>
    (place[0] - origin[0]) * axis[0] + (place[1] - origin[1]) * axis[1] + (place[2] - origin[2]) * axis[2];
  const [x, y] = [along(right), along(up)];
  let inside = false;
  outline.forEach(([x1, y1], i) => {
    const [x2, y2] = outline[(i + 1) % outline.length]!;
    if (y1 > y !== y2 > y && x < x1 + ((y - y1) / (y2 - y1)) * (x2 - x1)) {
      inside = !inside;
    }
  });
  return inside;
}
