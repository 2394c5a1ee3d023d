// Reads what the program writes by the loaders that three.js has for it.
import {
  BufferAttribute,
  Color,
  DoubleSide,
  FileLoader,
  HalfFloatType,
  LoadingManager,
  Points,
  PointsMaterial,
  Vector3,
} from "three";
import { unzipSync } from "three/examples/jsm/libs/fflate.module.js";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { MTLLoader } from "three/examples/jsm/loaders/MTLLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { USDLoader } from "three/examples/jsm/loaders/USDLoader.js";

/** What each ending is read by: gives the tree, Y up and in metres, the program that the file says it is from, and how it moves. */
const READERS = {
  glb: async (address) => {
    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
    const { scene, asset, animations } = await loader.loadAsync(address);
    return { tree: scene, generator: asset.generator, clips: animations };
  },
  "obj.zip": async (address) => ({ tree: await objOf(await bytesAt(address)), generator: null }),
  "pivots.zip": async (address) => {
    const files = unzipSync(new Uint8Array(await bytesAt(address)));
    const bytes = (name) => files[name].slice().buffer;
    const { scene, asset } = await new GLTFLoader().parseAsync(bytes("tree.glb"), "");
    const texture = new EXRLoader().setDataType(HalfFloatType).parse(bytes("tree_pivot_index.exr"));
    return { tree: scene, generator: asset.generator, texture };
  },
  usda: async (address) => stageOf(await new USDLoader().loadAsync(address)),
  "usda.zip": async (address) => stageOf(await unpackedStage(await bytesAt(address))),
  usdz: async (address) => stageOf(await new USDLoader().loadAsync(address)),
  ply: async (address) => ({ tree: cloudOf(await bytesAt(address)), generator: null }),
};

export function read(address) {
  const ending = address.slice(address.indexOf(".", address.lastIndexOf("/")) + 1);
  return READERS[ending](address);
}

async function bytesAt(address) {
  return new FileLoader().setResponseType("arraybuffer").loadAsync(address);
}

/** An OBJ with its materials and textures from the archive it comes in. */
async function objOf(archive) {
  const files = unzipSync(new Uint8Array(archive));
  const text = (name) => new TextDecoder().decode(files[name]);
  const manager = new LoadingManager();
  const loaded = new Promise((done, failed) => Object.assign(manager, { onLoad: done, onError: failed }));
  manager.setURLModifier((name) => URL.createObjectURL(new Blob([files[name]], { type: "image/png" })));
  // MTLLoader takes the words of `-imfchan`, which it does not know, for the picture's name.
  const cutOut = [...text("tree.mtl").matchAll(/newmtl (\S+)(?:\n(?!newmtl).*)*?\nmap_d -imfchan m /g)].map(
    ([, name]) => name,
  );
  const materials = new MTLLoader(manager).parse(text("tree.mtl").replaceAll(/^map_d -imfchan m .*$/gm, ""), "");
  materials.preload();
  const tree = new OBJLoader(manager).setMaterials(materials).parse(text("tree.obj"));
  for (const name of cutOut) Object.assign(materials.materials[name], { alphaTest: 0.5, side: DoubleSide });
  await loaded;
  return tree;
}

/** A stage whose text names its textures, from the archive they come in together, as where it was unpacked. */
async function unpackedStage(archive) {
  const files = unzipSync(new Uint8Array(archive));
  const manager = new LoadingManager();
  manager.setURLModifier((path) => {
    const picture = files[path.slice(path.lastIndexOf("/") + 1)];
    return URL.createObjectURL(new Blob([picture], { type: "image/png" }));
  });
  const text = new TextDecoder().decode(files["tree.usda"]);
  return new Promise((done, failed) => new USDLoader(manager).parse(text, "folder/", done, failed));
}

/** A stage of USD. */
function stageOf(stage) {
  // USDLoader passes over `doubleSided`, which all meshes but wood say; wood is closed.
  stage.traverse((node) => {
    for (const material of node.isMesh ? [node.material].flat() : []) material.side = DoubleSide;
  });
  return { tree: stage, generator: null, clips: stage.animations };
}

/** Colours of labels of a cloud of points (wood, leaves, flowers, fruits), and where the light on it comes from, for the file has neither. */
const LABELS = [new Color("#6b4a33"), new Color("#5f9a3a"), new Color("#f0dce6"), new Color("#b8322a")];
const LIGHT = new Vector3(0.4, 0.45, 0.8);

/** A cloud, which has Z up, with each point in the colour of its label and lit by its normal. */
function cloudOf(bytes) {
  const loader = new PLYLoader();
  loader.setCustomPropertyNameMapping({ label: ["label"] });
  const points = loader.parse(bytes);
  const { normal, label } = points.attributes;
  const colours = new Float32Array(3 * label.count);
  for (let at = 0; at < label.count; at++) {
    const facing = normal.getX(at) * LIGHT.x + normal.getY(at) * LIGHT.y + normal.getZ(at) * LIGHT.z;
    // What wood bears is seen from either side.
    const lit = 0.45 + 0.55 * (label.getX(at) > 0 ? Math.abs(facing) : Math.max(facing, 0));
    LABELS[label.getX(at)]
      .clone()
      .multiplyScalar(lit)
      .toArray(colours, 3 * at);
  }
  points.setAttribute("color", new BufferAttribute(colours, 3));
  const size = 1.5 * devicePixelRatio;
  const cloud = new Points(points, new PointsMaterial({ size, sizeAttenuation: false, vertexColors: true }));
  cloud.rotation.x = -Math.PI / 2;
  return cloud;
}
