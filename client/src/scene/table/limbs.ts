import { RADIUS_LOG_STEP } from "../../wire/generated";
import { grown } from "./column";

/** What is asked of the table. */
export interface Forks {
  readonly rows: number;
  readonly position: Float32Array;
  /** -1 for a seed. */
  readonly parent: Int32Array;
  /** The living row that continues the axis, or -1. */
  readonly successor: Int32Array;
  /** 0 for the dead. */
  readonly radiusCode: Uint16Array;
}

const NOBODY = -1;
/** A lateral so many codes thicker than its axis beyond the node has taken the lead. */
const LEADS = Math.ceil(Math.log(1.25) / RADIUS_LOG_STEP);
/** One at most so many codes thinner than an end that was cut goes on in its place. */
const REPLACES = Math.ceil(Math.log(1.6) / RADIUS_LOG_STEP);
/** Cosines of the sharpest turns that wood takes to follow a leader, and a lateral in the place of a cut. */
const TURN = 0.3;
const ELBOW = -0.2;

/**
 * Limbs as an eye sees them: at each fork the wood goes on into what is thickest, whichever axis that belongs to, and
 * everything else leaves it sideways.
 */
export class Limbs {
  /** The row that goes on as the same limb, or −1 where it ends. */
  onward = new Int32Array(0);
  /** 1 where a row begins a limb of its own. */
  begins = new Uint8Array(0);
  /** Living laterals of each node, as a list. */
  private first = new Int32Array(0);
  private next = new Int32Array(0);
  /** The node in whose list a row is. */
  private bearer = new Int32Array(0);
  private readonly stale: number[] = [];
  private noted = new Uint8Array(0);

  reserve(rows: number): void {
    this.onward = grown(this.onward, rows);
    this.begins = grown(this.begins, rows);
    this.first = grown(this.first, rows);
    this.next = grown(this.next, rows);
    this.bearer = grown(this.bearer, rows);
    this.noted = grown(this.noted, rows);
  }

  /** A row is there of which nothing is known yet. */
  welcome(row: number): void {
    this.onward[row] = NOBODY;
    this.begins[row] = 1;
    this.first[row] = NOBODY;
    this.next[row] = NOBODY;
    this.bearer[row] = NOBODY;
  }

  /** A living lateral stands at a node. */
  bear(node: number, lateral: number): void {
    this.leave(lateral);
    this.bearer[lateral] = node;
    this.next[lateral] = this.first[node]!;
    this.first[node] = lateral;
    this.begins[lateral] = 1;
    this.touch(node);
  }

  /** A row is no lateral, or lives no more. */
  leave(lateral: number): void {
    const node = this.bearer[lateral]!;
    if (node === NOBODY) return;
    this.bearer[lateral] = NOBODY;
    let at = this.first[node]!;
    if (at === lateral) this.first[node] = this.next[lateral]!;
    while (at !== NOBODY && this.next[at] !== lateral) at = this.next[at]!;
    if (at !== NOBODY) this.next[at] = this.next[lateral]!;
    this.next[lateral] = NOBODY;
    this.touch(node);
  }

  /** Visits the living laterals of a node. */
  eachLateral(node: number, visit: (row: number) => void): void {
    for (let lateral = this.first[node]!; lateral !== NOBODY; lateral = this.next[lateral]!) visit(lateral);
  }

  /** What a node bears has changed, in width, place or number. */
  touch(node: number): void {
    if (this.noted[node] === 1) return;
    this.noted[node] = 1;
    this.stale.push(node);
  }

  /** Judges all forks that have changed; tells of each row that is another part of its limb than before. */
  judge(table: Forks, changed: (row: number) => void): void {
    for (const node of this.stale) {
      this.noted[node] = 0;
      if (node >= table.rows) continue;
      const before = this.onward[node]!;
      const now = this.heir(table, node);
      if (now === before && (now === NOBODY || this.begins[now] === 0)) continue;
      this.onward[node] = now;
      changed(node);
      const left = before < table.rows ? before : NOBODY;
      if (left !== NOBODY && left !== now && table.parent[left] === node) {
        this.begins[left] = 1;
        changed(left);
      }
      if (now === NOBODY) continue;
      // What the axis itself goes on with leaves the limb where a lateral leads.
      const successor = table.successor[node]!;
      if (successor >= 0 && successor !== now) {
        this.begins[successor] = 1;
        changed(successor);
      }
      this.begins[now] = 0;
      changed(now);
    }
    this.stale.length = 0;
  }

  private heir(table: Forks, node: number): number {
    const successor = table.successor[node]!;
    if (table.parent[node]! < 0) return successor;
    const { radiusCode } = table;
    const least = successor >= 0 ? radiusCode[successor]! + LEADS : radiusCode[node]! - REPLACES;
    const sharpest = successor >= 0 ? TURN : ELBOW;
    let heir = successor;
    let thickest = least - 1;
    for (let lateral = this.first[node]!; lateral !== NOBODY; lateral = this.next[lateral]!) {
      const code = radiusCode[lateral]!;
      if (code < thickest || (code === thickest && lateral > heir)) continue;
      if (turnAt(table, node, lateral) < sharpest) continue;
      heir = lateral;
      thickest = code;
    }
    return heir;
  }
}

/** The cosine of the angle by which the way to a row turns at the node below it. */
function turnAt({ position, parent }: Forks, node: number, row: number): number {
  const below = parent[node]!;
  let [along, before, after] = [0, 0, 0];
  for (let axis = 0; axis < 3; axis += 1) {
    const a = position[3 * node + axis]! - position[3 * below + axis]!;
    const b = position[3 * row + axis]! - position[3 * node + axis]!;
    along += a * b;
    before += a * a;
    after += b * b;
  }
  return along / Math.sqrt(Math.max(before * after, 1e-12));
}
