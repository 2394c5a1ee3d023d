/** Numbers of a block, row by row. */
const BLOCK = 36;
const SINGULAR = 1e-15;

/**
 * A symmetric system of 6 × 6 blocks, each coupled to the next: for each prism its shift, then its turn.
 * `rows` hold half the second derivatives, `gradients` half the gradient.
 */
export class Tridiagonal {
  /** Lower triangles of the blocks on the diagonal. */
  private readonly diagonals: Float64Array;
  /** The blocks to the left of them. */
  private readonly lefts: Float64Array;
  readonly gradients: Float64Array;
  private readonly lowers: Float64Array;
  private readonly factors: Float64Array;
  private readonly solution: Float64Array;

  constructor(private readonly blocks: number) {
    this.diagonals = new Float64Array(BLOCK * blocks);
    this.lefts = new Float64Array(BLOCK * blocks);
    this.gradients = new Float64Array(6 * blocks);
    this.lowers = new Float64Array(BLOCK * blocks);
    this.factors = new Float64Array(BLOCK * blocks);
    this.solution = new Float64Array(6 * blocks);
  }

  clear(): void {
    this.diagonals.fill(0);
    this.lefts.fill(0);
    this.gradients.fill(0);
  }

  /** Adds to a gradient weight · (r, s × r), where s is the arm at `at`. */
  addPull(row: number, weight: number, arms: Float64Array, at: number, r: Float64Array): void {
    const g = this.gradients;
    const [x, y, z] = [arms[at]!, arms[at + 1]!, arms[at + 2]!];
    const [rx, ry, rz] = [r[0]!, r[1]!, r[2]!];
    const i = 6 * row;
    g[i]! += weight * rx;
    g[i + 1]! += weight * ry;
    g[i + 2]! += weight * rz;
    g[i + 3]! += weight * (y * rz - z * ry);
    g[i + 4]! += weight * (z * rx - x * rz);
    g[i + 5]! += weight * (x * ry - y * rx);
  }

  /** Adds weight · JᵀJ for J = (1, −[arm]×), and the tension that keeps the arm from turning aside. */
  addSquare(row: number, weight: number, tension: number, arms: Float64Array, at: number): void {
    const d = this.diagonals;
    const [x, y, z] = [arms[at]!, arms[at + 1]!, arms[at + 2]!];
    const square = x * x + y * y + z * z;
    const along = weight + (tension > 0 ? tension / square : 0);
    const across = weight * square + (tension > 0 ? tension : 0);
    const i = BLOCK * row;
    d[i]! += weight;
    d[i + 7]! += weight;
    d[i + 14]! += weight;
    d[i + 19]! -= weight * z;
    d[i + 20]! += weight * y;
    d[i + 24]! += weight * z;
    d[i + 26]! -= weight * x;
    d[i + 30]! -= weight * y;
    d[i + 31]! += weight * x;
    d[i + 21]! += across - along * x * x;
    d[i + 27]! -= along * y * x;
    d[i + 28]! += across - along * y * y;
    d[i + 33]! -= along * z * x;
    d[i + 34]! -= along * z * y;
    d[i + 35]! += across - along * z * z;
  }

  /** Adds weight · J₂ᵀJ₁, with the arm of the prism before at 0 and that of this one at 3. */
  addProduct(row: number, weight: number, arms: Float64Array): void {
    const b = this.lefts;
    const [ax, ay, az] = [arms[0]!, arms[1]!, arms[2]!];
    const [bx, by, bz] = [arms[3]!, arms[4]!, arms[5]!];
    const dot = ax * bx + ay * by + az * bz;
    const i = BLOCK * row;
    b[i]! += weight;
    b[i + 7]! += weight;
    b[i + 14]! += weight;
    b[i + 4]! += weight * az;
    b[i + 5]! -= weight * ay;
    b[i + 9]! -= weight * az;
    b[i + 11]! += weight * ax;
    b[i + 15]! += weight * ay;
    b[i + 16]! -= weight * ax;
    b[i + 19]! -= weight * bz;
    b[i + 20]! += weight * by;
    b[i + 24]! += weight * bz;
    b[i + 26]! -= weight * bx;
    b[i + 30]! -= weight * by;
    b[i + 31]! += weight * bx;
    b[i + 21]! += weight * (dot - ax * bx);
    b[i + 22]! -= weight * ax * by;
    b[i + 23]! -= weight * ax * bz;
    b[i + 27]! -= weight * ay * bx;
    b[i + 28]! += weight * (dot - ay * by);
    b[i + 29]! -= weight * ay * bz;
    b[i + 33]! -= weight * az * bx;
    b[i + 34]! -= weight * az * by;
    b[i + 35]! += weight * (dot - az * bz);
  }

