import type { TriangleMesh } from "../obstacle-meshes";
import { type Envelope, surface } from "./envelope-surface";

/** How finely a shell is drawn: around it, and from its widest line to each of its ends. */
const AROUND = 32;
const RINGS = 9;

/** The surface of an envelope as triangles that face out. */
export function shellGeometry(envelope: Envelope): TriangleMesh {
  const shares: (readonly [number, boolean])[] = [];
  for (let ring = 0; ring < RINGS; ring += 1) {
    // Near the ends the surface turns most.
    shares.push([(ring / RINGS) ** 1.4, false]);
  }
  for (let ring = RINGS; ring >= 0; ring -= 1) {
    shares.push([(ring / RINGS) ** 1.4, true]);
  }
  const positions = new Float32Array(3 * AROUND * shares.length);
  shares.forEach(([share, upper], ring) => {
    for (let turn = 0; turn < AROUND; turn += 1) {
      positions.set(surface(envelope, (2 * Math.PI * turn) / AROUND, share, upper), 3 * (AROUND * ring + turn));
    }
  });
  const triangles: number[] = [];
  for (let ring = 0; ring + 1 < shares.length; ring += 1) {
    for (let turn = 0; turn < AROUND; turn += 1) {
      const next = (turn + 1) % AROUND;
      const [a, b] = [AROUND * ring + turn, AROUND * ring + next];
      triangles.push(a, a + AROUND, b, b, a + AROUND, b + AROUND);
    }
  }
  return { positions, triangles: Uint32Array.from(triangles) };
}
