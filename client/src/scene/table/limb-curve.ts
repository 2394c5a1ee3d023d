import { grown } from "./column";

/** How wide the window of the fit is where nothing asks for more, in radii, and at most. */
const NARROWEST = 0.9;
const WIDEST = 3.6;
const WIDENS = 1.35;
/** Windows of neighbours differ by at most so much for each radius between them. */
const EVEN = 0.8;
const ROUNDS = 7;
/** Corners that are left are eased in at most so many sweeps. */
const EASED = 16;
/** Curvature times radius from which wood comes near to folding: at 1 its rings meet. */
const TIGHT = 0.65;
/** A node stays so many of its radii within what is drawn around it. */
const FARTHEST = 0.75;
/** Rings are turned evenly in at most so many sweeps. */
const SWEEPS = 24;
/** A limb is at home so many radii of its bearer after it begins. */
const CARRIED = 3;
/** Wood thinner than this, in internodes beside it, cannot fold. */
export const THIN = 0.3;

/**
 * One limb as it is drawn: a curve that wood as thick as this can follow without folding through itself. The caller fills
 * `given` and `radii`, of node 0, at which the limb begins, up to node `count`; `fit` then has `places` and `directions`
 * for them.
 *
 * Each node moves to where a local linear regression over a window around it has it (W. Cleveland, 1979): straight wood stays
 * where it is, however uneven its internodes are. Both ends are mirrored, so that they stay too. Windows grow only where
 * the wood would fold.
 */
export class LimbCurve {
  /** Nodes but the first. */
  count = 0;
  /** x y z of each node, moved along with its bearer; and how thick the wood is there, with whatever spreads at its foot. */
  given = new Float64Array(0);
  radii = new Float64Array(0);
  /** Where each is drawn, and which way its ring looks. */
  places = new Float64Array(0);
  directions = new Float64Array(0);
  /** Lengths along the nodes. */
  private along = new Float64Array(0);
  private windows = new Float64Array(0);
  private tried = new Float64Array(0);
  private best = new Float64Array(0);
  private tightness = new Float64Array(0);
  private halves = new Float64Array(0);
  private cells = new Float64Array(0);
  private readonly sum = new Float64Array(6);

  reserve(nodes: number): void {
    if (this.radii.length >= nodes) return;
    const capacity = 2 * nodes;
    this.given = grown(this.given, 3 * capacity);
    this.places = grown(this.places, 3 * capacity);
    this.directions = grown(this.directions, 3 * capacity);
    this.best = grown(this.best, 3 * capacity);
    this.radii = grown(this.radii, capacity);
    this.along = grown(this.along, capacity);
    this.windows = grown(this.windows, capacity);
    this.tried = grown(this.tried, capacity);
    this.tightness = grown(this.tightness, capacity);
    this.halves = grown(this.halves, 2 * capacity);
    this.cells = grown(this.cells, 2 * capacity);
  }

  /**
   * Fits the curve. The limb begins `offset` away from its first node, where its bearer is drawn, which is so thick; `rises`
   * says that it grows from the ground, and `rounded` whether wood may leave its nodes at all.
   */
  fit(offset: Float64Array, bearer: number, rises: boolean, rounded: boolean): void {
    this.measure();
    this.carry(offset, bearer);
    this.places.set(this.given.subarray(0, 3 * (this.count + 1)));
    const stout = rounded && this.stout();
    if (stout) this.round();
    this.direct(rises, stout);
  }

  private measure(): void {
    this.along[0] = 0;
    for (let i = 1; i <= this.count; i += 1) this.along[i] = this.along[i - 1]! + distance(this.given, i - 1, i);
  }

  private carry(offset: Float64Array, bearer: number): void {
    if (offset[0] === 0 && offset[1] === 0 && offset[2] === 0) return;
    const reach = CARRIED * bearer;
    for (let i = 0; i <= this.count && this.along[i]! <= reach; i += 1) {
      const t = reach > 0 ? this.along[i]! / reach : 1;
      const share = i === 0 ? 1 : 1 - t * t * (3 - 2 * t);
      for (let axis = 0; axis < 3; axis += 1) this.given[3 * i + axis]! += share * offset[axis]!;
    }
  }

  private stout(): boolean {
    const { along, radii } = this;
    for (let i = 1; i <= this.count; i += 1) {
      if (Math.max(radii[i]!, radii[i - 1]!) > THIN * (along[i]! - along[i - 1]!)) return true;
    }
    return false;
  }

