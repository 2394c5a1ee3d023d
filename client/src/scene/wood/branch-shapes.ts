import { BlockGeometry } from "../block-geometry";

/** How wide the rings of a cut end are, from its rim to its middle, in radii. */
const FACE: readonly number[] = [1, 0.97, 0.88, 0.5, 0];

/**
 * A tube without ends: cosine, place along, sine, turn; the last side is the first again with another turn. A polygon
 * is a little wider than the circle it stands for, so that its outline is as wide as the circle's on the average.
 */
export function tube(sides: number, segments: number): BlockGeometry {
  const wide = Math.PI / (sides * Math.sin(Math.PI / sides));
  return lattice(sides, segments, (turn, place) => {
    const angle = 2 * Math.PI * turn;
    return [wide * Math.cos(angle), place, wide * Math.sin(angle), turn];
  });
}

/** A strip that faces the eye: side −1 or 1, place along. */
export function ribbon(segments: number): BlockGeometry {
  return lattice(1, segments, (turn, place) => [2 * turn - 1, place, 0, turn]);
}

/** The face of a cut end: as a tube, but the place is 1 at the rim to 2 in the middle. */
export function face(sides: number): BlockGeometry {
  return lattice(sides, FACE.length - 1, (turn, place) => {
    const angle = 2 * Math.PI * turn;
    return [Math.cos(angle), 2 - FACE[Math.round(place * (FACE.length - 1))]!, Math.sin(angle), turn];
  });
}

function lattice(
  sides: number,
  segments: number,
  vertex: (turn: number, place: number) => readonly number[],
): BlockGeometry {
  const vertices: number[] = [];
  const index: number[] = [];
  for (let ring = 0; ring <= segments; ring += 1) {
    for (let side = 0; side <= sides; side += 1) {
      vertices.push(...vertex(side / sides, ring / segments));
      if (ring === segments || side === sides) continue;
      const a = ring * (sides + 1) + side;
      index.push(a, a + sides + 1, a + 1, a + 1, a + sides + 1, a + sides + 2);
    }
  }
  return new BlockGeometry().shape("ring", vertices, 4, index);
}
