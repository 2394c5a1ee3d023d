import type { PlacedShape, Pose } from "../../wire/generated";
import type { DrawnObstacle, TriangleMesh } from "../obstacle-meshes";
import { type Solid, solidOf } from "./solids";
import { TriangleTree } from "./triangle-tree";

/** Obstacles on their way to whoever makes joints: meshes, which are large, only once. */
export interface PostedObstacles {
  readonly standing: readonly { readonly shape: PlacedShape; readonly pose: Pose; readonly mesh: number | null }[];
  /** Meshes that were not posted before, by number. */
  readonly meshes: readonly (readonly [number: number, mesh: TriangleMesh])[];
}

/** Knows which meshes have been posted. */
export class ObstaclePost {
  private numbers = new Map<TriangleMesh, number>();
  private last = 0;

  post(obstacles: readonly DrawnObstacle[]): PostedObstacles {
    const present = new Map<TriangleMesh, number>();
    const meshes: (readonly [number, TriangleMesh])[] = [];
    const standing = obstacles.map(({ shape, pose, mesh }) => {
      if (!mesh) return { shape, pose, mesh: null };
      let number = present.get(mesh) ?? this.numbers.get(mesh);
      if (number === undefined) {
        this.last += 1;
        number = this.last;
        meshes.push([number, mesh]);
      }
      present.set(mesh, number);
      return { shape, pose, mesh: number };
    });
    this.numbers = present;
    return { standing, meshes };
  }

  /** Whoever got them has lost them. */
  forget(): void {
    this.numbers = new Map();
  }
}

/** Obstacles as the wind meets them, from what was posted. */
export class ObstaclesReceived {
  private meshes = new Map<number, TriangleMesh>();
  private trees = new Map<string, TriangleTree>();

  /** `unit` has so many metres. */
  receive({ standing, meshes }: PostedObstacles, unit: number): Solid[] {
    const known = new Map([...this.meshes, ...meshes]);
    const [kept, trees] = [new Map<number, TriangleMesh>(), new Map<string, TriangleTree>()];
    const solids: Solid[] = [];
    for (const { shape, pose, mesh: number } of standing) {
      let triangles: TriangleTree | null = null;
      const mesh = number === null ? undefined : known.get(number);
      if (number !== null && mesh && shape.kind === "mesh") {
        const key = `${number} ${shape.scale}`;
        triangles =
          trees.get(key) ??
          this.trees.get(key) ??
          new TriangleTree(mesh.positions, mesh.triangles, Math.fround(shape.scale));
        trees.set(key, triangles);
        kept.set(number, mesh);
      }
      const solid = solidOf({ shape, pose, triangles }, unit);
      if (solid) solids.push(solid);
    }
    this.meshes = kept;
    this.trees = trees;
    return solids;
  }
}
