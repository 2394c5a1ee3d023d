import { batch, computed, signal } from "@preact/signals";
import type { DrawnObstacle, TriangleMesh } from "../../../scene/obstacle-meshes";
import type { Command, PlacedObstacle, PlacedShape, Pose, Shape } from "../../../wire/generated";
import type { Clock } from "../../page/clock";
import { Transfer } from "../../requests/transfer";
import { alike, Draft, type GrowthAhead } from "../draft";
import { fetchMesh, uploadModel } from "./obstacle-api";

export interface ObstacleListOptions {
  /** Sends a command and gives its number; 0 where no session is open. */
  readonly submit: (command: Command) => number;
  /** A number that no other gesture of this client has, if it is sent at once. */
  readonly newGesture: () => number;
  /** What the server has still to grow, for what it has taken on is done only after that. */
  readonly ahead: () => GrowthAhead;
  readonly clock: Clock;
  readonly session: () => string | null;
  readonly fetchMesh?: typeof fetchMesh;
  readonly uploadModel?: typeof uploadModel;
  /** A model had so many triangles, and fewer are kept. */
  readonly simplified: (before: number, after: number) => void;
  /** Something could not be fetched or taken in. */
  readonly failed: (error: unknown) => void;
}

type Placing = Extract<Command, { kind: "place_obstacle" }>;
/** What an obstacle may become where it stands; a mesh stays what it is. */
export type SimpleShape = Exclude<Shape, { kind: "mesh" }>;

/** The pose or the shape of one obstacle. */
type Field = `${"pose" | "shape"} ${number}`;
type Fields = { [field in Field]?: Pose | PlacedShape };

/** Changes that one undo takes back together, such as those of one drag (`OB2`). */
export class UndoGroup {
  /** Its number as a gesture of commands; null until a command of it was sent. */
  gesture: number | null = null;
}

