import { describe, expect, it } from "vitest";
import { leanShader } from "../../../shader-plugin";
import { BRANCH_VERTEX } from "../glsl/branch";
import { LEAF_VERTEX } from "../glsl/leaf";
import { ornamentVertex } from "../glsl/ornament";
import { SKELETON_VERTEX } from "../glsl/skeleton";
import { swaying } from "./sway-shaders";

const SHADERS: readonly (readonly [name: string, shader: string, has: readonly string[]])[] = [
  ["branches", BRANCH_VERTEX, ["end.arc - (1.0 - u) * distance("]],
  ["leaves", LEAF_VERTEX, ["place = Leaf(mix(", "flutter(sway.air", "void flutter("]],
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
