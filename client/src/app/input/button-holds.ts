/** So long a finger is held on a button to learn its name, in milliseconds. */
const HOLD = 500;
/** A finger that has gone so far, in pixels, does something else. */
const WANDERS = 10;
/** What is pressed or pulled at, but for what says itself what a finger rests on. */
const CONTROLS = 'button, [role="slider"]:not([data-says-what])';

/** A control that shows no name of its own. */
export interface NamedControl {
  readonly name: string;
  /** What it does, where its title says more than its name. */
  readonly purpose: string;
  readonly place: DOMRect;
}

/**
 * Shows what a control without words is called while a finger or a pen is held on it; lifting then presses nothing.
 * Returns what ends that.
 */
export function listenForHolds(show: (control: NamedControl | null) => void): () => void {
  const stop = new AbortController();
  let held: { readonly id: number; readonly since: number; readonly x: number; readonly y: number } | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  /** The finger was held so long that its lifting is no press. */
  let spent = false;

  const rest = () => {
    clearTimeout(timer);
    held = null;
    show(null);
  };
  const down = (event: PointerEvent) => {
    rest();
    spent = false;
    const element = event.target instanceof Element ? event.target.closest<HTMLElement>(CONTROLS) : null;
    if (event.pointerType === "mouse" || !event.isPrimary || element === null || !hasNoWords(element)) {
      return;
    }
    held = { id: event.pointerId, since: event.timeStamp, x: event.clientX, y: event.clientY };
    timer = setTimeout(() => show(named(element)), HOLD);
  };
  const move = ({ pointerId, clientX, clientY }: PointerEvent) => {
    if (pointerId === held?.id && Math.hypot(clientX - held.x, clientY - held.y) > WANDERS) {
      rest();
    }
  };
  const up = ({ pointerId, timeStamp }: PointerEvent) => {
    if (pointerId === held?.id) {
      // By the clock of the events: a page that was busy may have shown the name after a tap.
      spent = timeStamp - held.since >= HOLD;
      rest();
    }
  };
  const swallow = (event: MouseEvent) => {
    // A key presses a button with no detail.
    if (event.type === "contextmenu" ? held !== null : spent && event.detail > 0) {
      event.preventDefault();
      event.stopImmediatePropagation();
    }
    spent = false;
  };
  const options = { capture: true, signal: stop.signal };
  addEventListener("pointerdown", down, options);
  addEventListener("pointermove", move, options);
  addEventListener("pointerup", up, options);
  addEventListener("pointercancel", rest, options);
  addEventListener("click", swallow, options);
  addEventListener("contextmenu", swallow, options);
  return () => {
    rest();
    stop.abort();
  };
}

/** Whether a control shows a picture alone; a lever may show its value as well. */
function hasNoWords(element: HTMLElement): boolean {
  const isLever = element.getAttribute("role") === "slider";
  return element.hasAttribute("aria-label") && (isLever || element.textContent.trim() === "");
}

function named(element: HTMLElement): NamedControl {
  const name = element.getAttribute("aria-label") ?? "";
  // A title ends with the key, of which a tablet has none.
  const title = element.title.replace(/\s*\([^()]*\)$/, "");
  const rest = title.startsWith(`${name}: `) ? title.slice(name.length + 2) : title;
  return { name, purpose: name.startsWith(rest) ? "" : rest, place: element.getBoundingClientRect() };
}
