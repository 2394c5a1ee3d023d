// Shows a file as any viewer that is built on three.js does.
import {
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  NeutralToneMapping,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { read } from "./readers.js";

/** three.js divides the light of diffuse surfaces by this, the page does not. */
const LAMBERT = Math.PI;

/** Draws the file at an address by a shot, and gives what its loader found in it. */
globalThis.show = async (address, { eye, target, angle, light }) => {
  const { tree, generator } = await read(address);
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight);
  renderer.toneMapping = NeutralToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  document.body.append(renderer.domElement);

  const scene = new Scene();
  scene.background = new Color(...light.middle);
  scene.add(tree);
  const box = new Box3().setFromObject(tree);
  const middle = box.getCenter(new Vector3());
  const reach = box.getSize(new Vector3()).length() / 2;

  const sun = new DirectionalLight(new Color(...light.sun), LAMBERT);
  sun.position.copy(middle).addScaledVector(new Vector3(...light.towards), 2 * reach);
  sun.target.position.copy(middle);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.normalBias = 0.02;
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, far: 4 * reach });
  const sky = new HemisphereLight(new Color(...light.above), new Color(...light.below), LAMBERT);
  scene.add(sun, sun.target, sky);

  const counts = { meshes: 0, triangles: 0, points: 0, textures: 0 };
  tree.traverse((node) => {
    if (node.isPoints) counts.points += node.geometry.attributes.position.count;
    if (!node.isMesh) return;
    node.castShadow = node.receiveShadow = true;
    counts.meshes += 1;
    const { index, attributes } = node.geometry;
    counts.triangles += (index ?? attributes.position).count / 3;
    for (const material of [node.material].flat())
      counts.textures += ["map", "normalMap", "roughnessMap"].filter((map) => material[map]).length;
  });

  const camera = new PerspectiveCamera(angle, innerWidth / innerHeight, 0.01 * reach, 20 * reach);
  camera.position.set(...eye);
  camera.lookAt(...target);
  renderer.render(scene, camera);
  return { generator, names: tree.children.map((node) => node.name), ...counts };
};
