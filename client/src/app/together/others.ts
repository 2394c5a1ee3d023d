import type { Vec3 } from "../../scene/vector";
import type { DeviceNews, PointerPlace } from "../../wire/presence-frame";
import { onWood } from "./wood-place";

/** A pointer comes half as near to where it should be in so many milliseconds. */
const HALF_LIFE = 30;

/** Where rows are drawn, and what bears them. */
export interface Wood {
  /** Null where the row is not there (yet). */
  placeOf(row: number): Vec3 | null;
  parentOf(row: number): number;
}

/** What is known of another device. */
interface Other {
  place: PointerPlace;
  radius: number;
  sketch: readonly Vec3[];
  camera: readonly number[] | null;
  /** When it last pointed elsewhere. */
  movedAt: number;
  /** How far it is drawn from where it points, which fades. */
  lag: Vec3;
  drawnAt: number;
}

/** A pointer as it is drawn. */
export interface DrawnPointer {
  readonly at: Vec3;
  readonly radius: number;
}

/** Where the pointers of other devices are, what is drawn there, and what they see: the newest of everything. */
export class Others {
  #known = new Map<number, Other>();
  #wood: Wood;

  constructor(wood: Wood) {
    this.#wood = wood;
  }

  take(all: readonly DeviceNews[], now: number): void {
    for (const { device, pointer, sketch, camera } of all) {
      const known = this.#known.get(device) ?? fresh(now);
      this.#known.set(device, known);
      if (pointer) {
        const before = this.#drawn(known, now);
        [known.place, known.radius, known.movedAt] = [pointer.place, pointer.radius, now];
        const after = this.#place(known);
        known.lag = before && after ? [before[0] - after[0], before[1] - after[1], before[2] - after[2]] : [0, 0, 0];
        known.drawnAt = now;
      }
      known.sketch = sketch ?? known.sketch;
      known.camera = camera ?? known.camera;
    }
  }

  /** Only these are still here. */
  keep(devices: ReadonlySet<number>): void {
    for (const device of this.#known.keys()) {
      if (!devices.has(device)) {
        this.#known.delete(device);
      }
    }
  }

  /** Where a device points, eased; null where it points nowhere, or to wood that is not there. */
  pointer(device: number, now: number): DrawnPointer | null {
    const known = this.#known.get(device);
    const at = known && this.#drawn(known, now);
    return at ? { at, radius: known.radius } : null;
  }

  sketch(device: number): readonly Vec3[] {
    return this.#known.get(device)?.sketch ?? [];
  }

  camera(device: number): readonly number[] | null {
    return this.#known.get(device)?.camera ?? null;
  }

  /** For how many milliseconds a device has pointed to the same place. */
  still(device: number, now: number): number {
    return now - (this.#known.get(device)?.movedAt ?? 0);
  }

  #drawn(known: Other, now: number): Vec3 | null {
    const at = this.#place(known);
    if (!at) {
      return null;
    }
    const left = 0.5 ** (Math.max(0, now - known.drawnAt) / HALF_LIFE);
    return [at[0] + left * known.lag[0], at[1] + left * known.lag[1], at[2] + left * known.lag[2]];
  }

  #place({ place }: Other): Vec3 | null {
    if (place.kind === "space") {
      return place.position;
    }
    if (place.kind === "nowhere") {
      return null;
    }
    const end = this.#wood.placeOf(place.row);
    const parent = end ? this.#wood.parentOf(place.row) : -1;
    const begin = parent < 0 ? end : this.#wood.placeOf(parent);
    return end && begin ? onWood(place, begin, end) : null;
  }
}

function fresh(now: number): Other {
  return {
    place: { kind: "nowhere" },
    radius: 0,
    sketch: [],
    camera: null,
    movedAt: now,
    lag: [0, 0, 0],
    drawnAt: now,
  };
}
