import type { OpenedFrame } from "../../wire/envelope";
import { BOUNDS, MAX_SKETCH_PLACES } from "../../wire/generated";
import { readPresence } from "../../wire/presence-frame";
import type { Studio } from "../studio";
import { nearestBase } from "../view/places";
import { say } from "../words/say";
import { place, seen, seenIn, told, within } from "./cameras";
import { Others } from "./others";
import { pointerAt, thinned } from "./own-pointer";
import { type Here, OwnWords } from "./own-words";
import { companions, isFollowed, REPLAY } from "./people";
import { Pointing } from "./pointing";
import type { Gathered, Listener, PeopleHere } from "./together";

/** How often a page says what is new of itself, in milliseconds. */
const PAUSE = 50;

/** What a page says of itself while others are there, and what it does about what they say. */
export class Room implements Listener {
  readonly others: Others;
  #studio: Studio;
  #words = new OwnWords();
  #pointing = new Pointing();
  /** How often the user had moved the camera when this page began to follow. */
  #moves = 0;

  constructor(studio: Studio) {
    this.#studio = studio;
    const { stage, table } = studio;
    this.others = new Others({
      placeOf: (row) => stage.seenAt(row),
      parentOf: (row) => table.parent[row] ?? -1,
    });
  }

  /** Listens and speaks until what this returns was called. */
  enter(canvas: HTMLCanvasElement): () => void {
    const { together, link } = this.#studio;
    together.listener = this;
    const stop = new AbortController();
    const options = { signal: stop.signal };
    const at = ({ offsetX: x, offsetY: y, isPrimary, pointerType }: PointerEvent) => {
      // Of several fingers the first points.
      if (isPrimary) {
        this.#pointing.at(x, y, pointerType === "touch");
      }
    };
    const lift = ({ isPrimary }: PointerEvent) => isPrimary && this.#pointing.lift(performance.now());
    canvas.addEventListener("pointermove", at, options);
    canvas.addEventListener("pointerdown", at, options);
    canvas.addEventListener("pointerup", lift, options);
    canvas.addEventListener("pointercancel", lift, options);
    const leave = ({ pointerType }: PointerEvent) => pointerType === "touch" || this.#pointing.leave();
    canvas.addEventListener("pointerleave", leave, options);
    // The first touch of one's own ends what others lead.
    canvas.addEventListener("pointerdown", () => this.follow(null), options);
    canvas.addEventListener("wheel", () => this.follow(null), options);
    document.addEventListener("visibilitychange", () => this.#speak(), options);
    const timer = setInterval(() => this.#speak(), PAUSE);
    const stopConnecting = link.present.subscribe((present) => {
      if (present) {
        this.#words.again();
        // The server follows for a connection, and this is another one.
        const device = together.followed.peek();
        if (device !== null) {
          link.tell({ type: "follow", device });
        }
        this.#speak();
      }
    });
    const stopWatching = together.people.subscribe((here) => {
      const all = companions(here);
      link.watchful = all.length > 0;
      this.others.keep(new Set(all.map(({ device }) => device.device)));
      const followed = together.followed.peek();
      if (here !== null && followed !== null && !all.some(({ device }) => device.device === followed)) {
        this.follow(null);
      }
    });
    return () => {
      stop.abort();
      clearInterval(timer);
      stopConnecting();
      stopWatching();
      together.listener = null;
    };
  }

  receive({ body }: OpenedFrame): void {
    this.others.take(readPresence(body), performance.now());
    const followed = this.#studio.together.followed.peek();
    const camera = followed === null ? null : this.others.camera(followed);
    if (camera) {
      this.#studio.stage.view?.camera.accompany(seenIn(camera));
    }
  }

  /** Somebody brings everyone to their view; a hand that draws is left alone. */
  gathered({ by, camera }: Gathered): void {
    const { together, tools, stage, toasts } = this.#studio;
    const found = companions(together.people.peek()).find(({ device }) => device.device === by);
    const name = found?.name ?? say("together.unnamed", { number: by });
    const go = () => {
      this.follow(null);
      stage.view?.camera.visit(seen(camera));
      together.visits.value += 1;
    };
    if (tools.drawing.peek()) {
      toasts.show(say("together.called", { name }), { label: say("together.go"), act: go });
      return;
    }
    go();
    const back = { label: say("together.back"), act: () => stage.view?.camera.restore() };
    toasts.show(say("together.gathered", { name }), back);
  }

  /** Follows the camera of a device, or none any more. */
  follow(device: number | null): void {
    const { together, link, stage } = this.#studio;
    if (together.followed.peek() === device) {
      return;
    }
    together.followed.value = device;
    link.tell(device === null ? { type: "follow" } : { type: "follow", device });
    this.#moves = stage.view?.camera.moves ?? 0;
    const camera = device === null ? null : this.others.camera(device);
    if (camera) {
      stage.view?.camera.accompany(seenIn(camera));
    }
  }

  /** Brings everyone to what this page shows; false where it shows nothing. */
  gather(): boolean {
    const { link, stage } = this.#studio;
    const view = stage.view?.camera.rig.view;
    return view !== undefined && link.tell({ type: "gather", camera: told(view) });
  }

  #speak(): void {
    const { together, link, stage, document: figures, settings } = this.#studio;
    const here = together.people.peek();
    const isReplaying = link.replaying.peek();
    // How many are in the session a copy does not say.
    const isAlone = here === null ? !isReplaying && (figures.peek()?.people ?? 1) < 2 : companions(here).length === 0;
    if (!link.present.peek() || isAlone) {
      return;
    }
    const view = isReplaying ? null : stage.view;
    if (together.followed.peek() !== null && view && view.camera.moves !== this.#moves) {
      this.follow(null);
    }
    const camera = view ? told(view.camera.rig.view) : null;
    const name = settings.author.peek().trim();
    const words = this.#words.next(performance.now(), this.#here(), camera, name, isFollowed(here));
    if (words !== null) {
      link.tell(words);
    }
  }

  /** What others may see of this page; who may only look shows that they are there. */
  #here(): Omit<Here, "camera" | "name"> {
    const { stage, tools, outline, rights, grammar, link, together } = this.#studio;
    if (document.hidden) {
      return { type: "here", away: true };
    }
    if (link.replaying.peek()) {
      // Of those who may only look nothing is told but whether they are there (`PS6`).
      return { type: "here", away: true, ...(mayDraw(together.people.peek()) ? { tool: REPLAY } : {}) };
    }
    const view = stage.view;
    if (!rights.mayChange.peek() || !view) {
      return { type: "here" };
    }
    const here: Omit<Here, "camera" | "name"> = {
      type: "here",
      tool: grammar.writing.peek() ? "grammar" : tools.chosen.peek(),
    };
    const brush = view.brush;
    if (brush) {
      const [x, y, z, radius] = brush;
      here.pointer = { kind: "space", position: place([x, y, z]) };
      here.radius = within(radius, BOUNDS.BrushRadius.least, BOUNDS.BrushRadius.most);
    } else {
      const pointer = this.#pointerNow();
      if (pointer) {
        here.pointer = pointer;
      }
    }
    const shown = outline.shown.peek();
    if (shown?.stage === "drawing" && shown.points.length > 1) {
      here.sketch = this.#line(shown.points);
    }
    return here;
  }

