import { describe, expect, it } from "vitest";
import { Virtual } from "../../../../test/virtual-clock";
import type { Command, PlacedObstacle, UploadedObstacle } from "../../../wire/generated";
import { ObstacleList, UndoGroup } from "./obstacle-list";

const mesh = { positions: new Float32Array(9), triangles: new Uint32Array(3) };

function setUp() {
  const sent: Command[] = [];
  const world = {
    fetched: [] as number[],
    failures: [] as unknown[],
    simplified: [] as number[][],
    fail: false,
    file: {} as Partial<UploadedObstacle>,
  };
  const clock = new Virtual();
  const list = new ObstacleList({
    submit: (command) => sent.push(command),
    newGesture: () => sent.length + 1,
    ahead: () => ({ step: 0, pending: 0 }),
    clock,
    session: () => "glade",
    fetchMesh: async (_, id) => {
      world.fetched.push(id);
      if (world.fail) throw new Error("gone");
      return mesh;
    },
    uploadModel: async () => ({ ...model(9), ...world.file }),
    simplified: (...counts) => world.simplified.push(counts),
    failed: (error) => world.failures.push(error),
  });
  return { list, sent, world, clock };
}

const box = (id: number, x = 0): PlacedObstacle => ({
  id,
  shape: { kind: "box", size: [1, 2, 3] },
  pose: { position: [x, 0, 0] },
});
const model = (id: number): PlacedObstacle => ({
  id,
  shape: { kind: "mesh", vertices: 3, triangles: 1, scale: 1 },
  pose: { position: [0, 0, 0] },
});
const settle = () => new Promise((resolve) => setTimeout(resolve));

