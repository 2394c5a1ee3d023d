import { readFile } from "node:fs/promises";
import { expect, test } from "vitest";
import { leafAzimuth } from "../../../client/src/scene/foliage/leaves";
import { organAzimuth, organStance } from "../../../client/src/scene/foliage/organs";
import { LEAF_PLACE } from "../../../client/src/scene/glsl/leaf";
import { perform } from "../gallery/performance";
import type { Picture } from "./picture";
import { theBrowser } from "./shared";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** A leaf: its row, its number of so many, its metamer; then base, direction and normal as the rules have them. */
const leaves = [
  {
    of: [7, 1, 3],
    from: [0.5, 2.25, -1],
    to: [1.25, 2.75, -0.5],
    expected: [1.0, 2.583333, -0.666667, -0.102595, 0.060003, 0.992912, 0.006167, 0.998198, -0.059685],
  },
  // On a vertical metamer X is the reference.
  {
    of: [41, 0, 1],
    from: [0, 1, 0],
    to: [0, 2, 0],
    expected: [0.0, 2.0, 0.0, 0.784699, 0.374711, 0.493801, -0.317142, 0.927142, -0.199573],
  },
  // The last of many leaves stands at the end.
  {
    of: [123456, 14, 15],
    from: [-3, 10, 4],
    to: [-3.5, 9.25, 4.25],
    expected: [-3.5, 9.25, 4.25, -0.852279, -0.31646, -0.416502, -0.284325, 0.948606, -0.138947],
  },
] as const;

const VERTEX = `#version 300 es
precision highp float;
${LEAF_PLACE}
in vec3 from;
in vec3 to;
in vec3 turn;
out vec3 base;
out vec3 direction;
out vec3 normal;
void main() {
  Leaf leaf = leafAt(from, to, turn.x, turn.y, turn.z);
  base = leaf.base;
  direction = leaf.direction;
  normal = leaf.normal;
}`;

/** The stance of what stands by rule. */
const BY_RULE = -1;

/** Organs on many headings, as the server places them. */
const ORGANS = new URL("../../../server/mesh/golden/organs.json", import.meta.url);

interface PlacedOrgan {
  readonly organ: number;
  readonly from: readonly number[];
  readonly to: readonly number[];
  readonly direction: readonly number[];
  readonly normal: readonly number[];
}

/** Expected numbers come from a separate program that follows the rules in double precision. */
test("LF1, LF2, LF4: the graphics card places leaves by the rules", async () => {
  const browser = await theBrowser();
  try {
    const page = await browser.newPage();
    const inputs = leaves.map(({ of: [row, k, count], from, to }) => [
      ...from,
      ...to,
      leafAzimuth(row, k, count),
      (k + 1) / count,
      BY_RULE,
    ]);
    const placed = await page.evaluate(place, { vertex: VERTEX, inputs });
    for (const [i, { expected, of }] of leaves.entries()) {
      for (const [j, value] of expected.entries()) {
        expect(placed[9 * i + j], `number ${j} of row ${of[0]}`).toBeCloseTo(value, 3);
      }
    }
  } finally {
    await browser.close();
  }
});

test("LF5: the graphics card places organs as the server does", async () => {
  const organs: PlacedOrgan[] = JSON.parse(await readFile(ORGANS, "utf8"));
  const browser = await theBrowser();
  try {
    const page = await browser.newPage();
    const inputs = organs.map(({ organ, from, to }) => [...from, ...to, organAzimuth(organ), 1, organStance(organ)]);
    const placed = await page.evaluate(place, { vertex: VERTEX, inputs });
    for (const [i, { to, direction, normal, organ }] of organs.entries()) {
      for (const [j, value] of [...to, ...direction, ...normal].entries()) {
        expect(placed[9 * i + j], `number ${j} of organ ${organ}`).toBeCloseTo(value, 3);
      }
    }
  } finally {
    await browser.close();
  }
});

