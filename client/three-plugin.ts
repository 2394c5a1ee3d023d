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
  "addLayerUpdate",
  "addScalar",
  "angleTo",
  "applyAxisAngle",
  "applyEuler",
  "clampLength",
  "clampScalar",
  "clearGroups",
  "clearViewOffset",
  "closestPointToPoint",
  "containsBox",
  "convertLinearToSRGB",
  "convertSRGBToLinear",
  "copyArray",
  "copyAt",
  "copyFramebufferToTexture",
  "copyLinearToSRGB",
  "copyPosition",
  "copySRGBToLinear",
  "copyTextureToTexture",
  "deleteAttribute",
  "determinant",
  "disableAll",
  "distanceSqToSegment",
  "distanceToPlane",
  "distanceToSphere",
  "divide",
  "enableAll",
  "expandByScalar",
  "expandByVector",
  "forceContextLoss",
  "forceContextRestore",
  "getActiveCubeFace",
  "getActiveMipmapLevel",
  "getArea",
  "getBoundingBox",
  "getBoundingSphere",
  "getComponent",
  "getCurrentViewport",
  "getDrawingBufferSize",
  "getEffectiveFOV",
  "getFilmHeight",
  "getFocalLength",
  "getHSL",
  "getHex",
  "getHexString",
  "getIndirect",
  "getMidpoint",
  "getObjectById",
  "getObjectByName",
  "getPixelRatio",
  "getPlane",
  "getRGB",
  "getScissor",
  "getScissorTest",
  "getStyle",
  "getViewBounds",
  "getViewSize",
  "getViewport",
  "getWorldPosition",
  "getWorldQuaternion",
  "getWorldScale",
  "hasEventListener",
  "initRenderTarget",
  "initTexture",
  "intersectLine",
  "intersectObject",
  "intersectPlane",
  "intersectsLine",
  "intersectsSprite",
  "lerp",
  "lerpColors",
  "lerpHSL",
  "lerpVectors",
  "localToWorld",
  "makeBasis",
  "makeRotationAxis",
  "makeRotationFromEuler",
  "makeRotationY",
  "makeRotationZ",
  "makeShear",
  "manhattanDistanceTo",
  "manhattanLength",
  "multiplyQuaternionsFlat",
  "multiplyVectors",
  "offsetHSL",
  "project",
  "projectOnPlane",
  "projectOnVector",
  "projectPoint",
  "randomDirection",
  "reflect",
  "reorder",
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
  "setDrawRange",
  "setFocalLength",
  "setFromArray",
  "setFromAttributeAndIndices",
  "setFromCamera",
  "setFromCenterAndSize",
  "setFromColor",
  "setFromCoplanarPoints",
  "setFromCylindrical",
  "setFromCylindricalCoords",
  "setFromMatrix3",
  "setFromMatrixScale",
  "setFromNormalAndCoplanarPoint",
  "setFromPointsAndIndices",
  "setFromSpherical",
  "setFromSphericalCoords",
  "setFromUnitVectors",
  "setFromVector3",
  "setFromXRController",
  "setHSL",
  "setIndirect",
  "setNodesHandler",
  "setOpaqueSort",
  "setOptional",
  "setPixelRatio",
  "setRenderTargetFramebuffer",
  "setRenderTargetTextures",
  "setRotationFromAxisAngle",
  "setRotationFromEuler",
  "setRotationFromMatrix",
  "setRotationFromQuaternion",
  "setScissor",
  "setTransparentSort",
  "setUsage",
  "setViewOffset",
  "setW",
  "setX",
  "setY",
  "setZ",
  "slerp",
  "slerpFlat",
  "slerpQuaternions",
  "subScalar",
  "transformUv",
  "translateOnAxis",
  "translateX",
  "translateY",
  "translateZ",
  "transposeIntoArray",
  "worldToLocal",
];
const LEFT_OUT = new Set([...MENTIONED, ...UNUSED_METHODS]);

/** What three.js asks of everything it draws and is never so here: these are known when the client is built. */
const NEVER = new Set([
  "isArrayCamera",
  "isBatchedMesh",
  "isCompressedArrayTexture",
  "isCompressedCubeTexture",
  "isCompressedTexture",
  "isCubeTexture",
  "isExternalTexture",
  "isFogExp2",
  "isFramebufferTexture",
  "isGLBufferAttribute",
  "isHTMLTexture",
  "isInstancedMesh",
  "isInterleavedBuffer",
  "isInterleavedBufferAttribute",
  "isLOD",
  "isLight",
  "isLightProbeGrid",
  "isLine",
  "isMeshLambertMaterial",
  "isMeshPhongMaterial",
  "isMeshPhysicalMaterial",
  "isMeshStandardMaterial",
  "isMeshToonMaterial",
  "isNodeMaterial",
  "isOutputPass",
  "isPoints",
  "isPresenting",
  "isSkinnedMesh",
  "isSprite",
  "isVideoTexture",
  "isWebGL3DRenderTarget",
  "isWebGLArrayRenderTarget",
  "isWebGLCubeRenderTarget",
  "isXRRenderTarget",
]);
/** The same for what always is so. */
const ALWAYS = new Set(["isRawShaderMaterial", "isShaderMaterial"]);
/** What only materials of three.js's own have. */
const OF_OTHER_MATERIALS = new Set([
  "alphaMap",
  "anisotropy",
  "anisotropyMap",
  "aoMap",
  "bumpMap",
  "clearcoat",
  "clearcoatMap",
  "clearcoatNormalMap",
  "clearcoatRoughnessMap",
  "diffuseRoughness",
  "diffuseRoughnessMap",
  "dispersion",
  "displacementMap",
  "emissiveMap",
  "envMap",
  "gradientMap",
  "iridescence",
  "iridescenceMap",
  "iridescenceThicknessMap",
  "lightMap",
  "map",
  "matcap",
  "metalnessMap",
  "normalMap",
  "retroreflectivity",
  "roughnessMap",
  "sheen",
  "sheenColorMap",
  "sheenRoughnessMap",
  "specularColorMap",
  "specularIntensityMap",
  "specularMap",
  "thicknessMap",
  "transmission",
  "transmissionMap",
]);
/** Functions that would be called for such things only. */
const IDLE = new Set(["renderTransmissionPass", "setTextureCube", "uploadCubeTexture"]);

