import { BufferGeometry, Group, Mesh, RawShaderMaterial, type WebGLRenderer } from "three";
import { expect, it } from "vitest";
import { BRANCH_VERTEX, branchFragment } from "../glsl/branch";
import { OLD_WOOD } from "../glsl/wood";
import { SwayMaterials } from "./sway-materials";
import { swaying, weathering } from "./sway-shaders";

const [COARSE, FINE] = [branchFragment(), branchFragment(OLD_WOOD)];

/** Materials whose programs are made once `link` says so. */
function setUp() {
  const links: (() => void)[] = [];
  const renderer = {
    compileAsync: () => new Promise<void>((resolve) => links.push(resolve)),
  } as unknown as WebGLRenderer;
  const material = new RawShaderMaterial({ vertexShader: BRANCH_VERTEX, fragmentShader: COARSE });
  const group = new Group().add(new Mesh(new BufferGeometry(), material));
  const materials = new SwayMaterials(renderer, [group], new Mesh());
  const link = () => {
    for (const done of links.splice(0)) done();
  };
  const refine = () => {
    // Bark keeps its vertex shader.
    material.fragmentShader = FINE;
    materials.renew();
  };
  const sways = (fragment: string) =>
    material.vertexShader === swaying(BRANCH_VERTEX) && material.fragmentShader === weathering(fragment);
  return { materials, material, link, refine, sways };
}

it("what sways goes on swaying while programs of finer shaders are made, and then sways with those", async () => {
  const { materials, material, link, refine, sways } = setUp();
  const prepared = materials.prepare();
  expect(materials.ready).toBe(false);
  link();
  await prepared;
  expect(materials.complete).toBe(true);
  materials.sway(true);
  refine();
  expect([materials.ready, materials.swaying, materials.complete]).toEqual([true, true, false]);
  expect(sways(COARSE)).toBe(true);
  const again = materials.prepare();
  expect(sways(COARSE)).toBe(true);
  link();
  await again;
  expect(materials.complete).toBe(true);
  expect(sways(FINE)).toBe(true);
  materials.sway(false);
  expect([material.vertexShader, material.fragmentShader]).toEqual([BRANCH_VERTEX, FINE]);
});

it("what comes to rest meanwhile stands with the finer ones", async () => {
  const { materials, material, link, refine, sways } = setUp();
  const prepared = materials.prepare();
  link();
  await prepared;
  materials.sway(true);
  refine();
  materials.sway(false);
  expect(material.fragmentShader).toBe(FINE);
  expect(materials.ready, "it does not begin with coarse ones").toBe(false);
  const again = materials.prepare();
  link();
  await again;
  materials.sway(true);
  expect(sways(FINE)).toBe(true);
});

it("programs of shaders that were changed meanwhile do not count", async () => {
  const { materials, link, refine, sways } = setUp();
  const prepared = materials.prepare();
  refine();
  link();
  await prepared;
  expect(materials.ready).toBe(false);
  const again = materials.prepare();
  link();
  await again;
  materials.sway(true);
  expect(sways(FINE)).toBe(true);
});