describe("obstacle list", () => {
  it("OB3: is what the server said last", () => {
    const { list } = setUp();
    list.receive([box(1), box(2)]);
    list.chosen.value = 2;
    list.receive([box(1)]);
    expect(list.drawn.value).toEqual([box(1)]);
    expect(list.chosen.value, "what is gone is no longer chosen").toBeNull();
  });

  it("shows a thing where the user has it until the server says", () => {
    const { list, sent } = setUp();
    list.receive([box(1), box(2, 5)]);
    list.move(2, { position: [7, 0, 0] });
    expect(sent).toEqual([{ kind: "move_obstacle", id: 2, pose: { position: [7, 0, 0] }, gesture: 1 }]);
    expect(list.drawn.value.map(({ pose }) => pose.position[0])).toEqual([0, 7]);
    list.settle(1);
    list.receive([box(1), box(2, 7)]);
    list.receive([box(1), box(2, 6)]);
    expect(
      list.drawn.value.map(({ pose }) => pose.position[0]),
      "another user was there",
    ).toEqual([0, 6]);
  });

  it("an answer to an earlier move takes no later one back", () => {
    const { list } = setUp();
    list.receive([box(1)]);
    for (const x of [1, 2, 3]) {
      list.move(1, { position: [x, 0, 0] });
    }
    const x = () => list.poseOf(1)?.position[0];
    list.settle(1);
    list.receive([box(1, 1)]);
    expect(x()).toBe(3);
    list.settle(3);
    list.receive([box(1, 2)]);
    expect(x(), "its turn is still to come").toBe(3);
    list.receive([box(1, 3)]);
    expect(x()).toBe(3);
  });

  it("a move that comes to nothing is shown no longer after a while", () => {
    const { list, clock } = setUp();
    list.receive([box(1)]);
    list.move(1, { position: [5, 0, 0] });
    list.settle(1);
    clock.pass(5000);
    expect(list.poseOf(1)?.position).toEqual([0, 0, 0]);
  });

  it("a thing is where a finger holds it, whatever the server sends", () => {
    const { list } = setUp();
    list.receive([box(1)]);
    list.preview({ id: 1, pose: { position: [4, 0, 0] } });
    list.receive([box(1), box(2)]);
    expect(list.poseOf(1)?.position).toEqual([4, 0, 0]);
    list.preview(null);
    expect(list.poseOf(1)?.position).toEqual([0, 0, 0]);
  });

  it("what this user placed is chosen when it appears", () => {
    const { list, sent } = setUp();
    list.receive([box(1)]);
    list.receive([box(1), box(2)]);
    expect(list.chosen.value, "someone else's is not").toBeNull();
    list.place({ kind: "sphere", radius: 3 }, { position: [0, 3, 0] });
    const ball: PlacedObstacle = { id: 3, shape: { kind: "sphere", radius: 3 }, pose: { position: [0, 3, 0] } };
    list.receive([box(1), box(2), ball]);
    expect([sent.length, list.chosen.value]).toEqual([1, 3]);
  });

  it("OB5: fetches each mesh once, and again in another epoch", async () => {
    const { list, world } = setUp();
    list.receive([model(4)]);
    expect(list.drawn.value[0]?.mesh, "not here yet").toBeUndefined();
    await settle();
    list.receive([model(4), box(5)]);
    await settle();
    expect([world.fetched, list.drawn.value[0]?.mesh]).toEqual([[4], mesh]);
    list.clear();
    list.receive([model(4)]);
    await settle();
    expect(world.fetched).toEqual([4, 4]);
  });

  it("a mesh that could not be fetched is asked for again with the next list", async () => {
    const { list, world } = setUp();
    world.fail = true;
    list.receive([model(4)]);
    await settle();
    expect(world.failures.length).toBe(1);
    world.fail = false;
    list.receive([model(4)]);
    await settle();
    expect(list.drawn.value[0]?.mesh).toBe(mesh);
  });

  it("OB2: another shape is shown at once, and sent by itself", () => {
    const { list, sent } = setUp();
    list.receive([box(1, 4)]);
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    expect(sent).toEqual([{ kind: "reshape_obstacle", id: 1, shape: { kind: "box", size: [9, 9, 9] }, gesture: 1 }]);
    expect(list.drawn.value).toEqual([{ ...box(1, 4), shape: { kind: "box", size: [9, 9, 9] } }]);
    expect(list.first(1), "how it was is remembered").toEqual(box(1, 4));
    list.forget();
    expect(list.first(1)).toBeNull();
  });

  it("OB2: what a user does without letting go has one gesture", () => {
    const { list, sent } = setUp();
    const group = new UndoGroup();
    list.receive([box(1, 4)]);
    list.move(1, { position: [5, 0, 0] }, group);
    list.reshape(1, { kind: "box", size: [9, 9, 9] }, group);
    list.move(1, { position: [4, 0, 0] }, group);
    list.remove(1);
    const gestures = sent.map((command) => "gesture" in command && command.gesture);
    expect(gestures, "the last was another group").toEqual([1, 1, 1, 4]);
  });

  it("LM6: what is refused is not awaited", () => {
    const { list, sent } = setUp();
    list.place({ kind: "sphere", radius: 3 }, { position: [0, 3, 0] });
    list.refused(sent[0]!);
    list.receive([{ id: 1, shape: { kind: "sphere", radius: 3 }, pose: { position: [0, 3, 0] } }]);
    expect(list.chosen.value, "someone else's alike is not taken up").toBeNull();
  });

  it("CM1: what was placed is awaited across a reconnection", () => {
    const { list } = setUp();
    list.place({ kind: "sphere", radius: 3 }, { position: [0, 3, 0] });
    list.clear();
    list.receive([box(1)]);
    list.receive([box(1), { id: 2, shape: { kind: "sphere", radius: 3 }, pose: { position: [0, 3, 0] } }]);
    expect(list.chosen.value).toBe(2);
  });

  it("an imported model is chosen, a broken one is reported", async () => {
    const { list, world } = setUp();
    await list.import([new File([], "a.glb")]);
    expect([list.chosen.value, list.transfer.progress.value]).toEqual([9, null]);
    await list.import([new File([], "a.stl")]);
    expect([world.failures.length, list.transfer.progress.value]).toEqual([1, null]);
    const gone = Object.assign(new File([], "a.gltf"), { arrayBuffer: () => Promise.reject(new Error("it is gone")) });
    await list.import([gone]);
    expect(world.failures.length, "a file that cannot be read as well").toBe(2);
    expect(world.simplified).toEqual([]);
  });

  it("OB6: says of an imported model that it was simplified", async () => {
    const { list, world } = setUp();
    world.file = { simplified_from: { vertices: 8000, triangles: 9000 } };
    await list.import([new File([], "a.obj")]);
    expect(world.simplified).toEqual([[9000, 1]]);
  });
});
