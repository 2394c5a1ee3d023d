import { describe, expect, it } from "vitest";
import { modelFile } from "./model-file";

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

const file = (name: string, bytes: Uint8Array<ArrayBuffer> = new Uint8Array()) => new File([bytes], name);

describe("model file", () => {
  it("a .glb or .obj goes as it is, unread", async () => {
    const glb = file("Wall.GLB");
    expect(await modelFile([file("wall.bin"), glb])).toEqual({ type: "model/gltf-binary", body: glb });
    const obj = file("oak.obj");
    expect((await modelFile([file("oak.mtl"), obj])).body).toBe(obj);
  });

  it("a .gltf takes its buffers along, inline and beside it", async () => {
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
    const { type, body } = await modelFile([
      file("my wall.bin", new Uint8Array([7, 8, 9, 99])),
      file("wall.gltf", text(gltf)),
    ]);
    expect(type).toBe("model/gltf-binary");
    const { json, binary } = unpacked(new Uint8Array(await body.arrayBuffer()));
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

  it("says which file is missing, and what is none of the kind", async () => {
    const lonely = { buffers: [{ byteLength: 4, uri: "far.bin" }] };
    await expect(modelFile([file("a.gltf", text(lonely))])).rejects.toThrow("far.bin");
    await expect(modelFile([file("a.gltf", new Uint8Array([1]))])).rejects.toThrow("a.gltf");
    await expect(modelFile([file("a.stl")])).rejects.toThrow(".obj");
  });
});
