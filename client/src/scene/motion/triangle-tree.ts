import type { Vec3 } from "../vector";

/** Triangles of a leaf of the tree. */
const LEAF = 4;
/** Nodes that are still to be looked at, at most: a level has one of them, and there are not as many levels. */
const DEEPEST = 64;
/** Cells along each axis of the curve by which triangles are put in order. */
const CELLS = 1024;
/** A triangle whose normal is nearer than 26° to the vertical is flat: land, and not a wall. */
const FLAT = 0.9;
/** More triangles than there are, as a power of two: a place on the curve and a number are one number. */
const NUMBERS = 2 ** 22;
/** Numbers of a triangle, and of a box: low x y z, high x y z. */
const CORNERS = 9;
const BOX = 6;

/** A ray in the axes of the triangles that it looks for, x y z each; its way has unit length. */
export interface Ray {
  readonly from: Float64Array;
  readonly way: Float64Array;
  /** What is farther does not count. */
  reach: number;
  /** The unit vector upwards. */
  up: Vec3;
  /** Flat triangles count where this is exceeded along `up`, seen from the origin of the triangles. */
  land: number;
}

/** Triangles around their own origin in a tree of boxes, so that a ray looks at few of them. */
export class TriangleTree {
  /** Corners of each, x y z, in the order of a space-filling curve. */
  readonly corners: Float32Array;
  readonly count: number;
  /** Of node 1, which holds all; below node n are 2n and 2n + 1, and the second half are leaves. */
  private readonly boxes: Float32Array;
  private readonly leaves: number;
  private readonly open = new Int32Array(DEEPEST);
  private readonly since = new Float64Array(DEEPEST);
  private readonly inverse = new Float64Array(3);

  /** Of places that are multiplied by a scale, and the numbers of three of them for each triangle. */
  constructor(positions: Float32Array, triangles: Uint32Array, scale: number) {
    const scaled = positions.map((each) => each * scale);
    const given = cornersOf(scaled, triangles);
    this.count = given.length / CORNERS;
    this.corners = inOrder(given);
    this.leaves = 1;
    while (this.leaves < Math.ceil(this.count / LEAF)) this.leaves *= 2;
    this.boxes = new Float32Array(2 * this.leaves * BOX);
    this.bound();
  }

  /** The box around all of them. */
  get bounds(): Float32Array {
    return this.boxes.subarray(BOX, 2 * BOX);
  }

  /** How far away a ray first meets one; infinitely where it meets none within its reach. */
  first(ray: Ray): number {
    const { leaves, open, since, count } = this;
    for (let axis = 0; axis < 3; axis += 1) this.inverse[axis] = 1 / ray.way[axis]!;
    let nearest = ray.reach;
    let met = false;
    let waiting = 0;
    const wait = (node: number, from: number) => {
      if (from === Number.POSITIVE_INFINITY) return;
      open[waiting] = node;
      since[waiting] = from;
      waiting += 1;
    };
    wait(1, this.enters(1, ray.from, nearest));
    while (waiting > 0) {
      waiting -= 1;
      const node = open[waiting]!;
      if (since[waiting]! > nearest) continue;
      if (node < leaves) {
        const one = this.enters(2 * node, ray.from, nearest);
        const other = this.enters(2 * node + 1, ray.from, nearest);
        // The nearer one is looked at first.
        if (one < other) {
          wait(2 * node + 1, other);
          wait(2 * node, one);
        } else {
          wait(2 * node, one);
          wait(2 * node + 1, other);
        }
        continue;
      }
      const begin = LEAF * (node - leaves);
      const end = Math.min(count, begin + LEAF);
      for (let triangle = begin; triangle < end; triangle += 1) {
        const away = meets(this.corners, CORNERS * triangle, ray);
        if (away < nearest) {
          nearest = away;
          met = true;
        }
      }
    }
    return met ? nearest : Number.POSITIVE_INFINITY;
  }

  /** From where on a ray is in a box, if it is before it has come so far; infinitely where not. */
  private enters(node: number, from: Float64Array, reach: number): number {
    const { boxes, inverse } = this;
    const at = BOX * node;
    // Comparisons with what is not a number do not decide.
    let enters = 0;
    let leaves = reach;
    for (let axis = 0; axis < 3; axis += 1) {
      const by = inverse[axis]!;
      const turned = by < 0 ? 3 : 0;
      const near = (boxes[at + axis + turned]! - from[axis]!) * by;
      const far = (boxes[at + axis + 3 - turned]! - from[axis]!) * by;
      if (near > enters) enters = near;
      if (far < leaves) leaves = far;
    }
    // Nothing is below an empty box, which is as if turned inside out.
    return enters <= leaves && boxes[at]! <= boxes[at + 3]! ? enters : Number.POSITIVE_INFINITY;
  }

  private bound(): void {
    const { boxes, leaves, corners, count } = this;
    for (let node = 0; node < 2 * leaves; node += 1) {
      boxes.fill(Number.POSITIVE_INFINITY, BOX * node, BOX * node + 3);
      boxes.fill(Number.NEGATIVE_INFINITY, BOX * node + 3, BOX * node + BOX);
    }
    for (let corner = 0; corner < 3 * count; corner += 1) {
      const at = BOX * (leaves + Math.floor(corner / (3 * LEAF)));
      for (let axis = 0; axis < 3; axis += 1) {
        const value = corners[3 * corner + axis]!;
        if (value < boxes[at + axis]!) boxes[at + axis] = value;
        if (value > boxes[at + 3 + axis]!) boxes[at + 3 + axis] = value;
      }
    }
    for (let node = leaves - 1; node > 0; node -= 1) {
      for (let axis = 0; axis < 3; axis += 1) {
        const [at, one, other] = [BOX * node + axis, 2 * BOX * node + axis, 2 * BOX * node + BOX + axis];
        boxes[at] = Math.min(boxes[one]!, boxes[other]!);
        boxes[at + 3] = Math.max(boxes[one + 3]!, boxes[other + 3]!);
      }
    }
  }
}

