import {
  Box3,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  Group,
  type Material,
  Mesh,
  Raycaster,
  SphereGeometry,
  Vector3,
} from "three";
import type { PlacedShape, Pose } from "../wire/generated";
import type { Box } from "./camera/camera-view";
import { facingOut, volume } from "./closed-surface";
import { PLANE_SHOWN } from "./glsl/obstacle";
import type { Materials } from "./materials";
import type { Ray, Vec3 } from "./vector";

/** Drawn over the ground it lies on, and under what stands on both. */
const PLANE_ORDER = 1.5;

/** A closed mesh that fills less of its box than this is a frame of rods, as a stand is. */
const FRAME_FILLS = 0.15;

/** A triangle mesh as the server keeps it, before scale and pose. */
export interface TriangleMesh {
  /** x y z of each vertex. */
  readonly positions: Float32Array;
  /** Three vertices for each triangle. */
  readonly triangles: Uint32Array;
}

/** An obstacle to be drawn; a mesh that is not here yet is left out. */
export interface DrawnObstacle {
  readonly id: number;
  readonly shape: PlacedShape;
  readonly pose: Pose;
  readonly mesh?: TriangleMesh;
}

interface Entry {
  readonly shape: PlacedShape;
  /** Whether its surface is closed. */
  readonly closed: boolean;
  readonly body: Mesh;
  /** Shares the body's geometry; a plane casts no shadow of its own. */
  readonly caster: Mesh | null;
}

/** The meshes of the obstacles. */
export class ObstacleMeshes {
  readonly bodies = new Group();
  readonly casters = new Group();
  /** The obstacles that are drawn; another list as soon as one of them is another. */
  shown: readonly DrawnObstacle[] = [];
  private readonly entries = new Map<number, Entry>();
  private readonly extent = new Box3();

  constructor(private readonly materials: Materials) {}

  /** Draws these and no others; one of them may be marked. */
  show(obstacles: readonly DrawnObstacle[], chosen: number | null): void {
    this.shown = obstacles;
    const present = new Set(obstacles.map(({ id }) => id));
    for (const id of [...this.entries.keys()]) {
      if (!present.has(id)) this.remove(id);
    }
    this.extent.makeEmpty();
    for (const obstacle of obstacles) {
      const entry = this.entryOf(obstacle);
      if (!entry) continue;
      entry.body.material = this.materialOf(entry, obstacle.id === chosen);
      for (const mesh of [entry.body, entry.caster]) {
        if (!mesh) continue;
        mesh.position.set(...obstacle.pose.position);
        mesh.quaternion.set(...(obstacle.pose.rotation ?? [0, 0, 0, 1])).normalize();
        mesh.updateMatrixWorld();
      }
      if (entry.caster) this.extent.expandByObject(entry.body);
    }
  }

  /** The box around all obstacles except planes; null if there are none. */
  bounds(): Box | null {
    const { min, max } = this.extent;
    return this.extent.isEmpty() ? null : { min: [min.x, min.y, min.z], max: [max.x, max.y, max.z] };
  }

  /** The first obstacle on a ray. */
  pick({ origin, direction }: Ray): { id: number; point: Vec3 } | null {
    const caster = new Raycaster(new Vector3(...origin), new Vector3(...direction));
    const hit = caster.intersectObjects(this.bodies.children, false)[0];
    if (!hit) return null;
    const { x, y, z } = hit.point;
    return { id: Number(hit.object.name), point: [x, y, z] };
  }

  /** How far an obstacle reaches below its own origin as it is turned; null for a plane, which has no lowest point. */
  depthBelow(id: number): number | null {
    const entry = this.entries.get(id);
    if (!entry?.caster) return null;
    return entry.body.position.y - new Box3().setFromObject(entry.body, true).min.y;
  }

  dispose(): void {
    for (const id of [...this.entries.keys()]) this.remove(id);
  }

  private entryOf(obstacle: DrawnObstacle): Entry | null {
    const { id, shape } = obstacle;
    const known = this.entries.get(id);
    if (known && JSON.stringify(known.shape) === JSON.stringify(shape)) return known;
    this.remove(id);
    const made = geometryOf(obstacle);
    if (!made) return null;
    const { geometry, closed } = made;
    const body = new Mesh(geometry, this.materials.clay);
    body.name = String(id);
    if (shape.kind === "plane") body.renderOrder = PLANE_ORDER;
    const caster = shape.kind === "plane" ? null : new Mesh(geometry, this.materials.clayDepth);
    this.bodies.add(body);
    if (caster) this.casters.add(caster);
    const entry = { shape, closed, body, caster };
    this.entries.set(id, entry);
    return entry;
  }

  private materialOf({ shape, closed }: Entry, chosen: boolean): Material {
    const { clay, clayChosen, clayPlane, clayPlaneChosen, clayClosed, clayClosedChosen } = this.materials;
    if (closed) return chosen ? clayClosedChosen : clayClosed;
    if (shape.kind === "plane") return chosen ? clayPlaneChosen : clayPlane;
    return chosen ? clayChosen : clay;
  }

  private remove(id: number): void {
    const entry = this.entries.get(id);
    if (!entry) return;
    this.entries.delete(id);
    this.bodies.remove(entry.body);
    if (entry.caster) this.casters.remove(entry.caster);
    entry.body.geometry.dispose();
  }
}

function geometryOf({ shape, mesh }: DrawnObstacle): { geometry: BufferGeometry; closed: boolean } | null {
  switch (shape.kind) {
    case "box": {
      const geometry = new BoxGeometry(...shape.size);
      return { geometry: described(geometry, shape.size), closed: true };
    }
    case "sphere":
      return { geometry: new SphereGeometry(shape.radius, 48, 32), closed: true };
    case "plane":
      return { geometry: new CircleGeometry(PLANE_SHOWN, 48).rotateX(-Math.PI / 2), closed: false };
    case "mesh": {
      if (!mesh) return null;
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(mesh.positions.slice(), 3));
      const outside = facingOut(mesh.positions, mesh.triangles);
      geometry.setIndex(new BufferAttribute(outside ?? mesh.triangles, 1));
      if (outside && isFrame(geometry, volume(mesh.positions, outside) / 6)) described(geometry, [-1, -1, -1]);
      geometry.scale(shape.scale, shape.scale, shape.scale);
      geometry.computeVertexNormals();
      return { geometry, closed: outside !== null };
    }
  }
}

/** Tells the shader what a body is: how long the sides of a box are, or −1 for a frame; nothing is said of others. */
function described(geometry: BufferGeometry, body: Vec3): BufferGeometry {
  const { count } = geometry.attributes.position!;
  return geometry.setAttribute(
    "body",
    new BufferAttribute(
      new Float32Array(3 * count).map((_, n) => body[n % 3]!),
      3,
    ),
  );
}

/** Whether a mesh with so much volume is a frame. */
function isFrame(geometry: BufferGeometry, filled: number): boolean {
  geometry.computeBoundingBox();
  const { min, max } = geometry.boundingBox!;
  return filled < FRAME_FILLS * (max.x - min.x) * (max.y - min.y) * (max.z - min.z);
}
