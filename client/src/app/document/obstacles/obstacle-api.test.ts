import { describe, expect, it } from "vitest";
import { readMesh } from "./obstacle-api";

function meshBytes(vertices: readonly number[], corners: readonly number[]): ArrayBuffer {
  const bytes = new ArrayBuffer(8 + 4 * vertices.length + 4 * corners.length);
  const view = new DataView(bytes);
  view.setUint32(0, vertices.length / 3, true);
  view.setUint32(4, corners.length / 3, true);
  vertices.forEach((value, i) => {
    view.setFloat32(8 + 4 * i, value, true);
  });
  corners.forEach((value, i) => {
    view.setUint32(8 + 4 * vertices.length + 4 * i, value, true);
  });
  return bytes;
}

describe("mesh of an obstacle", () => {
  it("OB4: is vertices, then corners", () => {
    const { positions, triangles } = readMesh(meshBytes([0, 0, 0, 1.5, 0, 0, 0, -2, 0], [0, 1, 2]));
    expect([...positions]).toEqual([0, 0, 0, 1.5, 0, 0, 0, -2, 0]);
    expect([...triangles]).toEqual([0, 1, 2]);
  });

  it("OB4: that is cut short or points elsewhere is no mesh", () => {
    const whole = meshBytes([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
    for (const length of [0, 7, 8, whole.byteLength - 1]) {
      expect(() => readMesh(whole.slice(0, length)), String(length)).toThrow("cut short");
    }
    expect(() => readMesh(meshBytes([0, 0, 0], [0, 0, 1]))).toThrow("corner");
  });
});
