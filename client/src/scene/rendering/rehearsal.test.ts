import { InstancedBufferGeometry, Mesh, type WebGLRenderer } from "three";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { Rehearsal } from "./rehearsal";

describe("a rehearsal", () => {
  const program = { getUniforms: vi.fn() };
  let link: () => void;
  let cast: Mesh<InstancedBufferGeometry>[];
  let rehearsal: Rehearsal;
  const linked = vi.fn();
  const compileAsync = vi.fn();

  beforeEach(() => {
    vi.resetAllMocks();
    const linking = new Promise<void>((resolve) => {
      link = resolve;
    });
    compileAsync.mockReturnValue(linking);
    const renderer = {
      compileAsync,
      info: { programs: [program] },
    };
    cast = [0, 1].map(() => new Mesh(new InstancedBufferGeometry()));
    for (const { geometry } of cast) geometry.instanceCount = 0;
    cast[1]!.visible = false;
    rehearsal = new Rehearsal(renderer as unknown as WebGLRenderer, cast, linked);
    rehearsal.begin();
    rehearsal.begin();
  });

  it("prepares programs without blocking", async () => {
    expect(compileAsync).toHaveBeenCalledTimes(cast.length);
    expect(rehearsal.prepare()).toBe(false);
    expect(program.getUniforms).not.toHaveBeenCalled();
    link();
    await vi.waitFor(() => expect(linked).toHaveBeenCalled());
    expect(rehearsal.prepare()).toBe(true);
    expect(rehearsal.prepare()).toBe(true);
    expect(program.getUniforms).toHaveBeenCalledOnce();
  });

  it("shows one instance of everything once, and leaves no trace", () => {
    const seen: [number, boolean][] = [];
    const draw = () => seen.push(...cast.map((mesh): [number, boolean] => [mesh.geometry.instanceCount, mesh.visible]));
    rehearsal.play(draw);
    rehearsal.play(draw);
    expect(seen).toEqual([
      [1, true],
      [1, true],
    ]);
    expect(cast.map(({ geometry, visible }) => [geometry.instanceCount, visible])).toEqual([
      [0, true],
      [0, false],
    ]);
  });
});
