import { type Camera, Frustum, Matrix4, Mesh, type Object3D, type RawShaderMaterial, Sphere, Vector3 } from "three";
import { BlockGeometry } from "../block-geometry";
import { TUFT_BLADES } from "../glsl/blades";
import { ItemTexture } from "../item-texture";
import { leafHash } from "../leaf-hash";
import type { Fineness } from "../rendering/fineness";
import { Covered } from "./covered";
import { DRY_GRASS, grassAt, TALLEST_GRASS } from "./meadow";

/** Tufts at most. */
export const MOST_TUFTS = 26_000;
/** Side of the square in which one stands, in internodes, and squares of a block along each side. */
const CELL = 0.42;
const BLOCK = 16;
/** Grass is not drawn where it is fewer pixels tall than this. */
const SEEN = 4;
/** And none is drawn beyond this, in internodes. */
const FARTHEST = 340;
/** Over the last share of the way to where it ends it shrinks away. */
const SHRINKS = 0.35;
/** Joints of a blade: two sides at each but the last. */
const JOINTS = [0, 0.55, 1] as const;

/** Tufts of grass around where the eye looks: those of the same squares whenever they are seen, fewer with distance. */
export class Tufts {
  readonly mesh: Mesh;
  private readonly geometry = new BlockGeometry();
  private readonly items = new ItemTexture(Float32Array, 1);
  /** Where none grow. */
  private covered = new Covered();
  /** Whether they stand here and there alone, as they do on sand. */
  sparse = false;
  /** What they were placed for. */
  private seen = "";

  constructor(material: RawShaderMaterial) {
    const { numbers, index } = tuft();
    this.geometry.shape("blade", numbers, 3, index);
    this.items.enter(material);
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    // The ground behind them is never shaded.
    this.mesh.renderOrder = 0.5;
  }

  /** Tufts that are drawn. */
  get count(): number {
    return this.items.count;
  }

  /** These lie on the ground. */
  cover(bodies: readonly Object3D[]): void {
    this.covered = Covered.under(bodies, CELL);
    this.seen = "";
  }

  /** Places them for a picture that stays, or shows none. */
  detail({ pixels, detailed }: Fineness, camera: Camera, shown: boolean): void {
    this.mesh.visible = shown && detailed;
    if (!this.mesh.visible) return;
    const sight = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const seen = `${sight.elements.map((value) => value.toPrecision(6))} ${Math.round(pixels)} ${this.sparse}`;
    if (seen === this.seen) return;
    this.seen = seen;
    const { x, y, z } = camera.position;
    const found = tuftsAt([x, y, z], sight, pixels / SEEN, this.covered, this.sparse);
    this.items.reserve(found.length / 4);
    this.items.numbers.set(found);
    if (found.length > 0) this.items.touch(0, found.length / 4);
    this.items.upload(found.length / 4);
    this.geometry.draw(found.length / 4);
    this.mesh.visible = found.length > 0;
  }

  /** A restored context has lost the texture. */
  restored(): void {
    this.items.uploadWhole();
  }

  dispose(): void {
    this.items.dispose();
    this.geometry.dispose();
  }
}

