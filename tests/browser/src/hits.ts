import type { Tablet } from "./tablet";

/** The side of the smallest square that a finger hits, in pixels. */
const TARGET = 44;

/** Kinds of controls that were pressed on a tablet already: another press of one would only hit the same again. */
const pressedOn = new WeakMap<Tablet, Set<string>>();

/**
 * Says which controls of the page, or of the part that `within` names, are not hit at their middle, and by touch also
 * which are smaller than a finger needs. The page itself says what lies there, for all of them at once; that a press hits
 * the same is tried on one control in each box that scrolls, and on one of each kind. No control does anything meanwhile.
 * Without `press`, for moments at which a finger is down already, nothing is pressed.
 */
export async function misses(tablet: Tablet, where: string, within = "body", press = true): Promise<string[]> {
  await tablet.untilCome();
  const pressed = pressedOn.get(tablet) ?? new Set();
  pressedOn.set(tablet, pressed);
  const reach = tablet.touches ? TARGET : 0;
  const faults: string[] = [];
  try {
    const looked = await tablet.page.evaluate(look, { within, reach, pressed: [...pressed] });
    if (looked.count === 0) faults.push(`${where}: no control in ${within}`);
    faults.push(...looked.missed.map((fault) => `${where}: ${fault}`));
    for (const i of press ? looked.samples : []) {
      const aimed = await tablet.page.evaluate((i) => globalThis.hits?.aim(i) ?? null, i);
      // A note that has had its time.
      if (aimed === null) continue;
      const { name, kind, x, y } = aimed;
      await tablet.touch("touchStart", [{ x, y }]);
      await tablet.touch("touchEnd", []);
      const hit = await tablet.page.evaluate(() => globalThis.hits?.pressed ?? "nothing that the page is told of");
      if (hit !== "") faults.push(`${where}: ${name}: a press at ${x}, ${y} hits ${hit}`);
      pressed.add(kind);
    }
  } finally {
    await tablet.page.evaluate(() => globalThis.hits?.stop());
  }
  return faults;
}

declare global {
  /** What the page keeps while its controls are looked at. */
  var hits:
    | {
        /** What the last press hit instead of what was aimed at; empty if it hit that, null if there was none. */
        readonly pressed: string | null;
        /** Brings a control into view to be pressed, and says where its middle is; null if it is gone. */
        aim(i: number): { readonly name: string; readonly kind: string; readonly x: number; readonly y: number } | null;
        stop(): void;
      }
    | undefined;
}

/**
 * In the page: keeps presses from all controls that are shown, brings each into view, and says what lies over it at its
 * middle or within reach. `samples` are those to press: the last in each box that scrolls, where it has been scrolled,
 * and the first of each kind that was not `pressed` before.
 */
function look({ within, reach, pressed }: { within: string; reach: number; pressed: readonly string[] }) {
  const selector =
    ":is(button, a[href], input, select, textarea, summary, [role=slider], [role=tab], [role=radio], [role=button])";
  const controls = [...document.querySelectorAll<HTMLElement>(`:is(${within}) ${selector}`)].filter((control) => {
    // A field for a file is opened by the button beside it.
    if (control instanceof HTMLInputElement && control.type === "file") return false;
    return control.checkVisibility() && control.getClientRects().length > 0;
  });
  const isHit = (control: HTMLElement, at: EventTarget | null) => {
    if (!(at instanceof Element)) return false;
    const label = at.closest("label");
    return control.contains(at) || label?.control === control;
  };
  const nameOf = (element: EventTarget | null) => {
    if (!(element instanceof Element)) return "nothing";
    const words = element.getAttribute("aria-label") ?? element.textContent ?? "";
    return `${element.localName}.${element.getAttribute("class")} “${words.trim().slice(0, 40)}”`;
  };
  const kindOf = (control: HTMLElement) =>
    [control.localName, control.getAttribute("type"), control.getAttribute("role")].join(" ");
  const boxOf = (control: HTMLElement) => {
    let box = control.parentElement;
    while (box && !/auto|scroll/.test(getComputedStyle(box).overflow)) box = box.parentElement;
    return box;
  };
  /** Brings it into view and gives its middle and size. */
  const show = (control: HTMLElement) => {
    const isOption = control instanceof HTMLInputElement && ["radio", "checkbox"].includes(control.type);
    // What is drawn of an option is its label.
    const drawn = (isOption && control.closest("label")) || control;
    drawn.scrollIntoView({ block: "center", inline: "center", behavior: "instant" });
    const { left, top, width, height } = drawn.getBoundingClientRect();
    return { x: left + width / 2, y: top + height / 2, size: `${width.toFixed(1)} × ${height.toFixed(1)}` };
  };

  const missed: string[] = [];
  // A pixel less, for places between pixels.
  const half = reach / 2 - 1;
  const probes: [number, number, string][] = [
    [0, 0, "at its middle"],
    [-half, 0, `${half} to the left`],
    [half, 0, `${half} to the right`],
    [0, -half, `${half} above`],
    [0, half, `${half} below`],
  ];
  for (const control of controls) {
    const { x, y, size } = show(control);
    for (const [dx, dy, what] of reach > 0 ? probes : probes.slice(0, 1)) {
      const at = document.elementFromPoint(x + dx, y + dy);
      if (!isHit(control, at)) missed.push(`${nameOf(control)}: ${what} is ${nameOf(at)} (${size})`);
    }
  }

  const inEachBox = new Map(controls.map((control, i) => [boxOf(control), i]));
  const ofEachKind = new Map(controls.map((control, i) => [kindOf(control), i] as const).reverse());
  for (const kind of pressed) ofEachKind.delete(kind);

  const stopped = new AbortController();
  let aimed: HTMLElement | null = null;
  let hit: string | null = null;
  const swallow = (event: Event) => {
    if (event.type === "pointerdown" && aimed) hit = isHit(aimed, event.target) ? "" : nameOf(event.target);
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  const kinds = ["pointerdown", "pointermove", "pointerup", "mousedown", "mouseup", "click", "dblclick"];
  for (const kind of [...kinds, "touchstart", "touchmove", "touchend", "contextmenu"]) {
    addEventListener(kind, swallow, { capture: true, passive: false, signal: stopped.signal });
  }
  globalThis.hits = {
    get pressed() {
      return hit;
    },
    aim: (i) => {
      aimed = controls[i]!;
      hit = null;
      if (!aimed.isConnected) return null;
      const { x, y } = show(aimed);
      return { name: nameOf(aimed), kind: kindOf(aimed), x, y };
    },
    stop: () => stopped.abort(),
  };
  return { count: controls.length, missed, samples: [...new Set([...inEachBox.values(), ...ofEachKind.values()])] };
}
