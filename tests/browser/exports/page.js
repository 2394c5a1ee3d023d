// Shows a glTF file as any viewer that is built on three.js does.
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
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";

/** Draws the file at an address, and gives what the loader found in it. */
globalThis.show = async (address) => {
  const { scene: tree, asset } = await new GLTFLoader().loadAsync(address);
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(innerWidth, innerHeight);
  renderer.toneMapping = NeutralToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  document.body.append(renderer.domElement);

  const scene = new Scene();
  scene.background = new Color(0xe2ded6);
  scene.add(tree);
  const box = new Box3().setFromObject(tree);
  const [middle, size] = [box.getCenter(new Vector3()), box.getSize(new Vector3())];
  const reach = size.length() / 2;

  const sun = new DirectionalLight(0xfff2dd, 4.5);
  sun.position.copy(middle).add(new Vector3(-0.6, 0.9, 0.6).multiplyScalar(2 * reach));
  sun.target.position.copy(middle);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.normalBias = 0.02;
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, far: 4 * reach });
  scene.add(sun, sun.target, new HemisphereLight(0xdfe9f5, 0x8a8068, 3));

  const counts = { meshes: 0, triangles: 0, textures: 0 };
  tree.traverse((node) => {
    if (!node.isMesh) return;
    node.castShadow = node.receiveShadow = true;
    counts.meshes += 1;
    counts.triangles += node.geometry.index.count / 3;
    counts.textures += ["map", "normalMap", "roughnessMap"].filter((map) => node.material[map]).length;
  });

  const camera = new PerspectiveCamera(35, innerWidth / innerHeight, 0.01 * reach, 20 * reach);
  const away = (0.5 * Math.max(size.y, size.x / camera.aspect)) / Math.tan((camera.fov * Math.PI) / 360);
  camera.position.set(middle.x, middle.y + 0.12 * away, middle.z + 1.12 * away + 0.3 * size.z);
  camera.lookAt(middle);
  renderer.render(scene, camera);
  return { generator: asset.generator, names: tree.children.map((node) => node.name), ...counts };
};
