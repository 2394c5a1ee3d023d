import type { Outline, Rib } from "./lamina";
import { TILE_MARGIN, TILE_SIDE } from "./measures";

/** What a place on a leaf looks like. */
export interface Paint {
  /** Brightness, 1 on average. */
  shade: number;
  /** 0 to 1: how far its colour is the second one. */
  tone: number;
  /** 0 to 1: how much light shines through. */
  sheer: number;
  /** 0 to 1: how far it is wood. */
  wood: number;
  /** Above the plane, in lengths of the leaf. */
  height: number;
  /** 0 inside, to 1 along the margin of a blade. */
  margin?: number;
}

/** One picture of a leaf, a flower or a fruit: x from −reach to reach, y from 0 to 1, with a margin around. */
export class LeafTile {
  readonly alpha: Float32Array;
  readonly shade: Float32Array;
  readonly tone: Float32Array;
  readonly sheer: Float32Array;
  readonly wood: Float32Array;
  readonly height: Float32Array;
  /** 0 inside, to 1 along the margin of a blade. */
  readonly margin: Float32Array;
  private readonly covered: Float32Array;

  constructor(
    readonly reach: number,
    readonly side: number = TILE_SIDE,
  ) {
    const texels = () => new Float32Array(side * side);
    this.alpha = texels();
    this.shade = texels();
    this.tone = texels();
    this.sheer = texels();
    this.wood = texels();
    this.height = texels();
    this.margin = texels();
    this.covered = texels();
  }

  /** Width and height of a texel in lengths of the leaf. */
  get texel(): readonly [number, number] {
    const span = (1 + 2 * TILE_MARGIN) / this.side;
    return [2 * this.reach * span, span];
  }

  /** Paints everything inside an outline, crossing lines counted as even and odd. */
  fill(outline: Outline, paint: (x: number, y: number) => Paint): void {
    const corners = outline.map(([x, y]) => [this.column(x), this.line(y)] as const);
    const low = Math.max(0, Math.floor(Math.min(...corners.map(([, y]) => y))));
    const high = Math.min(this.side - 1, Math.ceil(Math.max(...corners.map(([, y]) => y))));
    for (let line = low; line <= high; line += 1) {
      const first = line * this.side;
      this.covered.fill(0, first, first + this.side);
      for (let part = 0; part < SUBLINES; part += 1) this.cover(corners, first, line + (part + 0.5) / SUBLINES);
      for (let column = 0; column < this.side; column += 1) {
        const covered = this.covered[first + column]!;
        if (covered > 0) this.blend(first + column, Math.min(1, covered), paint(this.x(column), this.y(line)));
      }
    }
  }

  /** Paints a rib with round ends; the paint may depend on how far along it is and on which side, −1 to 1. */
  stroke({ from, to, width }: Rib, paint: (along: number, aside: number) => Paint): void {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const length2 = dx * dx + dy * dy || 1e-12;
    const [tx, ty] = this.texel;
    const soft = Math.max(tx, ty);
    const most = Math.max(...width) / 2 + soft;
    const left = Math.max(0, Math.floor(this.column(Math.min(from[0], to[0]) - most)));
    const right = Math.min(this.side - 1, Math.ceil(this.column(Math.max(from[0], to[0]) + most)));
    const low = Math.max(0, Math.floor(this.line(Math.min(from[1], to[1]) - most)));
    const high = Math.min(this.side - 1, Math.ceil(this.line(Math.max(from[1], to[1]) + most)));
    for (let line = low; line <= high; line += 1) {
      const py = this.y(line) - from[1];
      for (let column = left; column <= right; column += 1) {
        const px = this.x(column) - from[0];
        const along = Math.min(1, Math.max(0, (px * dx + py * dy) / length2));
        const half = (width[0] + (width[1] - width[0]) * along) / 2;
        const off = Math.hypot(px - along * dx, py - along * dy);
        const covered = (half - off) / soft + 0.5;
        if (covered <= 0) continue;
        const aside = (Math.sign(px * dy - py * dx) * Math.min(off, half)) / half;
        this.blend(line * this.side + column, Math.min(1, covered), paint(along, aside));
      }
    }
  }

  /** How much of what surrounds each texel is inside, 0 to 1: little of it near the margins. */
  depth(radius: number): Float32Array {
    const once = blurred(this.alpha, this.side, radius, 1);
    return blurred(once, this.side, radius, this.side);
  }

  /** Coordinates of a texel's centre. */
  x(column: number): number {
    return ((2 * (column + 0.5)) / this.side - 1) * this.reach * (1 + 2 * TILE_MARGIN);
  }

  y(line: number): number {
    return ((line + 0.5) / this.side) * (1 + 2 * TILE_MARGIN) - TILE_MARGIN;
  }

  private column(x: number): number {
    return ((x / (this.reach * (1 + 2 * TILE_MARGIN)) + 1) / 2) * this.side;
  }

  private line(y: number): number {
    return ((y + TILE_MARGIN) / (1 + 2 * TILE_MARGIN)) * this.side;
  }

  /** Adds to each texel of a line what share of it lies inside, along one height of it. */
  private cover(corners: readonly (readonly [number, number])[], first: number, height: number): void {
    const crossings: number[] = [];
    let [lastX, lastY] = corners[corners.length - 1]!;
    for (const [x, y] of corners) {
      if (lastY <= height !== y <= height) crossings.push(lastX + ((height - lastY) / (y - lastY)) * (x - lastX));
      [lastX, lastY] = [x, y];
    }
    crossings.sort((a, b) => a - b);
    for (let i = 0; i + 1 < crossings.length; i += 2) {
      const from = Math.max(0, crossings[i]!);
      const to = Math.min(this.side, crossings[i + 1]!);
      for (let column = Math.floor(from); column < to; column += 1) {
        const share = Math.min(to, column + 1) - Math.max(from, column);
        if (share > 0) this.covered[first + column]! += share / SUBLINES;
      }
    }
  }

  /** The texel at coordinates. */
  nearest(x: number, y: number): number {
    const inside = (place: number) => Math.min(this.side - 1, Math.max(0, Math.floor(place)));
    return inside(this.line(y)) * this.side + inside(this.column(x));
  }

  /** Lays paint over a texel, so much of which it covers. */
  blend(at: number, covered: number, { shade, tone, sheer, wood, height, margin = 0 }: Paint): void {
    const before = this.alpha[at]!;
    const after = covered + before * (1 - covered);
    const share = covered / after;
    this.alpha[at] = after;
    this.shade[at]! += (shade - this.shade[at]!) * share;
    this.tone[at]! += (tone - this.tone[at]!) * share;
    this.sheer[at]! += (sheer - this.sheer[at]!) * share;
    this.wood[at]! += (wood - this.wood[at]!) * share;
    this.height[at]! += (height - this.height[at]!) * share;
    this.margin[at]! += (margin - this.margin[at]!) * share;
  }
}

/** Heights at which each line of texels is cut. */
const SUBLINES = 4;

/** Means over 2·radius + 1 neighbours in one direction. */
function blurred(values: Float32Array, side: number, radius: number, stride: number): Float32Array {
  const out = new Float32Array(values.length);
  const across = stride === 1 ? side : 1;
  for (let lane = 0; lane < side; lane += 1) {
    const start = lane * across;
    let sum = 0;
    for (let i = -radius; i < side; i += 1) {
      if (i + radius < side) sum += values[start + (i + radius) * stride]!;
      if (i - radius - 1 >= 0) sum -= values[start + (i - radius - 1) * stride]!;
      if (i >= 0) out[start + i * stride] = sum / (2 * radius + 1);
    }
  }
  return out;
}