/** Of the tufts that an eye sees, those an internode tall as far as `reach`: place across, a random number, and how tall each is. */
export function tuftsAt(
  eye: readonly [number, number, number],
  sight: Matrix4,
  reach: number,
  covered = new Covered(),
  sparse = false,
): Float32Array<ArrayBuffer> {
  const found: number[] = [];
  const side = CELL * BLOCK;
  const reachAt = (x: number, z: number) => Math.min(FARTHEST, reach * (sparse ? DRY_GRASS : grassAt(x, z)));
  const farthest = Math.min(FARTHEST, reach * TALLEST_GRASS);
  const across = Math.sqrt(Math.max(0, farthest * farthest - eye[1] * eye[1]));
  if (across === 0) return new Float32Array(0);
  const frustum = new Frustum().setFromProjectionMatrix(sight);
  const ball = new Sphere(new Vector3(), 0.75 * side + 1);
  const blocks: [distance: number, i: number, k: number][] = [];
  const [first, last] = [-across, across].map((by) => Math.floor((eye[0] + by) / side)) as [number, number];
  const [near, far] = [-across, across].map((by) => Math.floor((eye[2] + by) / side)) as [number, number];
  for (let k = near; k <= far; k += 1) {
    for (let i = first; i <= last; i += 1) {
      ball.center.set((i + 0.5) * side, 0, (k + 0.5) * side);
      if (frustum.intersectsSphere(ball)) {
        blocks.push([Math.hypot(ball.center.x - eye[0], eye[1], ball.center.z - eye[2]), i, k]);
      }
    }
  }
  // So many would stand in what is seen; if they are too many, each has so much less of a chance.
  const dense = blocks.reduce((sum, [distance, i, k]) => {
    const all = distance / reachAt((i + 0.5) * side, (k + 0.5) * side);
    return sum + (all < 1 ? BLOCK * BLOCK * thinned(all) : 0);
  }, 0);
  const share = Math.min(1, (0.92 * MOST_TUFTS) / Math.max(1, sparse ? dense / 20 : dense));
  for (const [distance, i, k] of blocks.sort((a, b) => a[0] - b[0])) {
    const bunch = sparse ? bunchOf(i, k) : null;
    if (bunch?.[2] === 0) continue;
    // No tuft of this block has more of a chance: most are left out by this alone.
    const most = share * thinned(Math.max(0, distance - side) / farthest);
    for (let cell = 0; cell < BLOCK * BLOCK; cell += 1) {
      const column = i * BLOCK + (cell % BLOCK);
      const line = k * BLOCK + Math.floor(cell / BLOCK);
      const hash = leafHash(leafHash(column) + line);
      const rank = ((hash >>> 20) & 1023) / 1023;
      if (rank >= most) continue;
      const x = (column + (hash & 1023) / 1023) * CELL;
      const z = (line + ((hash >>> 10) & 1023) / 1023) * CELL;
      if (bunch && Math.hypot(x / side - i - bunch[0], z / side - k - bunch[1]) > bunch[2]) continue;
      const far = Math.hypot(x - eye[0], eye[1], z - eye[2]) / reachAt(x, z);
      const chance = share * thinned(far);
      if (far > 1 || rank >= chance || covered.isBare(column, line)) continue;
      // The next to go with distance are small already, and all are where grass ends.
      const tall = Math.min(1, (chance - rank) / (0.25 * chance)) * Math.min(1, (1 - far) / SHRINKS);
      if (found.length < 4 * MOST_TUFTS) found.push(x, z, rank / chance, tall);
    }
  }
  return new Float32Array(found);
}

/** Where in a block of sparse ground tufts stand together, and how far from there, in shares of its side. */
function bunchOf(i: number, k: number): readonly [u: number, v: number, radius: number] {
  const hash = leafHash(leafHash(i + 7919) + k);
  const [u, v, w] = [hash & 255, (hash >>> 8) & 255, (hash >>> 16) & 255];
  // Most blocks bear none.
  return [0.2 + (0.6 * u) / 255, 0.2 + (0.6 * v) / 255, w < 185 ? 0 : 0.04 + (0.13 * (w - 185)) / 70];
}

/** How many of all tufts are drawn at a share of the way to where they end. */
function thinned(share: number): number {
  return 1 / (1 + 14 * share * share);
}

/** The vertices of a tuft, and its triangles. */
function tuft(): { numbers: number[]; index: number[] } {
  const numbers: number[] = [];
  const index: number[] = [];
  for (let blade = 0; blade < TUFT_BLADES; blade += 1) {
    for (const [joint, along] of JOINTS.entries()) {
      const at = numbers.length / 3;
      if (along === 1) {
        numbers.push(blade, 0, 1);
        index.push(at - 2, at - 1, at);
      } else {
        numbers.push(blade, -1, along, blade, 1, along);
        if (joint > 0) index.push(at - 2, at - 1, at, at - 1, at + 1, at);
      }
    }
  }
  return { numbers, index };
}
