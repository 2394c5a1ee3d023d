import type { Vec3 } from "../vector";
import { Chain } from "./chain";
import { Energy } from "./energy";
import { PRISM_SIZE, rotate, turnBy } from "./prism";
import { type Pull, pullsOf, type Touch } from "./reach";

/** How an internode of the path has moved: its quaternion, and where its far end is. */
export interface BendMotion {
  readonly rotation: readonly [x: number, y: number, z: number, w: number];
  readonly to: Vec3;
}

const STEPS_OF_AN_EVENT = 4;
const STEPS_OF_REST = 60;
/** The solver rests when nothing moves farther than this share of the branch's length. */
const TOLERANCE = 1e-7;
const TRIES = 5;
const MOST_TURN = 1;
/** What is nearer to rest than this, as a share of the length or in radians, is at rest. */
const REST = 1e-7;

/**
 * Solves a bend as `server/plant/src/bend.rs` does, in the client, so that the branch follows the
 * finger before the server answers. Both must give the same motions, which `server/plant/golden/bend.json` holds.
 */
export class Bend {
  private readonly chain: Chain;
  private prisms: Float64Array;
  private tried: Float64Array;
  private now: Energy;
  private next: Energy;
  private touches: Touch[] = [];

  /**
   * The path whose internode i goes from node i to node i + 1 and has radius i, at rest. Internode 0 never moves.
   * `stretch` goes from 0, stiff in length, to 1, like rubber.
   */
  constructor(nodes: readonly Vec3[], radii: ArrayLike<number>, stretch: number) {
    this.chain = new Chain(nodes, radii, stretch);
    this.prisms = this.chain.rest.slice();
    this.tried = this.chain.rest.slice();
    this.now = new Energy(this.chain);
    this.next = new Energy(this.chain);
  }

  /**
   * One event of a pointer: pulls the far ends of internodes to places. Touches that are not named are lifted; a
   * place that is no number leaves its touch where it was.
   */
  drag(targets: readonly (readonly [internode: number, place: Vec3])[]): void {
    const before = this.touches;
    const wanted = new Map<number, Touch>();
    for (const [internode, place] of targets) {
      if (!Number.isInteger(internode) || internode < 1 || internode >= this.chain.internodes) continue;
      const isPlace = place.every(Number.isFinite);
      const touch = isPlace ? { internode, place } : before.find((other) => other.internode === internode);
      if (touch) wanted.set(internode, touch);
    }
    this.touches = [...wanted.values()].sort((a, b) => a.internode - b.internode);
    this.solve(STEPS_OF_AN_EVENT);
  }

  /** Brings the branch to rest under the touches of the last event, as they are lifted. */
  relax(): void {
    this.solve(STEPS_OF_REST);
  }

  /** How each internode of the path has moved. */
  motions(): BendMotion[] {
    return Array.from({ length: this.chain.internodes }, (_, internode) => ({
      rotation: this.rotation(internode),
      to: this.place(internode),
    }));
  }

  private rotation(internode: number): BendMotion["rotation"] {
    const { prisms } = this;
    const { prism, share } = this.chain.middle(internode);
    const at = PRISM_SIZE * prism + 3;
    let [x, y, z, w] = [prisms[at]!, prisms[at + 1]!, prisms[at + 2]!, prisms[at + 3]!];
    if (share !== 0) {
      const to = at + PRISM_SIZE;
      const dot = x * prisms[to]! + y * prisms[to + 1]! + z * prisms[to + 2]! + w * prisms[to + 3]!;
      const other = dot < 0 ? -share : share;
      x += other * prisms[to]! - share * x;
      y += other * prisms[to + 1]! - share * y;
      z += other * prisms[to + 2]! - share * z;
      w += other * prisms[to + 3]! - share * w;
      const length = Math.sqrt(x * x + y * y + z * z + w * w);
      [x, y, z, w] = [x / length, y / length, z / length, w / length];
    }
    return 2 * Math.sqrt(x * x + y * y + z * z) < REST ? [0, 0, 0, 1] : [x, y, z, w];
  }

  private place(internode: number): Vec3 {
    const { chain } = this;
    const { prism, share } = chain.end(internode);
    const node = chain.node(internode + 1);
    const here = this.moved(prism, node);
    if (share !== 0) {
      const there = this.moved(prism + 1, node);
      for (let i = 0; i < 3; i += 1) here[i]! += share * (there[i]! - here[i]!);
    }
    const [x, y, z] = here as [number, number, number];
    const away = Math.sqrt((x - node[0]) ** 2 + (y - node[1]) ** 2 + (z - node[2]) ** 2);
    return away < REST * chain.length ? node : [x, y, z];
  }

  /** Where a place would be if it moved with a prism. */
  private moved(prism: number, place: Vec3): number[] {
    const { centres } = this.chain;
    const arm = place.map((number, i) => number - centres[3 * prism + i]!);
    rotate(this.prisms, PRISM_SIZE * prism, arm, 0, arm, 0);
    return arm.map((number, i) => number + this.prisms[PRISM_SIZE * prism + i]!);
  }

  private solve(steps: number): void {
    const { chain } = this;
    if (chain.prisms < 2) return;
    const pulls = pullsOf(chain, this.touches);
    this.now.set(pulls, this.prisms);
    this.next.set(pulls, chain.rest);
    if (this.next.value < this.now.value) {
      [this.now, this.next] = [this.next, this.now];
      this.prisms.set(chain.rest);
    }
    for (let i = 0; i < steps; i += 1) {
      const step = this.now.step();
      if (!step || !this.descend(pulls, step) || this.isSmall(step)) break;
    }
  }

  /** Takes as much of a step as lowers the energy; false if nothing is to be gained any more. */
  private descend(pulls: readonly Pull[], step: Float64Array): boolean {
    const slope = this.now.slope(step);
    let turn = 0;
    for (let at = 0; at < step.length; at += 6) turn = Math.max(turn, length(step, at + 3));
    let share = turn > MOST_TURN ? MOST_TURN / turn : 1;
    for (let i = 0; i < TRIES; i += 1) {
      for (let at = 0, offset = PRISM_SIZE; at < step.length; at += 6, offset += PRISM_SIZE) {
        for (let k = 0; k < 3; k += 1) this.tried[offset + k] = this.prisms[offset + k]! + share * step[at + k]!;
        turnBy(this.prisms, offset, share, step, at + 3, this.tried);
      }
      this.next.set(pulls, this.tried);
      if (this.next.value <= this.now.value) {
        [this.now, this.next] = [this.next, this.now];
        [this.prisms, this.tried] = [this.tried, this.prisms];
        return true;
      }
      const beyondLine = this.next.value - this.now.value - share * slope;
      share *= Math.min(Math.max((-0.5 * share * slope) / beyondLine, 0.1), 0.5);
    }
    return false;
  }

  private isSmall(step: Float64Array): boolean {
    for (let at = 0; at < step.length; at += 6) {
      if (length(step, at) >= TOLERANCE * this.chain.length || length(step, at + 3) >= TOLERANCE) return false;
    }
    return true;
  }
}

function length(v: Float64Array, at: number): number {
  return Math.sqrt(v[at]! * v[at]! + v[at + 1]! * v[at + 1]! + v[at + 2]! * v[at + 2]!);
}
