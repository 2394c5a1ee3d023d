import type { Vec3 } from "../vector";
import type { Joints } from "./joints";
import { angleAt, type Line, type Wind } from "./wind";

/** Pressure of air at 1 m/s, Pa: half its density. */
const PRESSURE = 0.6125;
/** Crowns streamline from this speed on, m/s: pressure goes on with a lower exponent (Vogel 1989). */
const STREAMLINED_FROM = 4;
const STREAMLINED = 1.3;
/** The furthest that a mean wind turns a joint, radians. */
const FURTHEST = 0.8;
/** Damping at most, so that what is plucked still swings. */
const MOST_DAMPED = 0.95;
const TAU = 2 * Math.PI;

/** The joints of which an answer is asked. */
export type SwayingJoints = Pick<Joints, "count" | "frequency" | "damping" | "drag" | "compliance" | "centre" | "area">;

/** What the user makes of wood. */
export interface Temper {
  /** So many times the damping of wood and company. */
  readonly damping: number;
  /** A rotation of each joint besides that in the wind, radians. */
  readonly sag: Float64Array | null;
}

const EVEN: Temper = { damping: 1, sag: null };

/**
 * How all joints answer one wind, in closed form. A joint is a damped oscillator and the wind a sum of lines; each line k swings
 * it by the response 1/(1 − b² + 2iζb) with b = f_k/f_j, so its rotation is a function of time with nothing to integrate:
 * Θ(t) = C q (Û + Σ n d (c cos τ + s sin τ)),  c + is = a χ e^{iκ·x} / (1 − b² − 2iζb),  τ = 2π f t + φ.
 */
export class Answers {
  readonly count: number;
  /** ω of each joint in s⁻¹, undamped. */
  readonly rate: Float64Array;
  /** Damping, that of the air included, as a share of the critical one. */
  readonly damping: Float64Array;
  /** Rotations in the mean wind, radians. */
  readonly mean: Float64Array;
  /** Rotations for a fluctuation of the size of the mean, along, across and upward, column by column. */
  readonly swing: Float64Array;
  private readonly lines: readonly Line[];
  private readonly period: number;
  /** c and s of each line, joint by joint. */
  private readonly responses: Float64Array;
  private readonly waves: Float64Array;

  /** O(joints × lines). */
  constructor(joints: SwayingJoints, wind: Wind, exposure: Float64Array, { damping, sag }: Temper = EVEN) {
    const { count } = joints;
    const { lines, axes } = wind;
    this.count = count;
    this.lines = lines;
    this.period = wind.period;
    this.rate = new Float64Array(count);
    this.damping = new Float64Array(count);
    this.mean = new Float64Array(3 * count);
    this.swing = new Float64Array(9 * count);
    this.responses = new Float64Array(2 * lines.length * count);
    this.waves = new Float64Array(2 * lines.length);
    for (let joint = 0; joint < count; joint += 1) {
      const speed = exposure[joint]! * wind.speed;
      const [pressure, exponent] = pressureOf(speed);
      const rate = TAU * joints.frequency[joint]!;
      const byAir = speed > 0 ? (((exponent * pressure) / speed) * joints.drag[joint]!) / (2 * rate) : 0;
      this.rate[joint] = rate;
      this.damping[joint] = Math.min(damping * joints.damping[joint]! + byAir, MOST_DAMPED);
      const turned = axes.map((axis) => times(joints.compliance, 9 * joint, axis)) as [Vec3, Vec3, Vec3];
      const whole = turned[0].map((each, a) => each * pressure + (sag?.[3 * joint + a] ?? 0));
      // The mean is limited smoothly. Swings around it are only scaled: the slope of the limit would freeze supple limbs in a storm.
      const far = Math.hypot(...whole) / FURTHEST;
      const held = far > 0 ? Math.tanh(far) / far : 1;
      for (let a = 0; a < 3; a += 1) {
        this.mean[3 * joint + a] = whole[a]! * held;
        for (let direction = 0; direction < 3; direction += 1) {
          const size = (direction === 0 ? exponent : 1) * (pressure / (1 + far));
          this.swing[9 * joint + 3 * direction + a] = turned[direction]![a]! * size;
        }
      }
      this.respond(joints, joint, wind);
    }
  }

  /** Writes the rotations of all joints at a time in seconds: x y z for each. */
  bends(time: number, out: Float64Array): void {
    const { lines, waves, mean, swing, responses, count } = this;
    for (const [k, line] of lines.entries()) {
      const angle = angleAt(line.harmonic, this.period, time) + line.phase;
      waves[2 * k] = Math.cos(angle);
      waves[2 * k + 1] = Math.sin(angle);
    }
    const numbers = waves.length;
    for (let joint = 0; joint < count; joint += 1) {
      let [along, across, upward] = [0, 0, 0];
      for (let k = 0, at = numbers * joint; k < numbers; k += 2, at += 2) {
        const gust = responses[at]! * waves[k]! + responses[at + 1]! * waves[k + 1]!;
        const { direction } = lines[k >> 1]!;
        if (direction === 0) along += gust;
        else if (direction === 1) across += gust;
        else upward += gust;
      }
      const [m, s] = [3 * joint, 9 * joint];
      for (let a = 0; a < 3; a += 1) {
        out[m + a] = mean[m + a]! + (swing[s + a]! * along + swing[s + 3 + a]! * across + swing[s + 6 + a]! * upward);
      }
    }
  }

  private respond(joints: SwayingJoints, joint: number, wind: Wind): void {
    const { lines } = wind;
    const [x, y, z] = [joints.centre[3 * joint]!, joints.centre[3 * joint + 1]!, joints.centre[3 * joint + 2]!];
    for (const [k, line] of lines.entries()) {
      const ratio = line.frequency / joints.frequency[joint]!;
      const [re, im] = [1 - ratio * ratio, -2 * this.damping[joint]! * ratio];
      const angle = line.wave[0] * x + line.wave[1] * y + line.wave[2] * z;
      const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
      const reaches = admittance(line.frequency, joints.area[joint]!, wind.speed);
      const size = (line.amplitude * reaches) / (re * re + im * im);
      const at = 2 * (lines.length * joint + k);
      this.responses[at] = size * (cos * re + sin * im);
      this.responses[at + 1] = size * (sin * re - cos * im);
    }
  }
}

/** The mean pressure of a wind in Pa, and the exponent by which it grows with the wind's speed. */
export function pressureOf(speed: number): readonly [pressure: number, exponent: number] {
  if (speed <= STREAMLINED_FROM) return [PRESSURE * speed * speed, 2];
  const atLimit = PRESSURE * STREAMLINED_FROM * STREAMLINED_FROM;
  return [atLimit * (speed / STREAMLINED_FROM) ** STREAMLINED, STREAMLINED];
}

/** How much of eddies of a frequency acts on a crown of some area: smaller ones cancel (Vickery's admittance). */
function admittance(frequency: number, area: number, speed: number): number {
  return Math.sqrt(1 / (1 + ((2 * frequency * Math.sqrt(area)) / speed) ** (4 / 3)));
}

/** A matrix, column by column, times a vector. */
function times(matrix: Float64Array, from: number, [x, y, z]: Vec3): Vec3 {
  const row = (a: number) => matrix[from + a]! * x + matrix[from + 3 + a]! * y + matrix[from + 6 + a]! * z;
  return [row(0), row(1), row(2)];
}
