import { describe, expect, it } from "vitest";
import type { Command, PlacedObstacle } from "../wire/generated";
import { Hand, ObstacleList } from "./obstacle-list";

const mesh = { positions: new Float32Array(9), triangles: new Uint32Array(3) };

function setUp() {
  const sent: Command[] = [];
  const world = { fetched: [] as number[], failures: [] as unknown[], fail: false };
  const list = new ObstacleList({
    submit: (command) => sent.push(command),
    newGesture: () => sent.length + 1,
    session: () => "glade",
    fetchMesh: async (_, id) => {
      world.fetched.push(id);
      if (world.fail) throw new Error("gone");
      return mesh;
    },
    uploadModel: async () => model(9),
    failed: (error) => world.failures.push(error),
  });
  return { list, sent, world };
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
    expect(list.chosen.value, "what is gone is no longer at hand").toBeNull();
  });

  it("shows a thing where the hand has it until the server says", () => {
    const { list, sent } = setUp();
    list.receive([box(1), box(2, 5)]);
    list.move(2, { position: [7, 0, 0] });
    expect(sent).toEqual([{ kind: "move_obstacle", id: 2, pose: { position: [7, 0, 0] }, gesture: 1 }]);
    expect(list.drawn.value.map(({ pose }) => pose.position[0])).toEqual([0, 7]);
    list.receive([box(1), box(2, 6)]);
    expect(list.drawn.value.map(({ pose }) => pose.position[0])).toEqual([0, 6]);
  });

  it("what this hand placed is at hand when it appears", () => {
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

  const wide = { kind: "box", size: [9, 9, 9] } as const;
  const wideAt4 = (id: number): PlacedObstacle => ({ ...box(id, 4), shape: { kind: "box", size: [9, 9, 9] } });

  it("another shape takes the old one's place", () => {
    const { list, sent } = setUp();
    list.receive([box(1, 4)]);
    list.chosen.value = 1;
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    const obstacle = { shape: wide, pose: { position: [4, 0, 0] } };
    const placed = { kind: "place_obstacle", obstacle, gesture: 1 };
    expect(sent, "the old one stays until the new one stands").toEqual([placed]);
    list.receive([box(1, 4), wideAt4(2)]);
    expect(sent, "OB2: both are one for undo").toEqual([placed, { kind: "remove_obstacle", id: 1, gesture: 1 }]);
    expect(list.chosen.value).toBe(2);
    list.receive([box(1, 4), wideAt4(2)]);
    expect(list.list.value, "never both").toEqual([wideAt4(2)]);
    list.receive([wideAt4(2)]);
    list.receive([box(1, 4), wideAt4(2)]);
    expect(list.list.value.length, "undo brings the old one back").toBe(2);
    list.receive([wideAt4(2)]);
    expect(list.chosen.value).toBe(2);
  });

  it("LM6: a shape that is refused removes nothing", () => {
    const { list, sent } = setUp();
    list.receive([box(1, 4)]);
    list.chosen.value = 1;
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    list.refused(sent[0]!);
    list.receive([box(1, 4), wideAt4(2)]);
    expect(sent.length, "someone else's alike is no answer").toBe(1);
    expect(list.chosen.value, "and not taken up").toBe(1);
  });

  it("CM1: a new shape is awaited across a reconnection", () => {
    const { list, sent } = setUp();
    list.receive([box(1, 4)]);
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    list.clear();
    list.receive([box(1, 4)]);
    list.receive([box(1, 4), wideAt4(2)]);
    expect(sent.slice(1)).toEqual([{ kind: "remove_obstacle", id: 1, gesture: 1 }]);
  });

  it("another's obstacle is no answer to a new shape", () => {
    const { list, sent } = setUp();
    list.receive([box(1, 4)]);
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    list.receive([box(1, 4), box(2, 30)]);
    expect(sent.length).toBe(1);
    list.receive([box(1, 4), box(2, 30), wideAt4(3)]);
    expect(sent.at(-1)).toEqual({ kind: "remove_obstacle", id: 1, gesture: 1 });
  });

  it("of shapes asked for one after the other the last counts", () => {
    const { list, sent } = setUp();
    list.receive([box(1, 4)]);
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    list.reshape(1, { kind: "box", size: [7, 7, 7] });
    list.reshape(1, { kind: "box", size: [8, 8, 8] });
    expect(sent.length).toBe(1);
    list.receive([box(1, 4), wideAt4(2)]);
    const last = { kind: "place_obstacle", obstacle: { shape: { kind: "box", size: [8, 8, 8] } } };
    expect(sent.slice(1)).toMatchObject([{ kind: "remove_obstacle", id: 1 }, last]);
  });

  it("OB2: what a hand does without letting go has one gesture", () => {
    const { list, sent } = setUp();
    const hand = new Hand();
    list.receive([box(1, 4)]);
    list.move(1, { position: [5, 0, 0] }, hand);
    list.receive([box(1, 5)]);
    list.move(1, { position: [4, 0, 0] }, hand);
    list.receive([box(1, 4)]);
    list.reshape(1, { kind: "box", size: [9, 9, 9] }, hand);
    list.reshape(1, { kind: "box", size: [8, 8, 8] }, hand);
    list.receive([box(1, 4), wideAt4(2)]);
    list.remove(2);
    const gestures = sent.map((command) => "gesture" in command && command.gesture);
    expect(gestures, "the last was another hand").toEqual([1, 1, 1, 1, 1, 6]);
  });

  it("a shape that was undone is at hand as the other was", () => {
    const { list } = setUp();
    list.receive([box(1, 4)]);
    list.chosen.value = 1;
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    list.receive([box(1, 4), wideAt4(2)]);
    expect([list.chosen.value, list.list.value.length]).toEqual([2, 1]);
    // The server may have been done with both before it told anything.
    list.receive([box(1, 4)]);
    expect([list.chosen.value, list.list.value]).toEqual([1, [box(1, 4)]]);
    list.receive([wideAt4(2)]);
    expect(list.chosen.value, "and redone").toBe(2);
  });

  it("remembers how one was through all its shapes", () => {
    const { list } = setUp();
    list.receive([box(1, 4)]);
    list.reshape(1, { kind: "box", size: [9, 9, 9] });
    list.receive([box(1, 4), wideAt4(2)]);
    expect(list.first(2)).toMatchObject({ shape: box(1).shape, pose: { position: [4, 0, 0] } });
    list.forget();
    expect(list.first(2)).toBeNull();
  });

  it("an imported model is at hand, a broken one is told of", async () => {
    const { list, world } = setUp();
    await list.import([{ name: "a.glb", bytes: new Uint8Array(4) }]);
    expect([list.chosen.value, list.transfer.progress.value]).toEqual([9, null]);
    await list.import([{ name: "a.obj", bytes: new Uint8Array(4) }]);
    expect([world.failures.length, list.transfer.progress.value]).toEqual([1, null]);
  });
});
