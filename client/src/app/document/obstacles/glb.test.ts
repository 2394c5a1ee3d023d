import { describe, expect, it } from "vitest";
import { packedModel } from "./glb";

const text = (json: unknown) => new TextEncoder().encode(JSON.stringify(json));
const base64 = (bytes: readonly number[]) => btoa(String.fromCharCode(...bytes));

/** Takes a glTF binary apart, as a reader of the format would. */
function unpacked(glb: Uint8Array) {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  expect([view.getUint32(0, true), view.getUint32(4, true), view.getUint32(8, true)]).toEqual([
    0x46546c67,
    2,
    glb.length,
  ]);
  const chunks = new Map<number, Uint8Array>();
  for (let at = 12; at < glb.length; ) {
    const length = view.getUint32(at, true);
    expect([length % 4, at % 4], "chunks are aligned").toEqual([0, 0]);
    chunks.set(view.getUint32(at + 4, true), glb.subarray(at + 8, at + 8 + length));
    at += 8 + length;
  }
  return { json: JSON.parse(new TextDecoder().decode(chunks.get(0x4e4f534a))), binary: chunks.get(0x004e4942) };
}

describe("packed model", () => {
  it("a .glb goes as it is", () => {
    const bytes = new Uint8Array([1, 2, 3]);
    expect(packedModel([{ name: "Wall.GLB", bytes }])).toBe(bytes);
  });

  it("a .gltf takes its buffers along, inline and beside it", () => {
    const gltf = {
      asset: { version: "2.0" },
      buffers: [
        { byteLength: 5, uri: `data:application/octet-stream;base64,${base64([1, 2, 3, 4, 5])}` },
        { byteLength: 3, uri: "parts/my%20wall.bin" },
      ],
      bufferViews: [
        { buffer: 0, byteOffset: 2, byteLength: 3 },
        { buffer: 1, byteLength: 3 },
      ],
    };
    const { json, binary } = unpacked(
      packedModel([
        { name: "my wall.bin", bytes: new Uint8Array([7, 8, 9, 99]) },
        { name: "wall.gltf", bytes: text(gltf) },
      ]),
    );
    const views = json.bufferViews.map(({ buffer, byteOffset, byteLength }: Record<string, number>) => {
      expect(buffer).toBe(0);
      return [...binary!.subarray(byteOffset, byteOffset! + byteLength!)];
    });
    expect(views).toEqual([
      [3, 4, 5],
      [7, 8, 9],
    ]);
    expect(json.buffers).toEqual([{ byteLength: binary!.length }]);
  });

  it("says which file is missing, and what is none of the kind", () => {
    const lonely = { buffers: [{ byteLength: 4, uri: "far.bin" }] };
    expect(() => packedModel([{ name: "a.gltf", bytes: text(lonely) }])).toThrow("far.bin");
    expect(() => packedModel([{ name: "a.gltf", bytes: new Uint8Array([1]) }])).toThrow("a.gltf");
    expect(() => packedModel([{ name: "a.obj", bytes: new Uint8Array() }])).toThrow(".glb");
  });
});
