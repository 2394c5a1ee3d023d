import { grown } from "./column";
import { LimbCurve, THIN } from "./limb-curve";

/** What is asked of the table. */
export interface Nodes {
  readonly rows: number;
  /** Where each metamer ends: x y z. */
  readonly position: Float32Array;
  /** -1 for a seed. */
  readonly parent: Int32Array;
  readonly limbs: { readonly onward: Int32Array; readonly begins: Uint8Array };
  readonly girth: { readonly radius: Float32Array };
  /** Visits the living rows that grow from a node. */
  eachChild(node: number, visit: (row: number) => void): void;
}

const AS_GIVEN = new Float64Array(3);
/** What is noted of a row until limbs are drawn anew: its node is another, its limb is. */
const NODE = 1;
const LIMB = 2;
const GIRTH = 4;
/** Nearer than this share of its radius to where it was, and less turned, thick wood stays. */
const SLACK = 0.012;
const SHORTEST = 1e-6;
/** Where more than this share of all rows has changed, all limbs are drawn anew. */
const MOST = 0.5;

/** How much a trunk spreads at its foot, by the height above the ground in radii: on the average around it. */
export function spread(flare: number, height: number): number {
  return 1 + flare * (0.22 * Math.exp(-0.7 * height) + 0.5 * Math.exp(-1.6 * height));
}

/**
 * Where wood is drawn. What is known of a tree, and what is picked and edited, are its nodes; where its girth is large for
 * how sharply they turn, a tube through them would fold through itself, so that it runs along a curve beside them
 * (`limb-curve.ts`). Nearly all wood is thin, and is drawn where its nodes are.
 */
export class Course {
  /** x y z of each node. */
  placed = new Float32Array(0);
  /** Across which its ring lies: x y z. */
  across = new Float32Array(0);
  /** Length along the limb from where it begins, along what is drawn. */
  arc = new Float32Array(0);
  private flare = 1;
  private rounded = true;
  private noted = new Uint8Array(0);
  /** 1 for first rows of limbs that are about to be drawn anew, and for seeds. */
  private due = new Uint8Array(0);
  private stale: number[] = [];
  /** What is drawn anew though no node was touched. */
  private anew: "nothing" | "trunks" | "all" = "nothing";
  /** Whether every limb is drawn anew. */
  private whole = false;
  private readonly curve = new LimbCurve();
  private readonly offset = new Float64Array(3);
  /** The rows of the limb at hand. */
  private limb = new Int32Array(64);

  reserve(rows: number): void {
    this.placed = grown(this.placed, 3 * rows);
    this.across = grown(this.across, 3 * rows);
    this.arc = grown(this.arc, rows);
    this.noted = grown(this.noted, rows);
    this.due = grown(this.due, rows);
  }

  /** A node has moved, or is another part of its limb. */
  touch(row: number): void {
    if ((this.noted[row]! & NODE) !== 0) return;
    this.noted[row]! |= NODE;
    this.stale.push(row);
  }

  /** It is otherwise thick: what it bears is as before, as long as the node is not drawn elsewhere. */
  thicken(row: number): void {
    if ((this.noted[row]! & (NODE | GIRTH)) !== 0) return;
    this.noted[row]! |= GIRTH;
    this.stale.push(row);
  }

  /** How far trunks spread at their feet, and whether corners are rounded; says whether anything changes by it. */
  shape(flare: number, rounded: boolean): boolean {
    if (flare === this.flare && rounded === this.rounded) return false;
    this.anew = rounded === this.rounded && this.anew !== "all" ? "trunks" : "all";
    this.flare = flare;
    this.rounded = rounded;
    return true;
  }

