// Shows a file as any viewer that is built on three.js does.
import {
  AnimationMixer,
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  Matrix4,
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

/** Draws the file at an address by a shot, so many seconds within its sway, and gives what its loader found in it. */
globalThis.show = async (address, { eye, target, angle, light }, time) => {
  const { tree, generator, clips = [], texture = null } = await read(address);
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
  const sway = clips.find(({ name }) => name.includes("Sway"));
  if (sway && time !== null) {
    const mixer = new AnimationMixer(tree);
    mixer.clipAction(sway).play();
    mixer.setTime(time);
  }
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

  const counts = { meshes: 0, triangles: 0, wood: 0, instances: 0, points: 0, textures: 0, bones: 0 };
  tree.traverse((node) => {
    if (node.isPoints) counts.points += node.geometry.attributes.position.count;
    if (!node.isMesh) return;
    node.castShadow = node.receiveShadow = true;
    counts.meshes += 1;
    counts.triangles += trianglesOf(node);
    if (isWood(node)) counts.wood += trianglesOf(node);
    if (node.isSkinnedMesh) counts.bones = Math.max(counts.bones, node.skeleton.bones.length);
    if (node.isInstancedMesh) counts.instances += node.count;
    for (const material of [node.material].flat())
      counts.textures += ["map", "normalMap", "roughnessMap"].filter((map) => material[map]).length;
  });

  const camera = new PerspectiveCamera(angle, innerWidth / innerHeight, 0.01 * reach, 20 * reach);
  camera.position.set(...eye);
  camera.lookAt(...target);
  renderer.render(scene, camera);
  globalThis.showWood = () => {
    tree.traverse((node) => {
      if (node.isMesh || node.isPoints) node.visible = isWood(node);
    });
    renderer.render(scene, camera);
  };
  const names = tree.children.map((node) => node.name);
  const floats = texture && { width: texture.width, height: texture.height, bits: [...texture.data] };
  return { generator, names, ...counts, seconds: sway?.duration ?? 0, box: boundsOf(tree), floats };
};

/** How many triangles of a mesh are drawn: of several materials, those that have one. */
function trianglesOf({ geometry, material, isInstancedMesh, count }) {
  const { index, attributes, groups } = geometry;
  const drawn = Array.isArray(material)
    ? groups.reduce((sum, group) => sum + group.count, 0)
    : (index ?? attributes.position).count;
  return (drawn / 3) * (isInstancedMesh ? count : 1);
}

/** Whether a node belongs to a plant's wood: each file names it so, in its own way. */
function isWood(node) {
  return node !== null && (/(^|[_ ])Wood/.test(node.name) || isWood(node.parent));
}

/** The box around all vertices where bones and instances have them: the least and the most along each axis. */
function boundsOf(tree) {
  tree.updateMatrixWorld(true);
  const box = new Box3();
  const [place, matrix] = [new Vector3(), new Matrix4()];
  tree.traverse((node) => {
    if (!node.isMesh && !node.isPoints) return;
    const { position } = node.geometry.attributes;
    for (let instance = 0; instance < (node.isInstancedMesh ? node.count : 1); instance++) {
      if (node.isInstancedMesh) node.getMatrixAt(instance, matrix);
      else matrix.identity();
      matrix.premultiply(node.matrixWorld);
      for (let at = 0; at < position.count; at++) {
        if (node.isSkinnedMesh) node.getVertexPosition(at, place);
        else place.fromBufferAttribute(position, at);
        box.expandByPoint(place.applyMatrix4(matrix));
      }
    }
  });
  return [box.min.toArray(), box.max.toArray()];
}