/** Mean colour of the middle of a picture. */
function crown({ width, height, pixels }: Picture): readonly number[] {
  const [across, up] = [Math.round(0.08 * width), Math.round(0.15 * height)];
  const sum = [0, 0, 0];
  let count = 0;
  for (let y = Math.round(height / 2) - up; y < height / 2 + up; y += 1) {
    for (let x = Math.round(width / 2) - across; x < width / 2 + across; x += 1) {
      for (const channel of [0, 1, 2]) sum[channel]! += pixels[4 * (y * width + x) + channel]!;
      count += 1;
    }
  }
  return sum.map((value) => value / count);
}

/** Keeps how many triangles the last draws had. */
function watchTriangles(): void {
  const { prototype } = WebGL2RenderingContext;
  const draw = prototype.drawElementsInstanced;
  const last: number[] = [];
  Object.assign(window, { triangles: last });
  prototype.drawElementsInstanced = function (mode, count, type, offset, instances) {
    last.push((count / 3) * instances);
    if (last.length > 8) last.shift();
    draw.call(this, mode, count, type, offset, instances);
  };
}

test("far leaves give way to sprigs, and the crown keeps its look", { timeout: 240_000 }, async () => {
  const { tablet, address } = await workshop.fresh({ width: 900, height: 640, detail: 0.5 });
  const { page } = tablet;
  const session = address.slice(address.lastIndexOf("/") + 1);
  const parameters = '{"kind":"set_parameters","parameters":{"leaves_per_node":4}}';
  await perform(page, session, [parameters, '{"kind":"grow","steps":20}']);
  await tablet.until("it has grown", ({ metamers }) => metamers > 8000);
  const { metamers } = await tablet.untilQuiet();
  expect(metamers).toBeGreaterThan(8000);
  // The same view, on glass of few pixels and of many.
  const look = async (detail: number) => {
    const looking = await workshop.open(address, { width: 900, height: 640, detail });
    await looking.page.addInitScript(watchTriangles);
    await looking.page.goto(`${address}?zoom=0.9`);
    await looking.until("all of it is there", ({ rows }) => rows >= metamers);
    await looking.untilQuiet();
    const picture = await looking.photograph(`leaves-${detail}`);
    const triangles = await looking.page.evaluate(() => (window as unknown as { triangles: number[] }).triangles);
    return { colour: crown(picture), most: Math.max(...triangles) };
  };
  const [fine, coarse] = [await look(1), await look(0.2)];
  // Of two triangles each; there are more leaves than metamers, and fewer sprigs.
  expect(fine.most / 2).toBeGreaterThan(1.5 * metamers);
  expect(coarse.most / 2).toBeLessThan(1.1 * metamers);
  for (const channel of [0, 1, 2]) {
    expect(Math.abs(coarse.colour[channel]! - fine.colour[channel]!), `channel ${channel}`).toBeLessThan(10);
  }
});

/** Runs the vertex shader over the inputs and gives what it hands on. */
function place({ vertex, inputs }: { vertex: string; inputs: number[][] }): number[] {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) throw new Error("there is no WebGL 2");
  const program = gl.createProgram();
  const fragment = "#version 300 es\nvoid main() {}";
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex] as const, [gl.FRAGMENT_SHADER, fragment] as const]) {
    const shader = gl.createShader(kind);
    if (!shader) throw new Error("there is no shader");
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.transformFeedbackVaryings(program, ["base", "direction", "normal"], gl.INTERLEAVED_ATTRIBS);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "no program");
  gl.useProgram(program);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(inputs.flat()), gl.STATIC_DRAW);
  for (const [name, size, offset] of [["from", 3, 0] as const, ["to", 3, 12] as const, ["turn", 3, 24] as const]) {
    const at = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, gl.FLOAT, false, 36, offset);
  }
  gl.bindBuffer(gl.ARRAY_BUFFER, null);
  const out = gl.createBuffer();
  gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, out);
  gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 36 * inputs.length, gl.STATIC_READ);
  gl.enable(gl.RASTERIZER_DISCARD);
  gl.beginTransformFeedback(gl.POINTS);
  gl.drawArrays(gl.POINTS, 0, inputs.length);
  gl.endTransformFeedback();
  const placed = new Float32Array(9 * inputs.length);
  gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, placed);
  return [...placed];
}
