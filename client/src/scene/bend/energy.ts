import type { Chain } from "./chain";
import { POSE, rotate } from "./pose";
import type { Pull } from "./reach";
import { Tridiagonal } from "./tridiagonal";

/** The energy of a pose, with its linear model: a joint costs gap · |a|² + turn · |R₁ − R₂|². */
export class Energy {
  value = 0;
  private readonly system: Tridiagonal;
  private readonly arms = new Float64Array(6);
  private readonly away = new Float64Array(3);

  constructor(private readonly chain: Chain) {
    this.system = new Tridiagonal(chain.prisms - 1);
  }

  /** Takes the measure of a pose. */
  set(pulls: readonly Pull[], poses: Float64Array): void {
    const { chain, system, arms, away } = this;
    const { weights } = chain;
    system.clear();
    this.value = 0;
    for (let k = 0; k + 1 < chain.prisms; k += 1) {
      const gap = weights[2 * k]!;
      const turn = weights[2 * k + 1]!;
      const pose = POSE * k;
      rotate(poses, pose, chain.arms, 6 * k, arms, 0);
      rotate(poses, pose + POSE, chain.arms, 6 * k + 3, arms, 3);
      for (let i = 0; i < 3; i += 1) {
        away[i] = poses[pose + i]! + arms[i]! - poses[pose + POSE + i]! - arms[3 + i]!;
      }
      this.value += gap * square(away);
      this.addDistance(k, gap, 1, -1);
      const [ax, ay, az, aw] = [poses[pose + 3]!, poses[pose + 4]!, poses[pose + 5]!, poses[pose + 6]!];
      const [bx, by, bz, bw] = [poses[pose + 10]!, poses[pose + 11]!, poses[pose + 12]!, poses[pose + 13]!];
      const x = -aw * bx + ax * bw - ay * bz + az * by;
      const y = -aw * by + ax * bz + ay * bw - az * bx;
      const z = -aw * bz - ax * by + ay * bx + az * bw;
      const w = aw * bw + ax * bx + ay * by + az * bz;
      this.value += 8 * turn * (x * x + y * y + z * z);
      system.addTurn(k, turn, x, y, z, w);
    }
    for (const pull of pulls) {
      stand(pull, poses, arms, away);
      this.value += pull.weight * square(away);
      this.addDistance(pull.at.prism, pull.weight, 1 - pull.at.share, pull.at.share);
    }
  }

  /** How fast the energy rises along a step. */
  slope(step: Float64Array): number {
    const { gradients } = this.system;
    let sum = 0;
    for (let i = 0; i < step.length; i += 1) sum += gradients[i]! * step[i]!;
    return 2 * sum;
  }

  /** How each prism but the first shall move: shift, turn. */
  step(): Float64Array | undefined {
    return this.system.solve();
  }

  /** Adds weight · |away|², which changes by shares of how the arms of prism k and of the next one move. */
  private addDistance(k: number, weight: number, below: number, above: number): void {
    const { system, arms } = this;
    if (k > 0) this.addArm(k - 1, weight, below, 0);
    if (above === 0) return;
    this.addArm(k, weight, above, 3);
    if (k > 0) system.addProduct(k, weight * below * above, arms);
  }

  private addArm(row: number, weight: number, share: number, at: number): void {
    const { system, arms, away } = this;
    const along = arms[at]! * away[0]! + arms[at + 1]! * away[1]! + arms[at + 2]! * away[2]!;
    system.addPull(row, weight * share, arms, at, away);
    system.addSquare(row, weight * share * share, -weight * share * along, arms, at);
  }
}

/** How a touched node stands: from the centres of both prisms, and from its target. */
function stand(pull: Pull, poses: Float64Array, arms: Float64Array, away: Float64Array): void {
  const { prism, share } = pull.at;
  const pose = POSE * prism;
  rotate(poses, pose, pull.arms, 0, arms, 0);
  if (share !== 0) rotate(poses, pose + POSE, pull.arms, 3, arms, 3);
  for (let i = 0; i < 3; i += 1) {
    let place = poses[pose + i]! + arms[i]!;
    if (share !== 0) place += share * (poses[pose + POSE + i]! + arms[3 + i]! - place);
    away[i] = place - pull.target[i]!;
  }
}

function square(v: Float64Array): number {
  return v[0]! * v[0]! + v[1]! * v[1]! + v[2]! * v[2]!;
}