  #pointerNow(): Here["pointer"] | null {
    const { stage, table } = this.#studio;
    const { view } = stage;
    if (!view) {
      return null;
    }
    const wood = {
      placeOf: (row: number) => stage.placeOf(row),
      parentOf: (row: number) => table.parent[row] ?? -1,
    };
    const seenNow = JSON.stringify(told(view.camera.rig.view));
    return this.#pointing.pointer(seenNow, performance.now(), (x, y) => pointerAt(x, y, view, table, wood));
  }

  #line(points: readonly (readonly [number, number])[]): [number, number, number][] {
    const { stage, table } = this.#studio;
    const view = stage.view;
    const [first] = points;
    if (!view || !first) {
      return [];
    }
    const through = view.pick(first[0], first[1], 24)?.point ?? nearestBase(table, view, first[0], first[1]);
    return thinned(points, MAX_SKETCH_PLACES).flatMap(([x, y]) => {
      const at = view.pointOnPlane(x, y, through);
      return at ? [place(at)] : [];
    });
  }
}

/** Whether whoever is at this page may draw, by what everybody is told. */
function mayDraw(here: PeopleHere | null): boolean {
  const own = here?.people.find(({ devices }) => devices.some(({ device }) => device === here.you));
  return own !== undefined && own.role !== "viewer" && own.role !== "commenter";
}