  /** Adds the joint between prisms `row` − 1 and `row` that turns by the quaternion x, y, z, w; row −1 is the base. */
  addTurn(row: number, weight: number, x: number, y: number, z: number, w: number): void {
    const { gradients: g, diagonals: d, lefts: b } = this;
    const pull = -4 * weight * w;
    g[6 * row + 3]! += pull * x;
    g[6 * row + 4]! += pull * y;
    g[6 * row + 5]! += pull * z;
    for (let k = 21; k < BLOCK; k += 7) d[BLOCK * row + k]! += 2 * weight;
    if (row === 0) return;
    g[6 * row - 3]! -= pull * x;
    g[6 * row - 2]! -= pull * y;
    g[6 * row - 1]! -= pull * z;
    for (let k = 21; k < BLOCK; k += 7) d[BLOCK * (row - 1) + k]! += 2 * weight;
    const xx = 1 - 2 * (y * y + z * z);
    const yy = 1 - 2 * (x * x + z * z);
    const zz = 1 - 2 * (x * x + y * y);
    const i = BLOCK * row;
    b[i + 21]! -= weight * (yy + zz);
    b[i + 22]! += weight * 2 * (x * y - w * z);
    b[i + 23]! += weight * 2 * (x * z + w * y);
    b[i + 27]! += weight * 2 * (x * y + w * z);
    b[i + 28]! -= weight * (xx + zz);
    b[i + 29]! += weight * 2 * (y * z - w * x);
    b[i + 33]! += weight * 2 * (x * z - w * y);
    b[i + 34]! += weight * 2 * (y * z + w * x);
    b[i + 35]! -= weight * (xx + yy);
  }

  /** The minimum of the model; undefined if rounding has made the system singular. Valid until the next call. */
  solve(): Float64Array | undefined {
    for (let row = 0; row < this.blocks; row += 1) if (!this.factor(row)) return undefined;
    const { solution: x, lowers, factors } = this;
    for (let row = this.blocks - 1; row >= 0; row -= 1) {
      const [at, block] = [6 * row, BLOCK * row];
      if (row + 1 < this.blocks) {
        for (let i = 0; i < 6; i += 1) {
          let sum = x[at + i]!;
          for (let k = 0; k < 6; k += 1) sum -= factors[block + BLOCK + 6 * k + i]! * x[at + 6 + k]!;
          x[at + i] = sum;
        }
      }
      for (let i = 5; i >= 0; i -= 1) {
        let sum = x[at + i]!;
        for (let k = i + 1; k < 6; k += 1) sum -= lowers[block + 6 * k + i]! * x[at + k]!;
        x[at + i] = sum * lowers[block + 7 * i]!;
      }
    }
    return x;
  }

  /** Cholesky's factor of one row of blocks, with the reciprocals of its diagonal; its right side goes to `solution`. */
  private factor(row: number): boolean {
    const { diagonals, lowers, factors, solution: x } = this;
    const [at, block] = [6 * row, BLOCK * row];
    for (let i = 0; i < BLOCK; i += 1) {
      lowers[block + i] = diagonals[block + i]!;
      factors[block + i] = this.lefts[block + i]!;
    }
    for (let i = 0; i < 6; i += 1) x[at + i] = -this.gradients[at + i]!;
    if (row > 0) {
      for (let i = 0; i < 6; i += 1) forward(lowers, block - BLOCK, factors, block + 6 * i);
      for (let i = 0; i < 6; i += 1) {
        for (let j = 0; j <= i; j += 1) {
          lowers[block + 6 * i + j]! -= dot(factors, block + 6 * i, factors, block + 6 * j, 6);
        }
        x[at + i]! -= dot(factors, block + 6 * i, x, at - 6, 6);
      }
    }
    for (let i = 0; i < 6; i += 1) {
      const line = block + 6 * i;
      for (let j = 0; j < i; j += 1) {
        const other = block + 6 * j;
        lowers[line + j] = (lowers[line + j]! - dot(lowers, line, lowers, other, j)) * lowers[other + j]!;
      }
      const square = lowers[line + i]! - dot(lowers, line, lowers, line, i);
      if (!(square > SINGULAR * diagonals[line + i]!)) return false;
      lowers[line + i] = 1 / Math.sqrt(square);
    }
    forward(lowers, block, x, at);
    return true;
  }
}

/** Solves L · x = b in place, with L at `block` and b at `at`. */
function forward(lowers: Float64Array, block: number, b: Float64Array, at: number): void {
  for (let i = 0; i < 6; i += 1) {
    b[at + i] = (b[at + i]! - dot(lowers, block + 6 * i, b, at, i)) * lowers[block + 7 * i]!;
  }
}

function dot(a: Float64Array, i: number, b: Float64Array, j: number, count: number): number {
  let sum = 0;
  for (let k = 0; k < count; k += 1) sum += a[i + k]! * b[j + k]!;
  return sum;
}