  /** Draws anew the limbs of all nodes touched, and those that go out from them; tells of each row drawn otherwise. */
  derive(table: Nodes, changed: (row: number) => void): void {
    const { noted, stale, due, anew } = this;
    const { parent } = table;
    const asked = stale.length;
    // Of a tree that has just come each limb is drawn: none has to be looked for.
    this.whole = anew === "all" || asked > MOST * table.rows;
    for (let i = 0; i < asked && !this.whole; i += 1) {
      const row = stale[i]!;
      if (row >= table.rows) continue;
      if ((noted[row]! & NODE) !== 0) this.bears(table, row);
      let at = row;
      while (parent[at]! >= 0 && (noted[at]! & LIMB) === 0 && !beginsLimb(table, at)) {
        noted[at]! |= LIMB;
        stale.push(at);
        at = parent[at]!;
      }
      if ((noted[at]! & LIMB) === 0) due[at] = 1;
    }
    if (this.whole || anew !== "nothing") {
      for (let row = 0; row < table.rows; row += 1) {
        const seed = parent[row]! < 0;
        const trunk = !seed && parent[parent[row]!]! < 0;
        if (trunk || (this.whole && (seed || table.limbs.begins[row] === 1))) due[row] = 1;
      }
    }
    // Limbs come after what bears them, and a search for the next is quick.
    for (let row = due.indexOf(1); row >= 0; row = due.indexOf(1, row + 1)) {
      due[row] = 0;
      if (parent[row]! < 0) this.stand(table, row);
      else this.draw(table, row, changed);
    }
    for (const row of stale) noted[row] = 0;
    stale.length = 0;
    this.anew = "nothing";
  }

  /** What goes out from a node begins elsewhere. */
  private bears(table: Nodes, node: number): void {
    if (this.whole) return;
    table.eachChild(node, (row) => {
      if (beginsLimb(table, row)) this.due[row] = 1;
    });
  }

  /** A seed lies where it is, and looks up until something grows from it. */
  private stand({ position }: Nodes, row: number): void {
    const at = 3 * row;
    for (let axis = 0; axis < 3; axis += 1) this.placed[at + axis] = position[at + axis]!;
    this.arc[row] = 0;
    this.across[at] = 0;
    this.across[at + 1] = 1;
    this.across[at + 2] = 0;
  }

  private draw(table: Nodes, first: number, changed: (row: number) => void): void {
    // The dead are not drawn.
    if (table.girth.radius[first] === 0) return;
    const { curve, placed, across, offset } = this;
    const { position, parent, limbs } = table;
    const origin = parent[first]!;
    const rises = parent[origin]! < 0;
    for (let axis = 0; axis < 3; axis += 1) offset[axis] = placed[3 * origin + axis]! - position[3 * origin + axis]!;
    const home = rises || (offset[0] === 0 && offset[1] === 0 && offset[2] === 0);
    if (!rises && home && this.thin(table, first)) {
      this.copy(table, first, changed);
      return;
    }
    const count = this.gather(table, first);
    if (rises) this.spread(table, first);
    curve.fit(rises ? AS_GIVEN : offset, table.girth.radius[origin]!, rises, this.rounded);
    let length = 0;
    for (let i = 1; i <= count; i += 1) {
      const row = this.limb[i]!;
      const radius = table.girth.radius[row]!;
      // Less than is seen is left as it is, or all that grows on a trunk would be written anew with each of its years.
      const moved = write(placed, row, curve.places, i, stays(curve, i) ? 0 : SLACK * radius);
      const turned = write(across, row, curve.directions, i, stays(curve, i) ? 0 : SLACK);
      length += distance(placed, this.limb[i - 1]!, row);
      if (moved) this.bears(table, row);
      if (this.measure(row, length) || moved || turned) changed(row);
    }
    if (rises && limbs.onward[origin] === first && write(across, origin, curve.directions, 0, 0)) changed(origin);
  }

  private measure(row: number, length: number): boolean {
    const arc = Math.fround(length);
    if (this.arc[row] === arc) return false;
    this.arc[row] = arc;
    return true;
  }

  /** Whether all of a limb is too thin to fold, and its bearer with it. */
  private thin({ position, limbs, girth, parent }: Nodes, first: number): boolean {
    for (let row = first; row >= 0; row = limbs.onward[row]!) {
      const node = parent[row]!;
      const thickest = row === first ? girth.radius[row]! : Math.max(girth.radius[row]!, girth.radius[node]!);
      if (thickest > THIN * distance(position, node, row)) return false;
    }
    return true;
  }