/**
 * Leaves out of three.js what this client does not use and a bundler cannot know of: every material here is a
 * `RawShaderMaterial`, so that its own shaders, lights, shadows, environments and headsets would be a third of it.
 */
export function leanThree(): Plugin {
  const missing = new Set(REPLACED);
  /** Modules of three.js that make something of which it is taken as known that there is none. */
  const makers = new Map<string, string>();
  return {
    name: "espalier-lean-three",
    apply: "build",
    enforce: "pre",
    // Only the single modules can be left out; the published bundle holds all of them.
    config: () => ({ resolve: { alias: [{ find: /^three$/, replacement: "three/src/Three.js" }] } }),
    load(id) {
      const file = /[\\/]three[\\/]src[\\/](?:\w+[\\/])*(\w+)\.js$/.exec(id)?.[1] ?? "";
      const name = MODULE_NAMES[file] ?? file;
      if (!REPLACED.has(name)) {
        return null;
      }
      missing.delete(name);
      return `export { ${name} } from ${JSON.stringify(PARTS)};`;
    },
    transform(code, id) {
      if (!/[\\/]three[\\/]src[\\/]/.test(id)) {
        return null;
      }
      const { lean, makes } = leanModule(code, this.parse(code));
      for (const flag of makes) {
        makers.set(id, flag);
      }
      return { code: lean, map: null };
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
        for (const [id, flag] of makers) {
          if ((output.modules[id]?.renderedLength ?? 0) > 0) {
            this.error(`${output.fileName} needs ${id}, but three-plugin.ts has it that ${flag} is never so.`);
          }
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

/** The source of a module without what is left out, and which of what is never so it makes so. */
export function leanModule(code: string, program: ESTree.Program): { readonly lean: string; readonly makes: string[] } {
  const changes: { readonly start: number; readonly end: number; readonly by: string }[] = [];
  const makes: string[] = [];
  const set = new Set<ESTree.Node>();
  const cut = ({ start, end }: ESTree.Node) => changes.push({ start, end, by: "" });
  new Visitor({
    MethodDefinition(method) {
      if (method.key.type === "Identifier" && LEFT_OUT.has(method.key.name)) {
        cut(method);
      }
    },
    // The renderer makes its methods in its constructor, and a class gets its tables after it.
    ExpressionStatement(statement) {
      const { expression } = statement;
      const made = expression.type === "AssignmentExpression" ? expression.left : null;
      const own = made?.type === "MemberExpression" ? made.property : null;
      if (own?.type === "Identifier" && LEFT_OUT.has(own.name)) {
        cut(statement);
      }
    },
    FunctionDeclaration({ id, body }) {
      if (body && IDLE.has(id?.name ?? "")) {
        changes.push({ start: body.start, end: body.end, by: "{}" });
      }
    },
    AssignmentExpression({ left, right }) {
      set.add(left);
      const name = propertyOf(left);
      if (NEVER.has(name) && !(right.type === "Literal" && right.value === false)) {
        makes.push(name);
      }
    },
    MemberExpression(member) {
      const name = propertyOf(member);
      const known = ALWAYS.has(name)
        ? true
        : NEVER.has(name) || (ofMaterial(member) && OF_OTHER_MATERIALS.has(name))
          ? false
          : null;
      if (known !== null && !set.has(member)) {
        changes.push({ start: member.start, end: member.end, by: String(known) });
      }
    },
  }).visit(program);
  // What lies in another change goes with it.
  const outer = changes.filter(
    (one) => !changes.some((other) => other !== one && other.start <= one.start && one.end <= other.end),
  );
  const lean = outer
    .sort((one, other) => other.start - one.start)
    .reduce((rest, { start, end, by }) => rest.slice(0, start) + by + rest.slice(end), code);
  return { lean, makes };
}

/** The name of the property that is read or set; empty where it is none. */
function propertyOf(node: ESTree.Node): string {
  return node.type === "MemberExpression" && !node.computed && node.property.type === "Identifier"
    ? node.property.name
    : "";
}

/** Whether it is a property of a material, as the renderer calls it. */
function ofMaterial(member: ESTree.MemberExpression): boolean {
  return member.object.type === "Identifier" && member.object.name === "material";
}
