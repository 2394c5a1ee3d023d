import type { Vec3 } from "../../../scene/vector";

/** How strokes are repeated: not, on the other side of the trunk, or around it. */
export const SYMMETRY_KINDS = ["off", "mirror", "around"] as const;
export type SymmetryKind = (typeof SYMMETRY_KINDS)[number];

/** How often a stroke may stand around the trunk. */
export const LEAST_AROUND = 2;
export const MOST_AROUND = 8;

export interface Symmetry {
  readonly kind: SymmetryKind;
  /** How often a stroke stands around the trunk. */
  readonly around: number;
  /** Whether each of those has a mirror image. */
  readonly mirrored: boolean;
}

/** What strokes are repeated about. */
export interface SymmetryCentre {
  /** The foot of the vertical axis. */
  readonly foot: Vec3;
  /** The horizontal normal of the mirror plane, of length one. */
  readonly mirrorNormal: Vec3;
}

/** One of the strokes that a finger draws: where it has what the finger draws at a place, or along a direction. */
export interface Copy {
  place(point: Vec3): Vec3;
  direction(vector: Vec3): Vec3;
}

export const OFF: Symmetry = { kind: "off", around: 4, mirrored: false };

/** The kind of symmetry that follows another one, as its key goes through them. */
export function nextKind(kind: SymmetryKind): SymmetryKind {
  return SYMMETRY_KINDS[(SYMMETRY_KINDS.indexOf(kind) + 1) % SYMMETRY_KINDS.length] ?? "off";
}

/** Whether something read from elsewhere is a symmetry. */
export function isSymmetry(value: unknown): value is Symmetry {
  const { kind, around, mirrored } = (value ?? {}) as Partial<Symmetry>;
  const isKind = SYMMETRY_KINDS.some((known) => known === kind);
  const isCount = Number.isInteger(around) && around! >= LEAST_AROUND && around! <= MOST_AROUND;
  return isKind && isCount && typeof mirrored === "boolean";
}

/** The stroke itself, and all its repetitions. */
export function copiesOf(
  { kind, around, mirrored }: Symmetry,
  { foot, mirrorNormal }: SymmetryCentre,
): readonly Copy[] {
  const turns = kind === "around" ? around : 1;
  const reflects = kind === "mirror" || (kind === "around" && mirrored);
  const sides = reflects ? [false, true] : [false];
  return Array.from({ length: turns }, (_, turn) =>
    sides.map((reflected) => copy(foot, mirrorNormal, (2 * Math.PI * turn) / turns, reflected)),
  ).flat();
}

/** Reflects in the vertical plane that `mirrorNormal` is normal to, then turns about the axis. */
function copy(foot: Vec3, mirrorNormal: Vec3, angle: number, reflected: boolean): Copy {
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  const direction = ([x, y, z]: Vec3): Vec3 => {
    const over = reflected ? 2 * (x * mirrorNormal[0] + z * mirrorNormal[2]) : 0;
    const [rx, rz] = [x - over * mirrorNormal[0], z - over * mirrorNormal[2]];
    return angle === 0 ? [rx, y, rz] : [rx * cos + rz * sin, y, rz * cos - rx * sin];
  };
  if (angle === 0 && !reflected) {
    return { place: (point) => point, direction };
  }
  return {
    place: ([x, y, z]) => {
      const [dx, , dz] = direction([x - foot[0], y, z - foot[2]]);
      return [foot[0] + dx, y, foot[2] + dz];
    },
    direction,
  };
}
