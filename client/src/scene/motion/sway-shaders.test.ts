import { describe, expect, it } from "vitest";
import { leanShader } from "../../../shader-plugin";
import { BRANCH_VERTEX, branchFragment } from "../glsl/branch";
import { LEAF_DEPTH_FRAGMENT, leafFragment, leafVertex } from "../glsl/leaf";
import { ornamentFragment, ornamentVertex } from "../glsl/ornament";
import { SKELETON_VERTEX } from "../glsl/skeleton";
import { swaying, weathering } from "./sway-shaders";

const SHADERS: readonly (readonly [name: string, shader: string, has: readonly string[]])[] = [
  ["branches", BRANCH_VERTEX, ["end.arc - (1.0 - u) * distance("]],
  ["leaves", leafVertex(), ["place = Leaf(mix(", "flutter(sway.air", "void flutter("]],
  ["flowers", ornamentVertex("Flower"), ["place = Leaf(mix("]],
  ["lines", SKELETON_VERTEX, []],
];

const count = (text: string, part: string) => text.split(part).length - 1;

describe.each(SHADERS)("the shader of %s", (_, shader, has) => {
  it.each([
    ["as it is written", shader],
    ["as the build shortens it", leanShader(shader)],
  ])("sways, %s", (_, plain) => {
    const changed = swaying(plain);
    expect(count(changed, "Node nodeAt(int row)")).toBe(1);
    expect(count(changed, "Node restAt(int row)")).toBe(1);
    expect(count(changed, "Sway swayAt(int row)")).toBe(1);
    for (const part of has) expect(count(changed, part), part).toBe(1);
    // What places a row is known before it is used.
    expect(changed.indexOf("Sway swayAt")).toBeLessThan(changed.indexOf("void main"));
  });
});

it("a shader that draws no rows is no shader that sways", () => {
  expect(() => swaying("void main() {}")).toThrow();
});

describe.each([
  ["bark", branchFragment(), "albedo = weathered(albedo, normal, 0.7 * noise("],
  ["leaves", leafFragment(), "albedo = mix(weathered(albedo, vec3(0.0, -1.0, 0.0), -0.05), "],
  ["flowers", ornamentFragment("Flower"), "albedo = weathered(albedo, normal, -0.05);"],
])("the colour of %s", (_, shader, change) => {
  it.each([
    ["as it is written", shader],
    ["as the build shortens it", leanShader(shader)],
  ])("is that of what snow lies on, %s", (_, plain) => {
    const changed = weathering(plain);
    expect(count(changed, change)).toBe(1);
    expect(changed.indexOf("vec3 weathered(")).toBeLessThan(changed.indexOf("void main"));
  });
});

it("shadows are those of what snow lies on", () => {
  expect(weathering(LEAF_DEPTH_FRAGMENT)).toBe(LEAF_DEPTH_FRAGMENT);
});
