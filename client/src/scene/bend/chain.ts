import type { Vec3 } from "../vector";
import { PRISM_SIZE } from "./prism";

/** Where something stands between the middles of a prism (share 0) and the next one (share 1). */
export interface Place {
  readonly prism: number;
  readonly share: number;
}

const MOST_PRISMS = 300;
const STIFF = 5e-4;
const RUBBER = 0.2;
const STIFFNESS = { least: 0.03, most: 4 };
const SHORTEST = 0.25;

/** The rest shape: prisms, what holds them together, and where the path's nodes are among them. */
export class Chain {
  readonly internodes: number;
  readonly prisms: number;
  readonly stretch: number;
  /** Of the wood above the base internode; 1 if it has none. */
  readonly length: number;
  /** Where each prism stands at rest. */
  readonly centres: Float64Array;
  /** The prisms at rest. */
  readonly rest: Float64Array;
  /** Of each joint where it is, from the centre of the prism below (0 to 2) and of that above (3 to 5). */
  readonly arms: Float64Array;
  /** Of each joint the energy of a gap (0), and half that of a turn (1). */
  readonly weights: Float64Array;
  private readonly nodes: Float64Array;
  private readonly alongs: Float64Array;
  private readonly group: number;

  constructor(
    nodes: readonly Vec3[],
    private readonly radii: ArrayLike<number>,
    stretch: number,
  ) {
    this.nodes = Float64Array.from(nodes.flat());
    this.internodes = radii.length;
    this.stretch = Math.min(Math.max(stretch, 0), 1);
    this.group = Math.max(1, Math.ceil((this.internodes - 1) / MOST_PRISMS));
    this.prisms = 1 + Math.ceil((this.internodes - 1) / this.group);
    this.alongs = new Float64Array(this.internodes + 1);
    for (let i = 2; i <= this.internodes; i += 1) this.alongs[i] = this.alongs[i - 1]! + this.distance(i - 1, i);
    this.length = this.alongs[this.internodes]! || 1;
    this.centres = new Float64Array(3 * this.prisms);
    this.rest = new Float64Array(PRISM_SIZE * this.prisms);
    for (let prism = 0; prism < this.prisms; prism += 1) {
      const from = this.node(this.first(prism));
      const to = this.node(this.last(prism) + 1);
      for (let i = 0; i < 3; i += 1) {
        this.centres[3 * prism + i] = 0.5 * (from[i]! + to[i]!);
        this.rest[PRISM_SIZE * prism + i] = this.centres[3 * prism + i]!;
      }
      this.rest[PRISM_SIZE * prism + 6] = 1;
    }
    this.arms = new Float64Array(6 * (this.prisms - 1));
    this.weights = new Float64Array(2 * (this.prisms - 1));
    for (let prism = 1; prism < this.prisms; prism += 1) this.join(prism);
  }

  node(index: number): Vec3 {
    return [this.nodes[3 * index]!, this.nodes[3 * index + 1]!, this.nodes[3 * index + 2]!];
  }

  /** Length along the wood from the end of the base internode to a node above. */
  along(node: number): number {
    return this.alongs[node]!;
  }

  /** Where the far end of an internode is. */
  end(internode: number): Place {
    return internode === 0 ? { prism: 0, share: 0 } : this.at(internode + 0.5);
  }

  /** Where the middle of an internode is. */
  middle(internode: number): Place {
    return this.at(internode);
  }

  private first(prism: number): number {
    return prism === 0 ? 0 : 1 + (prism - 1) * this.group;
  }

  private last(prism: number): number {
    return prism === 0 ? 0 : Math.min(prism * this.group, this.internodes - 1);
  }

  private middleOf(prism: number): number {
    return 0.5 * (this.first(prism) + this.last(prism));
  }

  private at(place: number): Place {
    const last = this.prisms - 1;
    if (place >= this.middleOf(last)) return { prism: last, share: 0 };
    const beyond = (place - this.middleOf(1)) / this.group;
    const prism = beyond < 0 ? 0 : 1 + Math.floor(beyond);
    const middle = this.middleOf(prism);
    return { prism, share: (place - middle) / (this.middleOf(prism + 1) - middle) };
  }

  private distance(a: number, b: number): number {
    const [from, to] = [this.node(a), this.node(b)];
    return Math.sqrt((to[0] - from[0]) ** 2 + (to[1] - from[1]) ** 2 + (to[2] - from[2]) ** 2);
  }

  /** Joins a prism to the one below. */
  private join(prism: number): void {
    const [first, last] = [this.first(prism), this.last(prism)];
    const lower = prism === 1 ? this.distance(0, first) : this.alongs[first]! - this.alongs[this.first(prism - 1)]!;
    const mean = this.length / (this.prisms - 1);
    const distance = Math.max(0.5 * (lower + this.alongs[last + 1]! - this.alongs[first]!), SHORTEST * mean);
    const resistance = STIFF * (RUBBER / STIFF) ** this.stretch * this.length;
    const joint = prism - 1;
    for (let i = 0; i < 3; i += 1) {
      const node = this.nodes[3 * first + i]!;
      this.arms[6 * joint + i] = node - this.centres[3 * (prism - 1) + i]!;
      this.arms[6 * joint + 3 + i] = node - this.centres[3 * prism + i]!;
    }
    this.weights[2 * joint] = 1 / (this.length * distance);
    this.weights[2 * joint + 1] = (resistance * this.stiffness(first)) / (2 * distance);
  }

  private stiffness(internode: number): number {
    const ratio = (0.5 * (this.radii[internode - 1]! + this.radii[internode]!)) / this.radii[0]!;
    return Number.isFinite(ratio) ? Math.min(Math.max(ratio * ratio, STIFFNESS.least), STIFFNESS.most) : 1;
  }
}
