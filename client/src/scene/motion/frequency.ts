import { grown } from "../table/column";

/** Numbers of a station: length, m; how much it bends under 1 Nm, rad; its own mass, kg, and drag area, m². */
const [LENGTH, SOFTNESS, MASS, AREA] = [0, 1, 2, 3];
/** Of what its node bears sideways: mass with its moment of inertia, kg m²; drag area with its second moment, m⁴. */
const [BORNE_MASS, BORNE_INERTIA, BORNE_AREA, BORNE_SPREAD] = [4, 5, 6, 7];
const STATION = 8;
/** Where a bent station's middle and node have gone, and the slope of its node. */
const [MIDDLE, NODE, SLOPE] = [0, 1, 2];
const BENT = 3;

/** How a limb swings. */
export interface Mode {
  /** ω², s⁻². */
  readonly rate: number;
  /** Σ A y² / Σ m y² over the mode, m²/kg: how strongly air that moves past damps it. */
  readonly drag: number;
}

/** In place of the mode of a twig of one row, which is never a joint. */
export const RIGID: Mode = { rate: Number.POSITIVE_INFINITY, drag: 0 };

/**
 * The slowest mode of one limb: Rayleigh's quotient after one pass of Stodola's. The limb is a beam along its own arc, clamped
 * where it begins; what it bears sideways moves with its nodes.
 */
export class Stations {
  private count = 0;
  private numbers = new Float64Array(64 * STATION);
  private weighed = new Float64Array(64 * BENT);
  private swung = new Float64Array(64 * BENT);

  /** Begins another limb. */
  clear(): void {
    this.count = 0;
  }

  /** Adds the next row of the limb. */
  push(
    length: number,
    softness: number,
    mass: number,
    area: number,
    borneMass: number,
    borneInertia: number,
    borneArea: number,
    borneSpread: number,
  ): void {
    const at = STATION * this.count;
    this.count += 1;
    if (at + STATION > this.numbers.length) {
      this.numbers = grown(this.numbers, 2 * this.numbers.length);
      this.weighed = new Float64Array(2 * this.weighed.length);
      this.swung = new Float64Array(2 * this.swung.length);
    }
    const { numbers } = this;
    numbers[at + LENGTH] = length;
    numbers[at + SOFTNESS] = softness;
    numbers[at + MASS] = mass;
    numbers[at + AREA] = area;
    numbers[at + BORNE_MASS] = borneMass;
    numbers[at + BORNE_INERTIA] = borneInertia;
    numbers[at + BORNE_AREA] = borneArea;
    numbers[at + BORNE_SPREAD] = borneSpread;
  }

  /** Of no use for a limb without stations, length or mass. */
  slowest(): Mode {
    const { numbers: s, weighed: a, swung: b, count } = this;
    for (let i = 0; i < BENT * count; i += BENT) {
      a[i + MIDDLE] = 1;
      a[i + NODE] = 1;
      a[i + SLOPE] = 0;
    }
    // Bent under its weight sideways first, then under that pose times its masses.
    this.deflect(a, a);
    this.deflect(a, b);
    let work = 0;
    let inertia = 0;
    let drag = 0;
    for (let i = 0; i < count; i += 1) {
      const at = STATION * i;
      const bent = BENT * i;
      const mass = s[at + MASS]!;
      const borne = s[at + BORNE_MASS]!;
      const turned = s[at + BORNE_INERTIA]!;
      const mid = b[bent + MIDDLE]!;
      const node = b[bent + NODE]!;
      const slope = b[bent + SLOPE]!;
      work += mass * a[bent + MIDDLE]! * mid + borne * a[bent + NODE]! * node + turned * a[bent + SLOPE]! * slope;
      inertia += mass * mid * mid + borne * node * node + turned * slope * slope;
      drag += s[at + AREA]! * mid * mid + s[at + BORNE_AREA]! * node * node + s[at + BORNE_SPREAD]! * slope * slope;
    }
    return { rate: work / inertia, drag: drag / inertia };
  }

  /** Bends the limb under its masses times accelerations across it, which may lie where the answer does. */
  private deflect(by: Float64Array, bent: Float64Array): void {
    const { numbers: s, count } = this;
    // Beyond the node: all force, and its moment about the node.
    let force = 0;
    let moment = 0;
    for (let i = count - 1; i >= 0; i -= 1) {
      const at = STATION * i;
      const to = BENT * i;
      const own = s[at + MASS]! * by[to + MIDDLE]!;
      force += s[at + BORNE_MASS]! * by[to + NODE]!;
      moment += s[at + BORNE_INERTIA]! * by[to + SLOPE]!;
      // Held here until the forward pass: the turn of this station.
      bent[to + SLOPE] = s[at + SOFTNESS]! * (moment + (0.5 * force + own / 6) * s[at + LENGTH]!);
      moment += (force + 0.5 * own) * s[at + LENGTH]!;
      force += own;
    }
    let place = 0;
    let slope = 0;
    for (let i = 0; i < count; i += 1) {
      const length = s[STATION * i + LENGTH]!;
      const to = BENT * i;
      const turn = bent[to + SLOPE]!;
      bent[to + MIDDLE] = place + (0.5 * slope + 0.125 * turn) * length;
      place += (slope + 0.5 * turn) * length;
      slope += turn;
      bent[to + NODE] = place;
      bent[to + SLOPE] = slope;
    }
  }
}
