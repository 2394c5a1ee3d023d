import { signal } from "@preact/signals";
import type { Vec3 } from "../../../scene/vector";
import { MIN_SPACING } from "./sample-queue";

/** How long a ghost takes to fade where no growth takes its place, in milliseconds. */
export const FADE = 280;
/** Wood has come to a place of the stroke when it is so near, in internodes, and this share of the brush's radius. */
const NEAR = 1;
const NEAR_SHARE = 0.5;
/** It comes along the stroke: places farther on than this, in internodes along it, are not looked at yet. */
const AHEAD = 6;
/** Places kept of a stroke, and strokes that are over and wait for their growth; older ones go. */
const MOST_PLACES = 2000;
const MOST_ENDED = 8;
/** More new wood than this at once is a tree that was loaded anew, and only its end is looked at. */
const MOST_NEW_ROWS = 20_000;

/** A place of a stroke. */
export interface TrailPlace {
  readonly position: Vec3;
  readonly radius: number;
}

/** What is still to grow of a stroke, from the wood that has come to where the brush is. */
export interface StrokeGhost {
  readonly places: readonly TrailPlace[];
  /** 1, and less while it fades. */
  readonly opacity: number;
}

/** Where wood is. */
export interface Grown {
  readonly rows: number;
  readonly position: ArrayLike<number>;
  readonly parent: ArrayLike<number>;
}

interface Trail {
  readonly stroke: number;
  places: TrailPlace[];
  /** The first place that no wood has come to. */
  reached: number;
  /** The wood that has come farthest. */
  root: Vec3 | null;
  /** No bud is near (`SG2`): nothing is shown until wood comes after all. */
  adrift: boolean;
  /** The command that ended it. */
  ended: number | null;
  /** It is no longer waited for, since when if it has been drawn so. */
  leaving: boolean;
  leavingSince: number | null;
}

/** What is drawn of one's own strokes before the server has answered: each goes as its wood comes, and none stays. */
export class StrokeTrail {
  /** Whether there is anything to draw. */
  readonly shown = signal(false);
  #trails: Trail[] = [];
  #seenRows = 0;

  begin(stroke: number): void {
    this.#trails.push({
      stroke,
      places: [],
      reached: 0,
      root: null,
      adrift: false,
      ended: null,
      leaving: false,
      leavingSince: null,
    });
    const waiting = this.#trails.filter(({ ended, leaving }) => ended !== null && !leaving);
    for (const trail of waiting.slice(0, Math.max(0, waiting.length - MOST_ENDED))) {
      trail.leaving = true;
    }
    this.shown.value = true;
  }

  /** The brush is here now. */
  add(stroke: number, position: Vec3, radius: number): void {
    const trail = this.#of(stroke);
    if (!trail || trail.ended !== null) {
      return;
    }
    const { places } = trail;
    const [before, last] = [places.at(-2), places.at(-1)];
    // The last place is where the brush is, however little it has moved.
    if (before && last && distance(before.position, last.position) < MIN_SPACING) {
      places.pop();
    }
    places.push({ position, radius });
    if (places.length > MOST_PLACES) {
      places.shift();
      trail.reached = Math.max(0, trail.reached - 1);
    }
    trail.reached = Math.min(trail.reached, places.length);
  }

  /** The stroke is over; `command` says so to the server. */
  end(stroke: number, command: number): void {
    const trail = this.#of(stroke);
    if (trail) {
      trail.ended = command;
    }
  }

  /** Rows have changed: where new wood stands, a ghost is needed no longer. */
  grown({ rows, position, parent }: Grown): void {
    const first = Math.max(Math.min(this.#seenRows, rows), rows - MOST_NEW_ROWS);
    this.#seenRows = rows;
    const waiting = this.#trails.filter(({ leaving }) => !leaving);
    for (let row = first; row < rows && waiting.length > 0; row += 1) {
      if ((parent[row] ?? -1) < 0) {
        continue;
      }
      const node: Vec3 = [position[3 * row] ?? 0, position[3 * row + 1] ?? 0, position[3 * row + 2] ?? 0];
      for (const trail of waiting) {
        come(trail, node);
      }
    }
    this.#keep(({ ended, reached, places }) => ended === null || reached < places.length);
  }

  /** Nothing is left to grow of commands up to this one (`CM11`): whatever wood has not come to, it will not come to. */
  done(command: number): void {
    for (const trail of this.#trails) {
      trail.leaving ||= trail.ended !== null && trail.ended <= command;
    }
  }

  /** The server says that a stroke is in vain, or as far as it was drawn. */
  inVain(stroke: number): void {
    const trail = this.#of(stroke);
    if (trail && trail.ended === null) {
      trail.adrift = true;
    } else if (trail) {
      trail.leaving = true;
    }
  }

  /** The server does not know the strokes any more, or has refused them: their ghosts fade. */
  leave(): void {
    for (const trail of this.#trails) {
      trail.leaving = true;
    }
  }

  /** Another tree is shown. */
  clear(): void {
    this.#seenRows = 0;
    this.#keep(() => false);
  }

  /** What is to be drawn now, in milliseconds of any clock. */
  ghosts(now: number): StrokeGhost[] {
    for (const trail of this.#trails) {
      if (trail.leaving) {
        trail.leavingSince ??= now;
      }
    }
    this.#keep(({ leavingSince }) => leavingSince === null || now - leavingSince < FADE);
    return this.#trails.flatMap((trail) => {
      const { places, reached, root, adrift, leavingSince } = trail;
      const left = places.slice(reached);
      if (left.length === 0 || adrift) {
        return [];
      }
      return [
        {
          places: root ? [{ position: root, radius: left[0]?.radius ?? 0 }, ...left] : left,
          opacity: leavingSince === null ? 1 : 1 - (now - leavingSince) / FADE,
        },
      ];
    });
  }

  #of(stroke: number): Trail | undefined {
    return this.#trails.find((trail) => trail.stroke === stroke && !trail.leaving);
  }

  #keep(isKept: (trail: Trail) => boolean): void {
    this.#trails = this.#trails.filter(isKept);
    this.shown.value = this.#trails.length > 0;
  }
}

/** New wood: the stroke is done as far as it has come. */
function come(trail: Trail, node: Vec3): void {
  const { places, reached, root } = trail;
  let way = 0;
  for (let i = Math.max(0, reached - 1); i < places.length; i += 1) {
    const place = places[i]!;
    const before = places[i - 1];
    way += i > reached && before ? distance(before.position, place.position) : 0;
    if (way > AHEAD + 2 * place.radius && !trail.adrift) {
      break;
    }
    const far = distance(place.position, node);
    const isNearest = i >= reached || root === null || far < distance(place.position, root);
    if (far <= NEAR + NEAR_SHARE * place.radius && isNearest) {
      trail.reached = i + 1;
      trail.root = node;
    }
  }
  if (trail.reached > reached) {
    trail.adrift = false;
  }
}

function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
