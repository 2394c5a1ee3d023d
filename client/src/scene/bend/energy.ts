import type { Chain } from "./chain";
import { PRISM_SIZE, rotate } from "./prism";
import type { Pull } from "./reach";
import { Tridiagonal } from "./tridiagonal";

/** The energy of the prisms, with its linear model: a joint costs gap · |a|² + turn · |R₁ − R₂|². */
export class Energy {
  value = 0;
  private readonly system: Tridiagonal;
  private readonly arms = new Float64Array(6);
  private readonly away = new Float64Array(3);

  constructor(private readonly chain: Chain) {
    this.system = new Tridiagonal(chain.prisms - 1);
  }

  /** Takes the measure of the prisms. */
  set(pulls: readonly Pull[], prisms: Float64Array): void {
    const { chain, system, arms, away } = this;
    const { weights } = chain;
    system.clear();
    this.value = 0;
    for (let k = 0; k + 1 < chain.prisms; k += 1) {
      const gap = weights[2 * k]!;
      const turn = weights[2 * k + 1]!;
      const offset = PRISM_SIZE * k;
      rotate(prisms, offset, chain.arms, 6 * k, arms, 0);
      rotate(prisms, offset + PRISM_SIZE, chain.arms, 6 * k + 3, arms, 3);
      for (let i = 0; i < 3; i += 1) {
        away[i] = prisms[offset + i]! + arms[i]! - prisms[offset + PRISM_SIZE + i]! - arms[3 + i]!;
      }
      this.value += gap * square(away);
      this.addDistance(k, gap, 1, -1);
      const [ax, ay, az, aw] = [prisms[offset + 3]!, prisms[offset + 4]!, prisms[offset + 5]!, prisms[offset + 6]!];
      const [bx, by, bz, bw] = [prisms[offset + 10]!, prisms[offset + 11]!, prisms[offset + 12]!, prisms[offset + 13]!];
      const x = -aw * bx + ax * bw - ay * bz + az * by;
      const y = -aw * by + ax * bz + ay * bw - az * bx;
      const z = -aw * bz - ax * by + ay * bx + az * bw;
      const w = aw * bw + ax * bx + ay * by + az * bz;
      this.value += 8 * turn * (x * x + y * y + z * z);
      system.addTurn(k, turn, x, y, z, w);
    }
    for (const pull of pulls) {
      stand(pull, prisms, arms, away);
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
function stand(pull: Pull, prisms: Float64Array, arms: Float64Array, away: Float64Array): void {
  const { prism, share } = pull.at;
  const offset = PRISM_SIZE * prism;
  rotate(prisms, offset, pull.arms, 0, arms, 0);
  if (share !== 0) rotate(prisms, offset + PRISM_SIZE, pull.arms, 3, arms, 3);
  for (let i = 0; i < 3; i += 1) {
    let place = prisms[offset + i]! + arms[i]!;
    if (share !== 0) place += share * (prisms[offset + PRISM_SIZE + i]! + arms[3 + i]! - place);
    away[i] = place - pull.target[i]!;
  }
}

function square(v: Float64Array): number {
  return v[0]! * v[0]! + v[1]! * v[1]! + v[2]! * v[2]!;
}
