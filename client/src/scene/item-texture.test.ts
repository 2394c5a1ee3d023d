import { RawShaderMaterial } from "three";
import { describe, expect, it } from "vitest";
import { BlockGeometry } from "./block-geometry";
import { ITEMS_A_LINE } from "./glsl/items";
import { ItemTexture } from "./item-texture";

const QUAD = [-1, 0, 1, 0, -1, 1, 1, 1];
const CORNERS = [0, 1, 2, 2, 1, 3];

describe("things drawn in blocks", () => {
  it("each have a number of their own, with no more than a block to spare", () => {
    const geometry = new BlockGeometry().shape("corner", QUAD, 2, CORNERS);
    geometry.draw(1000);
    const item = geometry.getAttribute("item");
    const numbers = new Set<number>();
    for (let instance = 0; instance < geometry.instanceCount; instance += 1) {
      // As `itemNumber` of `glsl/items.ts` has it.
      for (const corner of geometry.getIndex()!.array) numbers.add(instance * item.getY(corner) + item.getX(corner));
    }
    expect(numbers.size).toBeGreaterThanOrEqual(1000);
    expect(numbers.size).toBeLessThan(1000 + geometry.block);
    expect(Math.max(...numbers)).toBe(numbers.size - 1);
  });

  it("take few instances where they are small, and one each where they are large", () => {
    const small = new BlockGeometry().shape("corner", QUAD, 2, CORNERS);
    const large = new BlockGeometry().shape("corner", new Float32Array(2 * 300), 2, CORNERS);
    for (const geometry of [small, large]) geometry.draw(100_000);
    expect(small.instanceCount).toBeLessThan(2000);
    expect(large.instanceCount).toBe(100_000);
  });
});

describe("the numbers of many things", () => {
  const lines = (items: ItemTexture<Uint32Array<ArrayBuffer>>) => {
    const { value } = items.enter(new RawShaderMaterial()).uniforms.uItems!;
    return {
      texture: value,
      waiting: value.updateRanges.map(({ start }: { start: number }) => start / (4 * ITEMS_A_LINE)),
    };
  };

  it("stay when there is room for more", () => {
    const items = new ItemTexture(Uint32Array, 1);
    items.numbers[5] = 7;
    items.reserve(5 * ITEMS_A_LINE);
    expect(items.numbers[5]).toBe(7);
    expect(items.numbers.length).toBeGreaterThanOrEqual(4 * 5 * ITEMS_A_LINE);
  });

  it("are uploaded whole at first, and then the lines that have changed", () => {
    const items = new ItemTexture(Uint32Array, 1);
    items.reserve(4 * ITEMS_A_LINE);
    items.touch(3);
    items.upload(10);
    const { texture, waiting } = lines(items);
    expect(waiting).toEqual([]);
    texture.onUpdate(texture);
    items.touch(2 * ITEMS_A_LINE - 1, 2);
    items.upload(10);
    expect(lines(items).waiting).toEqual([1, 2]);
    items.uploadWhole();
    expect(lines(items).waiting).toEqual([]);
  });

  it("belong to one material of many that share the rest", () => {
    const shared = { uTime: { value: 1 } };
    const [one, other] = [new ItemTexture(Uint32Array, 1), new ItemTexture(Uint32Array, 1)];
    const material = new RawShaderMaterial({ uniforms: shared, defines: { RIBBON: "" } });
    const [a, b] = [one.copyOf(material), other.copyOf(material)];
    expect(a.uniforms.uTime).toBe(b.uniforms.uTime);
    expect(a.uniforms.uItems).not.toBe(b.uniforms.uItems);
    expect(a.defines).toEqual(material.defines);
    expect("uItems" in shared).toBe(false);
    Object.assign(shared, { uLater: { value: 2 } });
    expect("uLater" in a.uniforms, "what comes later is shared, too").toBe(true);
  });
});
