import type { Tablet } from "./tablet";

/** The side of the smallest square that a finger hits, in pixels. */
const TARGET = 44;

/**
 * Presses the middle of every control of the page, or of the part that `within` names, and says which press hit
 * something else; by touch also which control is smaller than a finger needs. No control does anything meanwhile.
 * Without `press`, for moments at which a finger is down already, it only asks the page what lies there.
 */
export async function misses(tablet: Tablet, where: string, within = "body", press = true): Promise<string[]> {
  await tablet.untilCome();
  const faults: string[] = [];
  const count = await tablet.page.evaluate(collect, within);
  try {
    if (count === 0) faults.push(`${where}: no control in ${within}`);
    for (let i = 0; i < count; i++) {
      const aimed = await tablet.page.evaluate(aim, { i, reach: tablet.touches ? TARGET : 0 });
      // A note that has had its time.
      if (aimed === null) continue;
      const { control, x, y, missed } = aimed;
      faults.push(...missed.map((fault) => `${where}: ${control}: ${fault}`));
      if (!press) continue;
      await tablet.touch("touchStart", [{ x, y }]);
      await tablet.touch("touchEnd", []);
      const hit = await tablet.page.evaluate(() => globalThis.hits?.pressed ?? "nothing that the page is told of");
      if (hit !== "") faults.push(`${where}: ${control}: a press at ${x}, ${y} hits ${hit}`);
    }
  } finally {
    await tablet.page.evaluate(() => globalThis.hits?.stop());
  }
  return faults;
}

declare global {
  /** What the page keeps while its controls are pressed. */
  var hits:
    | {
        readonly controls: HTMLElement[];
        aimed: HTMLElement | null;
        /** What the last press hit instead of what was aimed at; empty if it hit that, null if there was none. */
        pressed: string | null;
        readonly isHit: (control: HTMLElement, at: EventTarget | null) => boolean;
        readonly name: (element: EventTarget | null) => string;
        stop(): void;
      }
    | undefined;
}

/** In the page: notes all controls that are shown, keeps presses from them, and gives their number. */
function collect(within: string): number {
  const selector =
    ":is(button, a[href], input, select, textarea, summary, [role=slider], [role=tab], [role=radio], [role=button])";
  const controls = [...document.querySelectorAll<HTMLElement>(`:is(${within}) ${selector}`)].filter((control) => {
    // A field for a file is opened by the button beside it.
    if (control instanceof HTMLInputElement && control.type === "file") return false;
    return control.checkVisibility() && control.getClientRects().length > 0;
  });
  const stopped = new AbortController();
  const swallow = (event: Event) => {
    const hits = globalThis.hits;
    if (event.type === "pointerdown" && hits?.aimed) {
      hits.pressed = hits.isHit(hits.aimed, event.target) ? "" : hits.name(event.target);
    }
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  const kinds = ["pointerdown", "pointermove", "pointerup", "mousedown", "mouseup", "click", "dblclick"];
  for (const kind of [...kinds, "touchstart", "touchmove", "touchend", "contextmenu"]) {
    addEventListener(kind, swallow, { capture: true, passive: false, signal: stopped.signal });
  }
  globalThis.hits = {
    controls,
    aimed: null,
    pressed: null,
    isHit: (control, at) => {
      if (!(at instanceof Element)) return false;
      const label = at.closest("label");
      return control.contains(at) || label?.control === control;
    },
    name: (element) => {
      if (!(element instanceof Element)) return "nothing";
      const words = element.getAttribute("aria-label") ?? element.textContent ?? "";
      return `${element.localName}.${element.getAttribute("class")} “${words.trim().slice(0, 40)}”`;
    },
    stop: () => stopped.abort(),
  };
  return controls.length;
}

/** In the page: brings a control into view, says where its middle is, and what lies over it there or within reach; null if it is gone. */
function aim({ i, reach }: { i: number; reach: number }) {
  const hits = globalThis.hits!;
  const control = hits.controls[i]!;
  if (!control.isConnected) return null;
  const isOption = control instanceof HTMLInputElement && ["radio", "checkbox"].includes(control.type);
  // What is drawn of an option is its label.
  const drawn = (isOption && control.closest("label")) || control;
  drawn.scrollIntoView({ block: "center", inline: "center", behavior: "instant" });
  const { left, top, width, height } = drawn.getBoundingClientRect();
  const [x, y] = [left + width / 2, top + height / 2];
  hits.aimed = control;
  hits.pressed = null;
  const missed: string[] = [];
  const probe = (dx: number, dy: number, what: string) => {
    const at = document.elementFromPoint(x + dx, y + dy);
    if (!hits.isHit(control, at))
      missed.push(`${what} is ${hits.name(at)} (${width.toFixed(1)} × ${height.toFixed(1)})`);
  };
  probe(0, 0, "at its middle");
  if (reach > 0) {
    // A pixel less, for places between pixels.
    const half = reach / 2 - 1;
    probe(-half, 0, `${half} to the left`);
    probe(half, 0, `${half} to the right`);
    probe(0, -half, `${half} above`);
    probe(0, half, `${half} below`);
  }
  return { control: hits.name(control), x, y, missed };
}