/** Nine numbers for each triangle that has an area. */
function cornersOf(positions: Float32Array, triangles: Uint32Array): Float32Array {
  const corners = new Float32Array(3 * triangles.length);
  let used = 0;
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    for (let corner = 0; corner < 3; corner += 1) {
      for (let a = 0; a < 3; a += 1) corners[used + 3 * corner + a] = positions[3 * triangles[i + corner]! + a]!;
    }
    if (hasArea(corners, used)) used += CORNERS;
  }
  return corners.subarray(0, used);
}

function hasArea(corners: Float32Array, at: number): boolean {
  const [x, y, z] = [corners[at]!, corners[at + 1]!, corners[at + 2]!];
  const [ax, ay, az] = [corners[at + 3]! - x, corners[at + 4]! - y, corners[at + 5]! - z];
  const [bx, by, bz] = [corners[at + 6]! - x, corners[at + 7]! - y, corners[at + 8]! - z];
  const size = Math.abs(ay * bz - az * by) + Math.abs(az * bx - ax * bz) + Math.abs(ax * by - ay * bx);
  return size > 0 && Number.isFinite(size);
}

/** The same along a space-filling curve. */
function inOrder(corners: Float32Array): Float32Array {
  const count = corners.length / CORNERS;
  const least = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const most = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const middle = (triangle: number, axis: number) => {
    const at = CORNERS * triangle + axis;
    return corners[at]! + corners[at + 3]! + corners[at + 6]!;
  };
  for (let triangle = 0; triangle < count; triangle += 1) {
    for (let axis = 0; axis < 3; axis += 1) {
      least[axis] = Math.min(least[axis]!, middle(triangle, axis));
      most[axis] = Math.max(most[axis]!, middle(triangle, axis));
    }
  }
  const keys = new Float64Array(count);
  for (let triangle = 0; triangle < count; triangle += 1) {
    let code = 0;
    for (let axis = 0; axis < 3; axis += 1) {
      const size = most[axis]! - least[axis]!;
      const way = middle(triangle, axis) - least[axis]!;
      const cell = size > 0 ? Math.min(Math.floor((way / size) * CELLS), CELLS - 1) : 0;
      code |= spreadBits(cell) << axis;
    }
    keys[triangle] = code * NUMBERS + triangle;
  }
  keys.sort();
  const ordered = new Float32Array(corners.length);
  for (let place = 0; place < count; place += 1) {
    const from = CORNERS * (keys[place]! % NUMBERS);
    for (let i = 0; i < CORNERS; i += 1) ordered[CORNERS * place + i] = corners[from + i]!;
  }
  return ordered;
}

/** Two zeros between each of ten bits and the next. */
function spreadBits(number: number): number {
  let spread = number & 0x3ff;
  spread = (spread | (spread << 16)) & 0x030000ff;
  spread = (spread | (spread << 8)) & 0x0300f00f;
  spread = (spread | (spread << 4)) & 0x030c30c3;
  return (spread | (spread << 2)) & 0x09249249;
}

/** How far away a ray meets a triangle from either side (Möller and Trumbore); infinitely where it does not. */
function meets(corners: Float32Array, at: number, { from, way, up, land }: Ray): number {
  const ax = corners[at]!;
  const ay = corners[at + 1]!;
  const az = corners[at + 2]!;
  const ex = corners[at + 3]! - ax;
  const ey = corners[at + 4]! - ay;
  const ez = corners[at + 5]! - az;
  const fx = corners[at + 6]! - ax;
  const fy = corners[at + 7]! - ay;
  const fz = corners[at + 8]! - az;
  const wx = way[0]!;
  const wy = way[1]!;
  const wz = way[2]!;
  const px = wy * fz - fy * wz;
  const py = wz * fx - fz * wx;
  const pz = wx * fy - fx * wy;
  const size = ex * px + ey * py + ez * pz;
  if (size === 0) return Number.POSITIVE_INFINITY;
  const sx = from[0]! - ax;
  const sy = from[1]! - ay;
  const sz = from[2]! - az;
  const u = (sx * px + sy * py + sz * pz) / size;
  if (!(u >= 0 && u <= 1)) return Number.POSITIVE_INFINITY;
  const qx = sy * ez - ey * sz;
  const qy = sz * ex - ez * sx;
  const qz = sx * ey - ex * sy;
  const v = (wx * qx + wy * qy + wz * qz) / size;
  if (v < 0 || u + v > 1) return Number.POSITIVE_INFINITY;
  const away = (fx * qx + fy * qy + fz * qz) / size;
  if (!(away > 0)) return Number.POSITIVE_INFINITY;
  const nx = ey * fz - fy * ez;
  const ny = ez * fx - fz * ex;
  const nz = ex * fy - fx * ey;
  const upwards = nx * up[0] + ny * up[1] + nz * up[2];
  if (upwards * upwards <= FLAT * FLAT * (nx * nx + ny * ny + nz * nz)) return away;
  const height = (from[0]! + away * wx) * up[0] + (from[1]! + away * wy) * up[1] + (from[2]! + away * wz) * up[2];
  return height < land ? Number.POSITIVE_INFINITY : away;
}
