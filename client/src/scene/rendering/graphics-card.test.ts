import { expect, it } from "vitest";
import { drawsWithProcessor } from "./graphics-card";

function named(unmasked: string | null, masked = "WebKit WebGL"): WebGL2RenderingContext {
  const gl = {
    RENDERER: 1,
    getExtension: () => (unmasked === null ? null : { UNMASKED_RENDERER_WEBGL: 2 }),
    getParameter: (name: number) => (name === 2 ? unmasked : masked),
  };
  return gl as unknown as WebGL2RenderingContext;
}

it("a processor that draws is known by its name", () => {
  for (const name of [
    "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)",
    "llvmpipe (LLVM 15.0.7, 256 bits)",
    "ANGLE (Microsoft, Microsoft Basic Render Driver Direct3D11)",
  ]) {
    expect(drawsWithProcessor(named(name)), name).toBe(true);
    expect(drawsWithProcessor(named(null, name)), `${name}, told at once`).toBe(true);
  }
});

it("a graphics card is not taken for one", () => {
  for (const name of ["Apple GPU", "Adreno (TM) 650", "Mali-G78", "ANGLE (NVIDIA, NVIDIA GeForce RTX 3060 OpenGL)"]) {
    expect(drawsWithProcessor(named(name)), name).toBe(false);
  }
  expect(drawsWithProcessor(named(null))).toBe(false);
});