/** The obstacles, as the server has them and as this user is moving them. */
export class ObstacleList {
  readonly list = signal<readonly PlacedObstacle[]>([]);
  /** The chosen obstacle. */
  readonly chosen = signal<number | null>(null);
  /** A model on its way to the server. */
  readonly transfer = new Transfer();
  /** The list as it is drawn. */
  readonly drawn = computed<readonly DrawnObstacle[]>(() => {
    const [held, meshes, fields] = [this.#held.value, this.#meshes.value, this.#draft.value.value];
    return this.list.value.map((obstacle) => {
      const mesh = meshes.get(obstacle.id);
      const own = (fields[`pose ${obstacle.id}`] ?? obstacle.pose) as Pose;
      const pose = held?.id === obstacle.id ? held.pose : own;
      const shape = (fields[`shape ${obstacle.id}`] ?? obstacle.shape) as PlacedShape;
      return { ...obstacle, pose, shape, ...(mesh ? { mesh } : {}) };
    });
  });

  #options: ObstacleListOptions;
  /** Poses and shapes that this user has set and the server has not confirmed yet. */
  #draft: Draft<Fields>;
  #held = signal<{ readonly id: number; readonly pose: Pose } | null>(null);
  #meshes = signal<ReadonlyMap<number, TriangleMesh>>(new Map());
  #fetching = new Set<number>();
  /** Obstacles that this user has placed; each is chosen when it appears. */
  #awaited: Placing[] = [];
  /** Each as this page first saw it: what its measures are put back to. */
  #first = new Map<number, PlacedObstacle>();

  constructor(options: ObstacleListOptions) {
    this.#options = options;
    const { newGesture, ahead, clock } = options;
    this.#draft = new Draft<Fields>({
      none: {},
      submit: (fields, gesture) => this.#send(fields, gesture),
      newGesture,
      ahead,
      clock,
    });
  }

  /** The server's list has changed. */
  receive(obstacles: readonly PlacedObstacle[]): void {
    const known = new Set(this.list.peek().map(({ id }) => id));
    batch(() => {
      this.list.value = obstacles;
      this.#draft.receive(fieldsOf(obstacles));
    });
    for (const obstacle of obstacles.filter(({ id }) => !known.has(id))) {
      this.#appeared(obstacle);
    }
    if (!obstacles.some(({ id }) => id === this.chosen.peek())) {
      this.chosen.value = null;
    }
    for (const { id, shape } of obstacles) {
      if (shape.kind === "mesh") {
        void this.#fetch(id);
      }
    }
  }

  /** The server has answered all commands up to this one. */
  settle(settled: number): void {
    this.#draft.settle(settled);
  }

  /** The commands that were sent have new numbers: the server's answers to the old ones do not come any more. */
  letGo(): void {
    this.#draft.letGo();
  }

  /** Forgets everything, for another session. */
  forget(): void {
    this.#awaited = [];
    this.#first.clear();
    this.#draft.clear();
    this.clear();
  }

  /** The same session loaded anew: nothing that was fetched still counts; what was placed is still to come. */
  clear(): void {
    this.#meshes.value = new Map();
    this.#fetching.clear();
    this.receive([]);
  }

  poseOf(id: number): Pose | null {
    return this.drawn.peek().find((obstacle) => obstacle.id === id)?.pose ?? null;
  }

  /** Shows one where a finger holds it; null for none. */
  preview(held: { readonly id: number; readonly pose: Pose } | null): void {
    this.#held.value = held;
  }

  place(shape: Shape, pose: Pose): void {
    const command: Placing = {
      kind: "place_obstacle",
      obstacle: { shape, pose },
      gesture: this.#gesture(new UndoGroup()),
    };
    this.#awaited.push(command);
    this.#options.submit(command);
  }

  /** How one was when this page first saw it; null where there is none. */
  first(id: number): PlacedObstacle | null {
    return this.#first.get(id) ?? null;
  }

  move(id: number, pose: Pose, group = new UndoGroup()): void {
    this.#draft.commit({ [`pose ${id}`]: pose } as Fields, this.#gesture(group));
  }

  /** Gives one other measures. */
  reshape(id: number, shape: SimpleShape, group = new UndoGroup()): void {
    this.#draft.commit({ [`shape ${id}`]: shape } as Fields, this.#gesture(group));
  }

  remove(id: number, group = new UndoGroup()): void {
    this.#options.submit({ kind: "remove_obstacle", id, gesture: this.#gesture(group) });
  }

  /** The server would not do something: what was to be placed is not awaited. */
  refused(command: Command): void {
    this.#awaited = this.#awaited.filter((awaited) => awaited !== command);
  }

  async import(files: readonly File[]): Promise<void> {
    const session = this.#options.session();
    if (session === null) {
      return;
    }
    try {
      const send = this.#options.uploadModel ?? uploadModel;
      const { modelFile } = await import("./model-file");
      const model = await modelFile(files);
      const placed = await this.transfer.run((signal, tell) => send(session, model, signal, tell));
      if (placed && this.#options.session() === session) {
        this.chosen.value = placed.id;
        if (placed.simplified_from && placed.shape.kind === "mesh") {
          this.#options.simplified(placed.simplified_from.triangles, placed.shape.triangles);
        }
      }
    } catch (error) {
      this.#options.failed(error);
    }
  }

  /** Sends fields that the user has set; gives the number of the last command. */
  #send(fields: Partial<Fields>, gesture: number | undefined): number {
    let command = 0;
    for (const [field, value] of Object.entries(fields)) {
      const [name, number] = field.split(" ");
      const of = { id: Number(number), ...(gesture === undefined ? {} : { gesture }) };
      command = this.#options.submit(
        name === "pose"
          ? { kind: "move_obstacle", ...of, pose: value as Pose }
          : { kind: "reshape_obstacle", ...of, shape: value as SimpleShape },
      );
    }
    return command;
  }

  /** The number of a group of which a command is about to be sent. */
  #gesture(group: UndoGroup): number {
    group.gesture ??= this.#options.newGesture();
    return group.gesture;
  }

  /** One more stands in the scene. */
  #appeared(added: PlacedObstacle): void {
    if (!this.#first.has(added.id)) {
      this.#first.set(added.id, added);
    }
    const awaited = this.#awaited.find(({ obstacle }) => {
      return alike(obstacle.shape, added.shape) && alike(obstacle.pose.position, added.pose.position);
    });
    if (awaited) {
      this.#awaited = this.#awaited.filter((other) => other !== awaited);
      this.chosen.value = added.id;
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

function fieldsOf(obstacles: readonly PlacedObstacle[]): Fields {
  const fields: Fields = {};
  for (const { id, pose, shape } of obstacles) {
    fields[`pose ${id}`] = pose;
    fields[`shape ${id}`] = shape;
  }
  return fields;
}
