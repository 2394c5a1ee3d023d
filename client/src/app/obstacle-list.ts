import { computed, signal } from "@preact/signals";
import type { DrawnObstacle, TriangleMesh } from "../scene/obstacle-meshes";
import type { Command, PlacedObstacle, Pose, Shape } from "../wire/generated";
import { alike } from "./draft";
import { type NamedBytes, packedModel } from "./glb";
import { fetchMesh, uploadModel } from "./obstacle-api";
import { Transfer } from "./transfer";

export interface ObstacleListOptions {
  readonly submit: (command: Command) => void;
  /** A number that no other gesture of this client has, if it is sent at once. */
  readonly newGesture: () => number;
  readonly session: () => string | null;
  readonly fetchMesh?: typeof fetchMesh;
  readonly uploadModel?: typeof uploadModel;
  /** Something could not be fetched or taken in. */
  readonly failed: (error: unknown) => void;
}

type Placing = Extract<Command, { kind: "place_obstacle" }>;

/** What a hand does without letting go is one operation for undo (`OB2`). */
export class Hand {
  /** Its number, once something of it was sent. */
  gesture: number | null = null;
}

/** An obstacle of this hand that is to appear, and the one it takes the place of, if any. */
interface Awaited {
  readonly command: Placing;
  readonly instead: number | null;
  readonly hand: Hand;
  /** Yet another shape that was asked for meanwhile. */
  afterwards: { readonly shape: Shape; readonly hand: Hand } | null;
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
  /** What this hand has placed is chosen when it appears. */
  #awaited: Awaited[] = [];
  /** Those whose other shape stands, and that one, until the server's list is without either. */
  #replaced = new Map<number, number>();
  /** Each as this page first saw it: what its measures are put back to. */
  #first = new Map<number, PlacedObstacle>();

  constructor(options: ObstacleListOptions) {
    this.#options = options;
  }

  /** The server's list has changed. */
  receive(told: readonly PlacedObstacle[]): void {
    const standing = new Set(told.map(({ id }) => id));
    for (const [id] of [...this.#replaced].filter((pair) => !pair.every((id) => standing.has(id)))) {
      this.#replaced.delete(id);
    }
    const obstacles = told.filter(({ id }) => !this.#replaced.has(id));
    const known = new Set(this.list.peek().map(({ id }) => id));
    this.list.value = obstacles;
    this.#moved.value = null;
    for (const obstacle of obstacles.filter(({ id }) => !known.has(id))) {
      this.#appeared(obstacle);
    }
    const chosen = this.chosen.peek();
    if (chosen !== null && !this.list.peek().some(({ id }) => id === chosen)) {
      // The shape that undo brings back is at hand as the other one was.
      const origin = this.#first.get(chosen)?.id;
      const former = obstacles.find(({ id }) => !known.has(id) && this.#first.get(id)?.id === origin);
      this.chosen.value = former?.id ?? null;
    }
    for (const { id, shape } of obstacles) {
      if (shape.kind === "mesh") {
        void this.#fetch(id);
      }
    }
  }

  /** Another session: nothing here is of it. */
  forget(): void {
    this.#awaited = [];
    this.#replaced.clear();
    this.#first.clear();
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

  /** Shows one elsewhere than the server has it, until the next list; null for none. */
  preview(moved: { readonly id: number; readonly pose: Pose } | null): void {
    this.#moved.value = moved;
  }

  place(shape: Shape, pose: Pose): void {
    this.#place(shape, pose, new Hand(), null);
  }

  /** How one was when this page first saw it, through all shapes it was given since; null where there is none. */
  first(id: number): PlacedObstacle | null {
    return this.#first.get(id) ?? null;
  }

  move(id: number, pose: Pose, hand = new Hand()): void {
    this.preview({ id, pose });
    this.#options.submit({ kind: "move_obstacle", id, pose, gesture: this.#gesture(hand) });
  }

  remove(id: number, hand = new Hand()): void {
    this.#options.submit({ kind: "remove_obstacle", id, gesture: this.#gesture(hand) });
  }

  /**
   * Gives one another shape: the wire knows this as another obstacle in the same place. The old one goes once the
   * other stands there, for it may be refused long after it was taken on.
   */
  reshape(id: number, shape: Shape, hand = new Hand()): void {
    const underWay = this.#awaited.find(({ instead }) => instead === id);
    if (underWay) {
      underWay.afterwards = { shape, hand };
      return;
    }
    const pose = this.poseOf(id);
    if (pose) {
      this.#place(shape, pose, hand, id);
    }
  }

  /** The server would not do something: all stands as it was. */
  refused(command: Command): void {
    this.#awaited = this.#awaited.filter((awaited) => awaited.command !== command);
    if (command.kind === "remove_obstacle") {
      this.#replaced.delete(command.id);
    }
    this.preview(null);
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

  #place(shape: Shape, pose: Pose, hand: Hand, instead: number | null): void {
    const command: Placing = { kind: "place_obstacle", obstacle: { shape, pose }, gesture: this.#gesture(hand) };
    this.#awaited.push({ command, hand, instead, afterwards: null });
    this.#options.submit(command);
  }

  /** The number of a hand that is about to send something. */
  #gesture(hand: Hand): number {
    hand.gesture ??= this.#options.newGesture();
    return hand.gesture;
  }

  /** One more stands in the scene. */
  #appeared(added: PlacedObstacle): void {
    const awaited = this.#awaited.find(({ command: { obstacle } }) => {
      return alike(obstacle.shape, added.shape) && alike(obstacle.pose.position, added.pose.position);
    });
    const instead = awaited?.instead ?? null;
    if (!this.#first.has(added.id)) {
      this.#first.set(added.id, (instead === null ? undefined : this.#first.get(instead)) ?? added);
    }
    if (!awaited) {
      return;
    }
    this.#awaited = this.#awaited.filter((other) => other !== awaited);
    // One that is no longer at hand is not taken up again by its new shape.
    if (instead === null || this.chosen.peek() === instead) {
      this.chosen.value = added.id;
    }
    if (instead !== null && this.list.peek().some(({ id }) => id === instead)) {
      this.#replaced.set(instead, added.id);
      this.list.value = this.list.peek().filter(({ id }) => id !== instead);
      this.remove(instead, awaited.hand);
    }
    if (awaited.afterwards !== null) {
      this.reshape(added.id, awaited.afterwards.shape, awaited.afterwards.hand);
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
