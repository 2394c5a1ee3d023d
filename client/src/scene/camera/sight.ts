import { Matrix4, PerspectiveCamera, Vector3 } from "three";
import type { DrawingPlane } from "../../wire/generated";
import type { Ray, Vec3 } from "../vector";
import { type CameraView, FIELD_OF_VIEW } from "./camera-view";
import type { Projection } from "./picking";

/** Ground seen from further off than this many times the eye's distance from the tree is too far to aim at. */
const FURTHEST_AIM = 4;
/** And in any case nearer than this is not, in internodes. */
const NEAR_ENOUGH = 150;
/** An eye that looks down more steeply than this, in radians, sees the ground rather than what rises from it. */
const LOOKS_DOWN = 0.5;

/** The share of the picture's shorter side that the largest brush has. */
const FITTING = 0.9;

/** Pixels across and down. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** The eye of the camera, and how places on the screen and in the world correspond. Screen places are CSS pixels of the canvas. */
export class Sight {
  readonly camera = new PerspectiveCamera((FIELD_OF_VIEW * 180) / Math.PI, 1, 0.1, 2000);
  readonly worldFromClip = new Matrix4();
  width = 1;
  height = 1;
  private pitch = 0;
  private distance = 1;

  /** Puts the eye where a view has it. */
  aim(view: CameraView, eye: Vec3, aspect = this.width / this.height): void {
    const { camera } = this;
    this.pitch = view.pitch;
    this.distance = view.distance;
    camera.aspect = aspect;
    // An eye just above the ground must not cut away the ground before its feet.
    camera.near = Math.max(0.05, Math.min(0.02 * view.distance, 1.5 * eye[1]));
    // The ground goes on as far as that, see `environment.ts`.
    camera.far = view.distance + Math.max(1500, 8 * view.distance);
    camera.updateProjectionMatrix();
    camera.position.set(...eye);
    camera.lookAt(...view.target);
    camera.updateMatrixWorld();
    this.worldFromClip.multiplyMatrices(camera.matrixWorld, camera.projectionMatrixInverse);
  }

  /** Puts the eye where a view has it, for a tile of a picture of so many pixels. */
  aimAtTile(view: CameraView, eye: Vec3, picture: PictureSize, tile: PictureSize & { x: number; y: number }): void {
    this.aim(view, eye, picture.width / picture.height);
    const { camera } = this;
    const [across, down] = [picture.width / tile.width, picture.height / tile.height];
    // The tile's middle in the picture, from −1 to 1, goes to the middle of what is drawn.
    const right = (2 * tile.x + tile.width) / picture.width - 1;
    const up = 1 - (2 * tile.y + tile.height) / picture.height;
    camera.projectionMatrix.premultiply(
      new Matrix4().set(across, 0, 0, -right * across, 0, down, 0, -up * down, 0, 0, 1, 0, 0, 0, 0, 1),
    );
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    this.worldFromClip.multiplyMatrices(camera.matrixWorld, camera.projectionMatrixInverse);
  }

  /** Whether it looks so much from above that a finger moves over the ground. */
  looksDown(): boolean {
    return this.pitch > LOOKS_DOWN;
  }

  /** From the eye through a place. */
  rayAt(x: number, y: number): Ray {
    const origin = this.camera.position;
    const through = new Vector3((2 * x) / this.width - 1, 1 - (2 * y) / this.height, 0.5).unproject(this.camera);
    const direction = through.sub(origin).normalize();
    return { origin: [origin.x, origin.y, origin.z], direction: [direction.x, direction.y, direction.z] };
  }

  /** The radius of the largest ball around a point that stays in the picture when it is seen in the middle. */
  widest(point: Vec3): number {
    const depth = this.depthOf(point, this.camera.getWorldDirection(new Vector3()));
    return (FITTING * Math.min(this.width, this.height) * Math.max(depth, 0)) / (2 * pixelsPerInternode(this.height));
  }

  /** Where a place lies in the plane that faces the eye and holds `through`. */
  pointOnPlane(x: number, y: number, through: Vec3): Vec3 | null {
    const ray = this.rayAt(x, y);
    const forward = this.camera.getWorldDirection(new Vector3());
    const towards = forward.x * ray.direction[0] + forward.y * ray.direction[1] + forward.z * ray.direction[2];
    const depth = this.depthOf(through, forward);
    return towards < 1e-6 || depth < this.camera.near ? null : along(ray, depth / towards);
  }

  /** Where a place lies in the horizontal plane that holds `through`; null where it is too far off to aim at. */
  pointOnLevel(x: number, y: number, through: Vec3): Vec3 | null {
    const ray = this.rayAt(x, y);
    const length = (through[1] - ray.origin[1]) / ray.direction[1];
    const reach = Math.max(NEAR_ENOUGH, FURTHEST_AIM * this.distance);
    return length > this.camera.near && length < reach ? along(ray, length) : null;
  }

  /** The plane that faces the eye and holds `through`, with the screen's own axes. */
  drawingPlane(through: Vec3): DrawingPlane {
    const right = new Vector3();
    const up = new Vector3();
    this.camera.matrixWorld.extractBasis(right, up, new Vector3());
    return { origin: [...through], right: [right.x, right.y, right.z], up: [up.x, up.y, up.z] };
  }

  /** Projects points of the world onto the screen; null for those behind the eye. */
  projector(): (point: Vec3) => readonly [number, number] | null {
    const m = this.clipFromWorld();
    const [halfWidth, halfHeight] = [this.width / 2, this.height / 2];
    return ([x, y, z]) => {
      const w = m[3]! * x + m[7]! * y + m[11]! * z + m[15]!;
      if (w < this.camera.near) return null;
      const across = m[0]! * x + m[4]! * y + m[8]! * z + m[12]!;
      const upwards = m[1]! * x + m[5]! * y + m[9]! * z + m[13]!;
      return [halfWidth + (halfWidth * across) / w, halfHeight - (halfHeight * upwards) / w];
    };
  }

  projection(): Projection {
    const { width, height } = this;
    return { clipFromWorld: this.clipFromWorld(), width, height, pixelsPerInternode: pixelsPerInternode(height) };
  }

  private clipFromWorld(): number[] {
    const { camera } = this;
    return new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
  }

  private depthOf(point: Vec3, forward: Vector3): number {
    return new Vector3(...point).sub(this.camera.position).dot(forward);
  }
}

/** How many pixels an internode at distance one is long in a picture of this height. */
export function pixelsPerInternode(height: number): number {
  return height / (2 * Math.tan(FIELD_OF_VIEW / 2));
}

function along({ origin, direction }: Ray, length: number): Vec3 {
  return [origin[0] + direction[0] * length, origin[1] + direction[1] * length, origin[2] + direction[2] * length];
}
