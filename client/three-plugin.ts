import type { Plugin } from "vite";

/**
 * Leaves out of three.js the shaders of its own materials: every material here is a `RawShaderMaterial`, and they would be
 * a tenth of all that a tablet loads.
 */
export function leanThree(): Plugin {
  let emptied = false;
  return {
    name: "espalier-lean-three",
    apply: "build",
    enforce: "pre",
    // Only the single modules can be left out; the published bundle holds all of them.
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: "three/src/Three.js" }] } }),
    load(id) {
      if (!/[\\/]three[\\/]src[\\/]renderers[\\/]shaders[\\/]ShaderChunk\.js$/.test(id)) {
        return null;
      }
      emptied = true;
      return "export const ShaderChunk = {};";
    },
    buildEnd(error) {
      if (!error && !emptied) {
        this.error("three.js no longer keeps its shaders where they are left out.");
      }
    },
  };
}
