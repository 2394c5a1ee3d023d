import { AxisCurve } from "../../../scene/structure/axis-curve";
import type { Envelope } from "../../../scene/structure/envelope-surface";
import type { Emphasis, Shell } from "../../../scene/structure/shells";
import type { Vec3 } from "../../../scene/vector";
import type { PlacedBranch } from "../../../wire/generated";
import { type DesignModel, keyNamed } from "./design-model";
import { joined, minus, plus, size, type Turn, times, turnBetween, turned, turnedBack, unit } from "./space";

/** A branch in the scene: where it stands, as the server told it, and the shape that was said of it. */
export class BranchShape {
  readonly path: string;
  readonly curve: AxisCurve;

  constructor(
    readonly placed: PlacedBranch,
    readonly envelope: Envelope,
    points: readonly Vec3[],
  ) {
    this.path = placed.path;
    this.curve = new AxisCurve(points);
  }

  static of(placed: PlacedBranch, model: DesignModel): BranchShape {
    const value = (name: "silhouette" | "axis") => model.resolve(placed.path, keyNamed(name)).value;
    return new BranchShape(placed, value("silhouette") as Envelope, value("axis") as readonly Vec3[]);
  }

  get base(): Vec3 {
    return this.placed.base;
  }

  /** Where its axis ends. */
  get tip(): Vec3 {
    return plus(this.base, times(this.direction, this.placed.length));
  }

  /** From its base to its tip. */
  get direction(): Vec3 {
    return turned(this.placed.frame as Turn, [0, 1, 0]);
  }

  /** Internodes to a unit of its silhouette. */
  get scale(): number {
    return this.placed.length / Math.max(size(this.envelope.tip), 1e-6);
  }

  /** A place of its silhouette in the scene, and the other way about. */
  outward(place: Vec3): Vec3 {
    return plus(this.base, turned(this.placed.outline as Turn, times(place, this.scale)));
  }

  inward(place: Vec3): Vec3 {
    return times(turnedBack(this.placed.outline as Turn, minus(place, this.base)), 1 / this.scale);
  }

  /** A place of its axis' own frame, in which its tip is (0, 1, 0), in the scene, and the other way about. */
  along(place: Vec3): Vec3 {
    return plus(this.base, turned(this.placed.frame as Turn, times(place, this.placed.length)));
  }

  beside(place: Vec3): Vec3 {
    return times(turnedBack(this.placed.frame as Turn, minus(place, this.base)), 1 / this.placed.length);
  }

  /** Places of its axis in the scene, from its base to its tip. */
  axis(): readonly Vec3[] {
    return this.curve.places.filter((_, at) => at % 4 === 0).map((place) => this.along(place));
  }

  /** The same branch with its tip elsewhere, until the server says how it stands then. */
  aimed(tip: Vec3): BranchShape {
    const way = minus(tip, this.base);
    const turn = turnBetween(this.direction, unit(way));
    const { frame, outline } = this.placed;
    const placed: PlacedBranch = {
      ...this.placed,
      length: Math.max(size(way), 1e-3),
      frame: [...joined(turn, frame as Turn)],
      outline: [...joined(turn, outline as Turn)],
    };
    return new BranchShape(placed, this.envelope, this.curve.points);
  }

  /** The same branch farther along its bearer. */
  movedBy(by: Vec3): BranchShape {
    return new BranchShape({ ...this.placed, base: [...plus(this.base, by)] }, this.envelope, this.curve.points);
  }

  /** The same branch turned about its own axis. */
  rolled(degrees: number): BranchShape {
    const half = (degrees * Math.PI) / 360;
    const [x, y, z] = times(this.direction, Math.sin(half));
    // X goes towards Z, which is against the screw of Y.
    const turn: Turn = [-x, -y, -z, Math.cos(half)];
    const { frame, outline } = this.placed;
    const placed = {
      ...this.placed,
      frame: [...joined(turn, frame as Turn)],
      outline: [...joined(turn, outline as Turn)],
    };
    return new BranchShape(placed as PlacedBranch, this.envelope, this.curve.points);
  }

  shaped(envelope: Envelope): BranchShape {
    return new BranchShape(this.placed, envelope, this.curve.points);
  }

  bent(points: readonly Vec3[]): BranchShape {
    return new BranchShape(this.placed, this.envelope, points);
  }

  shell(emphasis: Emphasis): Shell {
    const { base, envelope, path, scale } = this;
    return { path, envelope, base, turn: this.placed.outline as Turn, scale, emphasis };
  }
}
