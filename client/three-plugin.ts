import { readFileSync } from "node:fs";
import { join } from "node:path";
import { type ESTree, type Plugin, Visitor } from "vite";

const PARTS = join(import.meta.dirname, "three-parts.js").replaceAll("\\", "/");

/** What stands in for a module of three.js of the same name, as `three-parts.js` exports it. */
const REPLACED = new Set(
  [...readFileSync(PARTS, "utf8").matchAll(/^export (?:function|const) (\w+)/gm)].map(([, name]) => name!),
);
/** The one module that is not named as what it exports. */
const MODULE_NAMES: Readonly<Record<string, string>> = { DFGLUTData: "getDFGLUT" };

/** What only tools for authors and colours by name need, though three.js itself mentions it. */
const MENTIONED = ["toJSON", "fromJSON", "setStyle", "setColorName", "NAMES"];
/** The largest methods of its classes that nothing calls; the built client must not mention them. */
const UNUSED_METHODS = [
  "addColors",
  "applyAxisAngle",
  "clampLength",
  "clampScalar",
  "clearViewOffset",
  "closestPointToPoint",
  "containsBox",
  "copyAt",
  "copyFramebufferToTexture",
  "copyPosition",
  "copyTextureToTexture",
  "determinant",
  "distanceSqToSegment",
  "divide",
  "forceContextLoss",
  "forceContextRestore",
  "getArea",
  "getBoundingBox",
  "getBoundingSphere",
  "getComponent",
  "getDrawingBufferSize",
  "getEffectiveFOV",
  "getFocalLength",
  "getHexString",
  "getMidpoint",
  "getRGB",
  "getStyle",
  "getViewSize",
  "getWorldPosition",
  "getWorldQuaternion",
  "getWorldScale",
  "initRenderTarget",
  "initTexture",
  "intersectLine",
  "intersectObject",
  "intersectPlane",
  "intersectsLine",
  "lerp",
  "lerpColors",
  "lerpHSL",
  "lerpVectors",
  "localToWorld",
  "makeBasis",
  "makeRotationAxis",
  "makeRotationFromEuler",
  "makeShear",
  "manhattanDistanceTo",
  "manhattanLength",
  "multiplyQuaternionsFlat",
  "multiplyVectors",
  "offsetHSL",
  "projectOnPlane",
  "projectPoint",
  "randomDirection",
  "resetState",
  "rotateAround",
  "rotateOnWorldAxis",
  "rotateTowards",
  "rotateY",
  "rotateZ",
  "roundToZero",
  "setAxisAngleFromQuaternion",
  "setAxisAngleFromRotationMatrix",
  "setComponent",
  "setFocalLength",
  "setFromArray",
  "setFromAttributeAndIndices",
  "setFromCamera",
  "setFromCenterAndSize",
  "setFromMatrix3",
  "setFromMatrixScale",
  "setFromPointsAndIndices",
  "setFromUnitVectors",
  "setFromVector3",
  "setFromXRController",
  "setIndirect",
  "setNodesHandler",
  "setPixelRatio",
  "setRenderTargetFramebuffer",
  "setRenderTargetTextures",
  "setScissor",
  "setViewOffset",
  "slerpFlat",
  "subScalar",
  "transformUv",
  "transposeIntoArray",
  "worldToLocal",
];
const LEFT_OUT = new Set([...MENTIONED, ...UNUSED_METHODS]);

/**
 * Leaves out of three.js what this client does not use and a bundler cannot know of: every material here is a
 * `RawShaderMaterial`, so that its own shaders, lights, shadows, environments and headsets would be a third of it.
 */
export function leanThree(): Plugin {
  const missing = new Set(REPLACED);
  return {
    name: "espalier-lean-three",
    apply: "build",
    enforce: "pre",
    // Only the single modules can be left out; the published bundle holds all of them.
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: "three/src/Three.js" }] } }),
    load(id) {
      const file = /[\\/]three[\\/]src[\\/]renderers[\\/](?:\w+[\\/])?(\w+)\.js$/.exec(id)?.[1] ?? "";
      const name = MODULE_NAMES[file] ?? file;
      if (!REPLACED.has(name)) {
        return null;
      }
      missing.delete(name);
      return `export { ${name} } from ${JSON.stringify(PARTS)};`;
    },
    transform(code, id) {
      return /[\\/]three[\\/]src[\\/]/.test(id) ? { code: withoutMethods(code, this.parse(code)), map: null } : null;
    },
    generateBundle(_options, bundle) {
      const mentioned = new RegExp(`\\.(${UNUSED_METHODS.join("|")})\\b`);
      for (const output of Object.values(bundle)) {
        // The page of the API draws nothing, and its library has methods of such names.
        if (output.type !== "chunk" || output.facadeModuleId?.endsWith("/api.html")) continue;
        const [, name] = mentioned.exec(output.code) ?? [];
        if (name !== undefined) {
          this.error(`${output.fileName} uses ${name}, which three-plugin.ts leaves out of three.js.`);
        }
      }
    },
    buildEnd(error) {
      if (!error && missing.size > 0) {
        this.error(`three.js no longer has the modules that are left out: ${[...missing].join(", ")}.`);
      }
    },
  };
}

/** The source of a module without the methods that are left out. */
function withoutMethods(code: string, program: ESTree.Program): string {
  const cuts: { readonly start: number; readonly end: number }[] = [];
  new Visitor({
    MethodDefinition(method) {
      if (method.key.type === "Identifier" && LEFT_OUT.has(method.key.name)) {
        cuts.push(method);
      }
    },
    // The renderer makes its methods in its constructor, and a class gets its tables after it.
    ExpressionStatement(statement) {
      const { expression } = statement;
      const made = expression.type === "AssignmentExpression" ? expression.left : null;
      const own = made?.type === "MemberExpression" ? made.property : null;
      if (own?.type === "Identifier" && LEFT_OUT.has(own.name)) {
        cuts.push(statement);
      }
    },
  }).visit(program);
  return cuts.reduceRight((rest, { start, end }) => rest.slice(0, start) + rest.slice(end), code);
}
