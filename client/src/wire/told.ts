import { FrameError } from "./frame-error";

/** What becomes of values by what frames tell of them (FR10, FR11). Mirrors `proto/src/frame/direction.rs`. */
export interface Told {
  /** Turns a parent's way into its child's, which three numbers tell; ways are differences to the position below. */
  turn(way: Int32Array, told: Int32Array, at: number, goesOn: boolean): void;
  radius(before: number, told: number): number;
  /** Modulo 256. */
  foliage(before: number, told: number): number;
  light(before: number, told: number): number;
}

/** The square of an internode's usual length, in steps of the position grid. */
const USUAL_SQUARE = 65_536;
/** What the square of a length is off by when its ends are rounded, and some more. */
const ROUNDED = 1024;

function within(value: number, most: number): number {
  if (value < 0 || value > most) throw new FrameError("A change leads out of the values that there are (FR11).");
  return value;
}

export const byFrames: Told = {
  turn(way, told, at, goesOn) {
    const [x, y, z] = [way[0]! ** 2, way[1]! ** 2, way[2]! ** 2];
    const square = x + y + z;
    const along = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const sign = way[along]! < 0 ? -1 : 1;
    let left = square === 0 || Math.abs(square - USUAL_SQUARE) <= ROUNDED ? USUAL_SQUARE : square;
    for (let part = 0; part < 2; part += 1) {
      const axis = (along + part + 1) % 3;
      way[axis] = told[at + part]! + (goesOn ? way[axis]! : 0);
      left -= way[axis]! ** 2;
    }
    way[along] = told[at + 2]! + sign * Math.round(Math.sqrt(Math.max(left, 0)));
  },
  radius: (before, told) => within(before + told, 0xffff),
  foliage: (before, told) => before + told,
  light(before, told) {
    const level = within((before >>> 3) + told, 31);
    return (level << 3) | (level >>> 2);
  },
};
