import { computed, signal } from "@preact/signals";
import type { DrawnObstacle, TriangleMesh } from "../scene/obstacle-meshes";
import type { Command, PlacedObstacle, Pose, Shape } from "../wire/generated";
import { type NamedBytes, packedModel } from "./glb";
import { fetchMesh, uploadModel } from "./obstacle-api";
import { Transfer } from "./transfer";

export interface ObstacleListOptions {
  readonly submit: (command: Command) => void;
  readonly session: () => string | null;
  readonly fetchMesh?: typeof fetchMesh;
  readonly uploadModel?: typeof uploadModel;
  /** Something could not be fetched or taken in. */
  readonly failed: (error: unknown) => void;
}

/** What stands in the way of growth, as the server has it and as this hand is moving it. */
export class ObstacleList {
  readonly list = signal<readonly PlacedObstacle[]>([]);
  /** The obstacle at hand. */
  readonly chosen = signal<number | null>(null);
  /** A model on its way to the server. */
  readonly transfer = new Transfer();
  /** The list as it is drawn. */
  readonly drawn = computed<readonly DrawnObstacle[]>(() => {
    const [moved, meshes] = [this.#moved.value, this.#meshes.value];
    return this.list.value.map((obstacle) => {
      const mesh = meshes.get(obstacle.id);
      const pose = moved?.id === obstacle.id ? moved.pose : obstacle.pose;
      return mesh ? { ...obstacle, pose, mesh } : { ...obstacle, pose };
    });
  });

  #options: ObstacleListOptions;
  #moved = signal<{ readonly id: number; readonly pose: Pose } | null>(null);
  #meshes = signal<ReadonlyMap<number, TriangleMesh>>(new Map());
  #fetching = new Set<number>();
  /** A new one of this hand is chosen when it appears. */
  #awaited = false;

  constructor(options: ObstacleListOptions) {
    this.#options = options;
  }

  /** The server's list has changed. */
  receive(obstacles: readonly PlacedObstacle[]): void {
    const known = new Set(this.list.peek().map(({ id }) => id));
    const added = obstacles.find(({ id }) => !known.has(id));
    this.list.value = obstacles;
    this.#moved.value = null;
    if (added && this.#awaited) {
      this.#awaited = false;
      this.chosen.value = added.id;
    } else if (!obstacles.some(({ id }) => id === this.chosen.peek())) {
      this.chosen.value = null;
    }
    for (const { id, shape } of obstacles) {
      if (shape.kind === "mesh") {
        void this.#fetch(id);
      }
    }
  }

  /** Another session, or the same one loaded anew: nothing that was fetched still counts. */
  clear(): void {
    this.#meshes.value = new Map();
    this.#fetching.clear();
    this.receive([]);
  }

  poseOf(id: number): Pose | null {
    return this.drawn.peek().find((obstacle) => obstacle.id === id)?.pose ?? null;
  }

  /** Shows one elsewhere than the server has it, until the next list; null for none. */
  preview(moved: { readonly id: number; readonly pose: Pose } | null): void {
    this.#moved.value = moved;
  }

  place(shape: Shape, pose: Pose): void {
    this.#awaited = true;
    this.#options.submit({ kind: "place_obstacle", obstacle: { shape, pose } });
  }

  move(id: number, pose: Pose): void {
    this.preview({ id, pose });
    this.#options.submit({ kind: "move_obstacle", id, pose });
  }

  remove(id: number): void {
    this.#options.submit({ kind: "remove_obstacle", id });
  }

  /** Gives one another shape: the wire knows this as another obstacle in the same place. */
  reshape(id: number, shape: Shape): void {
    const pose = this.poseOf(id);
    if (pose) {
      this.place(shape, pose);
      this.remove(id);
    }
  }

  async import(files: readonly NamedBytes[]): Promise<void> {
    const session = this.#options.session();
    if (session === null) {
      return;
    }
    try {
      const send = this.#options.uploadModel ?? uploadModel;
      const placed = await this.transfer.run((signal, tell) => send(session, packedModel(files), signal, tell));
      if (placed) {
        this.chosen.value = placed.id;
      }
    } catch (error) {
      this.#options.failed(error);
    }
  }

  async #fetch(id: number): Promise<void> {
    const session = this.#options.session();
    const fetching = this.#fetching;
    if (session === null || fetching.has(id)) {
      return;
    }
    fetching.add(id);
    try {
      const mesh = await (this.#options.fetchMesh ?? fetchMesh)(session, id);
      if (this.#options.session() === session && fetching.has(id)) {
        this.#meshes.value = new Map(this.#meshes.peek()).set(id, mesh);
      }
    } catch (error) {
      fetching.delete(id);
      this.#options.failed(error);
    }
  }
}