  /** Moves nodes until wood folds nowhere, or no further round helps. */
  private round(): void {
    const { count, windows, tried, places, best } = this;
    const numbers = 3 * (count + 1);
    this.sample();
    windows.fill(NARROWEST, 0, count + 1);
    for (let i = 1; i < count; i += 1) this.move(i);
    let least = this.tighten();
    best.set(places.subarray(0, numbers));
    for (let round = 1; round < ROUNDS && least > 0; round += 1) {
      this.widen();
      let any = false;
      for (let i = 1; i < count; i += 1) {
        if (tried[i] === windows[i]) continue;
        any = true;
        windows[i] = tried[i]!;
        this.move(i);
      }
      if (!any) break;
      const much = this.tighten();
      // A turn too sharp for wood as short as this only spreads.
      if (much >= least) continue;
      least = much;
      best.set(places.subarray(0, numbers));
    }
    places.set(best.subarray(0, numbers));
    least = this.tighten();
    for (let sweep = 0; sweep < EASED && least > 0; sweep += 1) {
      for (let i = 1; i < count; i += 1) if (this.tightness[i]! > TIGHT) this.ease(i);
      const much = this.tighten();
      if (much >= least) {
        places.set(best.subarray(0, numbers));
        return;
      }
      least = much;
      best.set(places.subarray(0, numbers));
    }
  }

  /** Moves a node half way to the line between its neighbours, as far as it may go. */
  private ease(node: number): void {
    const { places, given, radii } = this;
    const at = 3 * node;
    const [before, after] = [distance(places, node - 1, node), distance(places, node, node + 1)];
    const share = before / Math.max(before + after, 1e-9);
    let squared = 0;
    for (let axis = 0; axis < 3; axis += 1) {
      const line = places[at + axis - 3]! + share * (places[at + axis + 3]! - places[at + axis - 3]!);
      this.sum[axis] = 0.5 * (places[at + axis]! + line);
      squared += (this.sum[axis]! - given[at + axis]!) ** 2;
    }
    if (squared > (FARTHEST * radii[node]!) ** 2) return;
    for (let axis = 0; axis < 3; axis += 1) places[at + axis] = this.sum[axis]!;
  }

  /** Chooses windows for the next round: wider where it is tight, and next to that. */
  private widen(): void {
    const { count, windows, tried, along, radii, tightness } = this;
    for (let i = 0; i <= count; i += 1) {
      const wider = i > 0 && i < count && tightness[i]! > TIGHT;
      tried[i] = wider ? Math.min(WIDEST, WIDENS * windows[i]!) : windows[i]!;
    }
    for (let i = 1; i <= count; i += 1) this.follow(i, i - 1, along[i]! - along[i - 1]!, radii[i]!);
    for (let i = count - 1; i >= 0; i -= 1) this.follow(i, i + 1, along[i + 1]! - along[i]!, radii[i]!);
  }

  private follow(i: number, neighbour: number, apart: number, radius: number): void {
    const least = this.tried[neighbour]! - (EVEN * apart) / Math.max(radius, 1e-6);
    if (least > this.tried[i]!) this.tried[i] = least;
  }

  /** How tightly wood bends at each node: curvature times radius. Gives how much of it is too much. */
  private tighten(): number {
    const { count, places, radii, tightness } = this;
    let much = 0;
    for (let i = 1; i < count; i += 1) {
      const [a, b] = [distance(places, i - 1, i), distance(places, i, i + 1)];
      let along = 0;
      for (let axis = 0; axis < 3; axis += 1) {
        const [p, q, r] = [places[3 * i + axis - 3]!, places[3 * i + axis]!, places[3 * i + axis + 3]!];
        along += (q - p) * (r - q);
      }
      const turn = Math.acos(Math.min(1, Math.max(-1, along / Math.max(a * b, 1e-12))));
      tightness[i] = (turn * radii[i]!) / Math.max(0.5 * (a + b), 1e-6);
      const over = Math.max(0, tightness[i]! - TIGHT);
      much += over * over;
    }
    return much;
  }

  /** Nodes and the middles between them, each with the length of wood that it stands for. */
  private sample(): void {
    const { count, along, halves, cells } = this;
    const last = 2 * count;
    for (let half = 0; half <= last; half += 1) halves[half] = 0.5 * (along[half >> 1]! + along[(half + 1) >> 1]!);
    for (let half = 0; half <= last; half += 1) {
      // An end is mirrored, and stands for as much beyond.
      const before = half > 0 ? halves[half]! - halves[half - 1]! : halves[1]!;
      const after = half < last ? halves[half + 1]! - halves[half]! : before;
      cells[half] = 0.5 * (before + after);
    }
  }