  /** Draws a limb where its nodes are. */
  private copy(table: Nodes, first: number, changed: (row: number) => void): void {
    const { placed, across } = this;
    const { position, parent, limbs } = table;
    let length = 0;
    let [x0, y0, z0] = [0, 0, 0];
    let begins = true;
    for (let row = first; row >= 0; ) {
      const next = limbs.onward[row]!;
      const at = 3 * row;
      if (begins) {
        const from = 3 * parent[row]!;
        x0 = position[at]! - position[from]!;
        y0 = position[at + 1]! - position[from + 1]!;
        z0 = position[at + 2]! - position[from + 2]!;
      }
      const before = Math.sqrt(x0 * x0 + y0 * y0 + z0 * z0);
      length += before;
      const [per, to] = [before < SHORTEST ? 0 : 1 / before, 3 * next];
      let [x, y, z] = [per * x0, per * y0, per * z0];
      if (next >= 0) {
        x0 = position[to]! - position[at]!;
        y0 = position[to + 1]! - position[at + 1]!;
        z0 = position[to + 2]! - position[at + 2]!;
        const after = Math.sqrt(x0 * x0 + y0 * y0 + z0 * z0);
        const other = after < SHORTEST ? 0 : 1 / after;
        const [sx, sy, sz] = [x + other * x0, y + other * y0, z + other * z0];
        const size = Math.sqrt(sx * sx + sy * sy + sz * sz);
        if (size >= SHORTEST) [x, y, z] = [sx / size, sy / size, sz / size];
      }
      if (x === 0 && y === 0 && z === 0) y = 1;
      const moved = put(placed, at, position[at]!, position[at + 1]!, position[at + 2]!);
      const turned = put(across, at, Math.fround(x), Math.fround(y), Math.fround(z));
      if (moved) this.bears(table, row);
      if (this.measure(row, length) || moved || turned) changed(row);
      begins = false;
      row = next;
    }
  }

  /** Copies the nodes of a limb to where the curve is fitted; gives how many there are but the one at which it begins. */
  private gather({ limbs, position, parent, girth }: Nodes, first: number): number {
    const { curve } = this;
    let count = 0;
    this.limb[0] = parent[first]!;
    for (let row = first; row >= 0; row = limbs.onward[row]!) {
      count += 1;
      if (count === this.limb.length) this.limb = grown(this.limb, 2 * count);
      this.limb[count] = row;
    }
    curve.reserve(count + 1);
    curve.count = count;
    for (let i = 0; i <= count; i += 1) {
      const row = this.limb[i]!;
      for (let axis = 0; axis < 3; axis += 1) curve.given[3 * i + axis] = position[3 * row + axis]!;
      // Wood begins as thick as its first node.
      curve.radii[i] = girth.radius[i === 0 ? first : row]!;
    }
    return count;
  }

  /** Roots make a foot as thick for a fold as the wood they spread from. */
  private spread({ girth }: Nodes, first: number): void {
    const { curve, flare } = this;
    const foot = girth.radius[first]! + 0.05;
    let along = 0;
    for (let i = 0; i <= curve.count; i += 1) {
      if (i > 0) {
        const [x, y, z] = [0, 1, 2].map((axis) => curve.given[3 * i + axis]! - curve.given[3 * i - 3 + axis]!);
        along += Math.hypot(x!, y!, z!);
      }
      curve.radii[i]! *= spread(flare, along / foot);
    }
  }
}

/** Whether a row is the first of a limb: whatever grows from a seed is. */
function beginsLimb({ limbs, parent }: Nodes, row: number): boolean {
  return limbs.begins[row] === 1 || parent[parent[row]!]! < 0;
}

/** Whether a node is drawn where it is. */
function stays({ places, given }: LimbCurve, i: number): boolean {
  return (
    places[3 * i] === given[3 * i] && places[3 * i + 1] === given[3 * i + 1] && places[3 * i + 2] === given[3 * i + 2]
  );
}

/** Writes a vector into a row if it is farther than `slack` from what is there; says whether it is. */
function write(out: Float32Array, row: number, from: Float64Array, i: number, slack: number): boolean {
  const [x, y, z] = [Math.fround(from[3 * i]!), Math.fround(from[3 * i + 1]!), Math.fround(from[3 * i + 2]!)];
  const at = 3 * row;
  const far = Math.max(Math.abs(out[at]! - x), Math.abs(out[at + 1]! - y), Math.abs(out[at + 2]! - z));
  return !(far <= slack) && put(out, at, x, y, z);
}

function put(out: Float32Array, at: number, x: number, y: number, z: number): boolean {
  if (out[at] === x && out[at + 1] === y && out[at + 2] === z) return false;
  out[at] = x;
  out[at + 1] = y;
  out[at + 2] = z;
  return true;
}

function distance(of: Float32Array, a: number, b: number): number {
  const [x, y, z] = [of[3 * b]! - of[3 * a]!, of[3 * b + 1]! - of[3 * a + 1]!, of[3 * b + 2]! - of[3 * a + 2]!];
  return Math.sqrt(x * x + y * y + z * z);
}
