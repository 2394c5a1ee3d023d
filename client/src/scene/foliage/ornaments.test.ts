import { readFileSync } from "node:fs";
import { ShaderMaterial, type Vector4 } from "three";
import { beforeEach, describe, expect, it } from "vitest";
import { idlePainter } from "../../../test/idle-painter";
import { borneOf, countOf } from "../../../test/items";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { shaderFunctions } from "../../../test/shader-functions";
import { DEFAULT_APPEARANCE, type FlowerLook } from "../../wire/generated";
import { ORNAMENT_SHAPE } from "../glsl/ornament";
import type { Uniforms } from "../materials";
import { FLOWER_PICTURES } from "../painting/flowers";
import { FRUIT_PICTURES } from "../painting/fruits";
import { seeded } from "../painting/leaf-painter";
import type { TreeTable } from "../table/tree-table";
import { FLOWERS } from "./ornament-sorts";
import { Ornaments } from "./ornaments";
import { isBearing } from "./places";

const LOOK: FlowerLook = { ...DEFAULT_APPEARANCE.flowers, kind: "rosette", share: 0.4 };

describe("flowers", () => {
  let table: TreeTable;
  let uniforms: Uniforms;
  let flowers: Ornaments<FlowerLook>;

  /** What the table and the look ask for. */
  function expected(look: FlowerLook, together: number): Map<number, number> {
    const rows = Array.from({ length: table.rows }, (_, row) => row);
    return new Map(rows.filter((row) => isBearing(table, row, look, FLOWERS.salt)).map((row) => [row, together]));
  }

  function sync(): void {
    table.drain(
      (rows) => flowers.truncate(rows),
      (row, bits) => flowers.update(table, row, bits),
    );
    flowers.upload(table);
  }

  beforeEach(() => {
    table = new PlainTable(() => 0);
    table.apply(sampleTree({ seed: 5, height: 30, orders: 3 }));
    uniforms = {};
    flowers = new Ornaments(FLOWERS, new ShaderMaterial(), new ShaderMaterial(), uniforms, idlePainter());
    flowers.setLook(LOOK);
    sync();
  });

  it("are fewer in a coarse picture and cover as much", () => {
    const size = () => (uniforms.uFlowerFinish!.value as Vector4).x;
    const whole = countOf(flowers.mesh);
    const most = Math.ceil(whole / 4);
    flowers.detail({ leaves: most });
    expect(countOf(flowers.mesh)).toBeLessThanOrEqual(most);
    expect(size()).toBeCloseTo(2 * LOOK.size);
    flowers.detail({ leaves: Number.POSITIVE_INFINITY });
    expect([countOf(flowers.mesh), size()]).toEqual([whole, LOOK.size]);
  });

  it("stand where the look has them", () => {
    expect(borneOf(flowers.mesh)).toEqual(expected(LOOK, FLOWERS.kinds.rosette.together));
    for (const look of [
      { ...LOOK, share: 0.9 },
      { ...LOOK, place: "tips" },
      { ...LOOK, vigor: -1 },
    ] as const) {
      flowers.setLook(look);
      flowers.upload(table);
      expect(borneOf(flowers.mesh)).toEqual(expected(look, FLOWERS.kinds.rosette.together));
    }
  });

  it("follow the tree as it changes", () => {
    table.apply({
      epoch: 1,
      sequence: 2,
      catchUp: false,
      changes: [
        {
          change: "patch",
          chunk: 0,
          generation: 2,
          column: "foliage",
          rows: Uint8Array.from({ length: 256 }, (_, i) => i),
          values: Uint8Array.from({ length: 256 }, (_, i) => (i * 37) & 255),
        },
        { change: "truncate", rows: table.rows - 100 },
      ],
    });
    sync();
    expect(borneOf(flowers.mesh)).toEqual(expected(LOOK, FLOWERS.kinds.rosette.together));
  });

  it("that are none take nothing to draw", () => {
    flowers.setLook({ ...LOOK, kind: "none" });
    flowers.upload(table);
    expect([flowers.mesh.visible, flowers.caster.visible]).toEqual([false, false]);
    expect(borneOf(flowers.mesh).size).toBe(0);
  });

  it("only change colour and size in the shaders", () => {
    const before = borneOf(flowers.mesh);
    flowers.setLook({ ...LOOK, tint: [255, 0, 0], size: 1.5 });
    flowers.upload(table);
    expect(borneOf(flowers.mesh)).toEqual(before);
    expect(uniforms.uFlowerTint!.value.toArray()).toEqual([1, 0, 0]);
    expect(uniforms.uFlowerFinish!.value.x).toBe(1.5);
  });
});

it("a large tree bears fewer at a place, but as many places", () => {
  const table = new PlainTable(() => 0);
  table.apply(sampleTree({ seed: 2, height: 80, orders: 3 }));
  const flowers = new Ornaments<FlowerLook>(FLOWERS, new ShaderMaterial(), new ShaderMaterial(), {}, idlePainter());
  flowers.setLook({ ...LOOK, share: 1 });
  flowers.upload(table);
  const counts = borneOf(flowers.mesh);
  const rows = Array.from({ length: table.rows }, (_, row) => row);
  const places = rows.filter((row) => (table.foliage[row]! & 15) > 0 && table.radiusCode[row] !== 0);
  expect(places.length * FLOWERS.kinds.rosette.together).toBeGreaterThan(100_000);
  expect(counts.size).toBe(places.length);
  expect([...counts.values()].reduce((sum, count) => sum + count, 0)).toBeLessThanOrEqual(100_000);
});

it("every flower and fruit is painted within its tile", () => {
  for (const [name, paint] of [...Object.entries(FLOWER_PICTURES), ...Object.entries(FRUIT_PICTURES)]) {
    const { alpha, side, height } = paint(seeded(3));
    const covered = alpha.reduce((sum, value) => sum + value, 0) / alpha.length;
    expect(covered, name).toBeGreaterThan(0.15);
    expect(covered, name).toBeLessThan(0.85);
    expect(height.every(Number.isFinite)).toBe(true);
    const edge = Array.from({ length: side }, (_, i) => [
      i,
      i * side,
      (side - 1) * side + i,
      i * side + side - 1,
    ]).flat();
    expect(Math.max(...edge.map((at) => alpha[at]!)), name).toBeLessThan(0.5);
  }
});

it("flowers and fruits are shaped as in exports", () => {
  interface Functions {
    ornamentSize(random: number): number;
    ornamentAxis(direction: number[], hang: number, more: number[]): number[];
    ornamentHue(tint: number[], more: number[]): number[];
  }
  const shader = shaderFunctions<Functions>(ORNAMENT_SHAPE, ["ornamentSize", "ornamentAxis", "ornamentHue"]);
  const file = new URL("../../../../server/export/golden/ornaments.json", import.meta.url);
  const { shapes } = JSON.parse(readFileSync(file, "utf8"));
  expect(shapes.length).toBeGreaterThan(10);
  for (const { random, own, hang, direction, tint, size, axis, hue } of shapes) {
    const found = [
      shader.ornamentSize(random),
      ...shader.ornamentAxis(direction, hang, own),
      ...shader.ornamentHue(tint, own),
    ];
    for (const [i, wanted] of [...size, ...axis, ...hue].entries()) expect(found[i]).toBeCloseTo(wanted, 3);
  }
});