  /** Puts a node where the fit over its window has it. */
  private move(node: number): void {
    const { count, given, places, radii, sum, halves, cells } = this;
    const reach = this.windows[node]! * radii[node]!;
    const [at, last] = [3 * node, 2 * count];
    const middle = halves[2 * node]!;
    let [w0, w1, w2] = [cells[2 * node]!, 0, 0];
    sum.fill(0);
    for (let step = -1; step <= 1; step += 2) {
      for (let half = 2 * node + step; ; half += step) {
        const over = half < 0 ? -half : half > last ? 2 * last - half : half;
        if (over < 0 || over > last) break;
        const pinned = half < 0 ? 0 : last;
        const away = (over === half ? halves[over]! : 2 * halves[pinned]! - halves[over]!) - middle;
        const near = 1 - (away / reach) * (away / reach);
        if (!(near > 0)) break;
        const weight = near * near * cells[over]!;
        w0 += weight;
        w1 += weight * away;
        w2 += weight * away * away;
        const [low, high] = [3 * (over >> 1), 3 * ((over + 1) >> 1)];
        for (let axis = 0; axis < 3; axis += 1) {
          const x = 0.5 * (given[low + axis]! + given[high + axis]!);
          const place = (over === half ? x : 2 * given[3 * (pinned >> 1) + axis]! - x) - given[at + axis]!;
          sum[axis]! += weight * place;
          sum[3 + axis]! += weight * away * place;
        }
      }
    }
    const determinant = w0 * w2 - w1 * w1;
    let squared = 0;
    if (determinant > 1e-9 * w0 * w0 * reach * reach) {
      for (let axis = 0; axis < 3; axis += 1) {
        sum[axis] = (w2 * sum[axis]! - w1 * sum[3 + axis]!) / determinant;
        squared += sum[axis]! * sum[axis]!;
      }
    }
    // What has nothing in its window stays to the last bit.
    const most = FARTHEST * radii[node]!;
    const excess = squared / (most * most);
    const share = squared > 0 ? 1 / Math.sqrt(Math.sqrt(1 + excess * excess)) : 0;
    for (let axis = 0; axis < 3; axis += 1) {
      places[at + axis] = share === 0 ? given[at + axis]! : given[at + axis]! + share * sum[axis]!;
    }
  }

  /** Rings lie across the way, and turn from node to node by no more than keeps them apart. */
  private direct(rises: boolean, stout: boolean): void {
    const { count, directions, places, radii } = this;
    for (let i = 0; i <= count; i += 1) {
      const at = 3 * i;
      directions.fill(0, at, at + 3);
      if (i > 0) addDirection(directions, i, places, i - 1, i);
      const [x, y, z] = [directions[at]!, directions[at + 1]!, directions[at + 2]!];
      if (i < count) addDirection(directions, i, places, i, i + 1);
      if (normalise(directions, i)) continue;
      // An axis that doubles back on itself has no mean direction; it keeps the incoming one.
      directions[at] = x;
      directions[at + 1] = i > 0 ? y : 1;
      directions[at + 2] = z;
    }
    if (rises) {
      directions[1]! += RISES * Math.max(0, directions[1]!);
      normalise(directions, 0);
    }
    if (!stout) return;
    // Where a limb leaves its bearer, its first ring is the shader's own.
    const first = rises ? 0 : 1;
    for (let sweep = 0; sweep < SWEEPS; sweep += 1) {
      let any = false;
      for (let i = first; i < count; i += 1) {
        let along = 0;
        for (let axis = 0; axis < 3; axis += 1) along += directions[3 * i + axis]! * directions[3 * i + 3 + axis]!;
        const turn = Math.acos(Math.min(1, Math.max(-1, along)));
        if (0.5 * turn * (radii[i]! + radii[i + 1]!) <= TIGHT * distance(places, i, i + 1)) continue;
        any = true;
        if (i > first) this.even(i, first);
        this.even(i + 1, first);
      }
      if (!any) return;
    }
  }

  private even(i: number, first: number): void {
    const { directions, count } = this;
    for (let axis = 0; axis < 3; axis += 1) {
      const at = 3 * i + axis;
      const sum = directions[at]! + (i > first ? directions[at - 3]! : 0) + (i < count ? directions[at + 3]! : 0);
      directions[at] = sum;
    }
    normalise(directions, i);
  }
}

/** How much more upright than its first internode a trunk stands where it comes out of the ground. */
export const RISES = 1.2;

function distance(of: Float64Array, a: number, b: number): number {
  const [x, y, z] = [of[3 * b]! - of[3 * a]!, of[3 * b + 1]! - of[3 * a + 1]!, of[3 * b + 2]! - of[3 * a + 2]!];
  return Math.sqrt(x * x + y * y + z * z);
}

function addDirection(out: Float64Array, at: number, places: Float64Array, from: number, to: number): void {
  const length = distance(places, from, to);
  if (length < 1e-6) return;
  for (let axis = 0; axis < 3; axis += 1) {
    out[3 * at + axis]! += (places[3 * to + axis]! - places[3 * from + axis]!) / length;
  }
}

/** Says whether it could be. */
function normalise(of: Float64Array, i: number): boolean {
  const [x, y, z] = [of[3 * i]!, of[3 * i + 1]!, of[3 * i + 2]!];
  const length = Math.sqrt(x * x + y * y + z * z);
  if (length < 1e-6) return false;
  of[3 * i] = x / length;
  of[3 * i + 1] = y / length;
  of[3 * i + 2] = z / length;
  return true;
}
