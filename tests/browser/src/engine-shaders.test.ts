import { readFile } from "node:fs/promises";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { theBrowser } from "./shared";

const SHADERS = join(import.meta.dirname, "../../../docs/shaders");

/** What the shaders of engines are asked: one vertex in its wind. */
const WIND = { time: 2.7, blow: [0.03, 0, -0.02], trunk: 6.5, limb: 1.7, trunkHertz: 0.6, limbHertz: 1.4 } as const;
/** Its place, its normal, and its weights for trunk and limb with its phase and its flutter. */
const VERTICES = [
  { at: [0, 0, 0], normal: [1, 0, 0], weights: [0, 0, 0, 0] },
  { at: [0.3, 5.1, -0.4], normal: [0, 1, 0], weights: [0.8, 0, 0.2, 0] },
  { at: [1.2, 7.4, 0.9], normal: [0, 0.6, 0.8], weights: [1, 0.7, 0.35, 0] },
  { at: [-2.2, 6.1, 1.1], normal: [0.6, 0, -0.8], weights: [0.9, 1, 0.85, 1] },
] as const;

/** The shader of Godot in the language it is close to: what the engine brings is declared, what only it reads left out. */
function ofGodot(text: string): string {
  const declared = text
    .replace(/^(shader_type|render_mode) .*$/gm, "")
    .replace(/^(uniform \w+ \w+)[^;]*;/gm, "$1;")
    .replace("void vertex()", "void vertexOfGodot()")
    .replace(/void fragment\(\)[\s\S]*/, "");
  return `#define TAU 6.2831853
uniform float TIME;
uniform mat4 MODEL_MATRIX;
vec3 VERTEX, NORMAL;
vec4 CUSTOM0;
${declared}
void main() {
  VERTEX = at;
  NORMAL = normal;
  CUSTOM0 = weights;
  vertexOfGodot();
  moved = VERTEX;
}`;
}

/** The function of Unity in the same language; glTFast has turned over the second number of each set of places. */
function ofUnity(text: string): string {
  return `#define float2 vec2
#define float3 vec3
uniform float TIME, trunk_metres, limb_metres, trunk_hertz, limb_hertz;
uniform vec3 blow;
${text}
void main() {
  vec2 uv2 = vec2(weights.x, 1.0 - weights.y), uv3 = vec2(weights.z, 1.0 - weights.w);
  EspalierWind_float(at, normal, uv2, uv3, TIME, blow, trunk_metres, limb_metres, trunk_hertz, limb_hertz, moved);
}`;
}

/** Where the formula of docs/formats.md takes a vertex. */
function wanted({ at, normal, weights }: (typeof VERTICES)[number]): number[] {
  const [trunk, limb, phase, flutter] = weights;
  const wave = (turns: number, more = 0) => Math.sin(2 * Math.PI * turns + more);
  const trunkTurn = 1 + 0.4 * wave(WIND.trunkHertz * WIND.time);
  const limbTurn = 1 + 0.8 * wave(WIND.limbHertz * WIND.time + phase);
  const far = trunk * WIND.trunk * trunkTurn + limb * WIND.limb * limbTurn;
  const shaken = flutter * 0.02 * wave(4 * WIND.time + 7 * phase, at[0]);
  return at.map((each, axis) => each + far * WIND.blow[axis]! + shaken * normal[axis]!);
}

let page: Page;
beforeAll(async () => {
  page = await (await theBrowser()).newPage();
});
afterAll(() => page.close());

/** Has the graphics of the browser compile a shader, and run it over all vertices. */
function run(body: string): Promise<{ readonly log: string; readonly moved: number[] }> {
  return page.evaluate(
    ({ body, vertices, wind }) => {
      const gl = document.createElement("canvas").getContext("webgl2")!;
      const program = gl.createProgram();
      const log: string[] = [];
      const head = "#version 300 es\nprecision highp float;\n";
      const inputs = "in vec3 at, normal;\nin vec4 weights;\nout vec3 moved;\n";
      for (const [kind, text] of [
        [gl.VERTEX_SHADER, head + inputs + body],
        [gl.FRAGMENT_SHADER, `${head}out vec4 seen;\nvoid main() { seen = vec4(1); }`],
      ] as const) {
        const shader = gl.createShader(kind)!;
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        log.push(gl.getShaderInfoLog(shader) ?? "");
        gl.attachShader(program, shader);
      }
      gl.transformFeedbackVaryings(program, ["moved"], gl.INTERLEAVED_ATTRIBS);
      gl.linkProgram(program);
      log.push(gl.getProgramInfoLog(program) ?? "");
      if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return { log: log.join(""), moved: [] };
      gl.useProgram(program);
      const place = (name: string) => gl.getUniformLocation(program, name);
      gl.uniform1f(place("TIME"), wind.time);
      gl.uniformMatrix4fv(place("MODEL_MATRIX"), false, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, -2, 1]);
      gl.uniform3fv(place("blow"), wind.blow);
      gl.uniform1f(place("trunk_metres"), wind.trunk);
      gl.uniform1f(place("limb_metres"), wind.limb);
      gl.uniform1f(place("trunk_hertz"), wind.trunkHertz);
      gl.uniform1f(place("limb_hertz"), wind.limbHertz);
      for (const name of ["at", "normal", "weights"] as const) {
        const at = gl.getAttribLocation(program, name);
        if (at < 0) continue;
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(vertices.flatMap((each) => [...each[name]])), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, vertices[0]![name].length, gl.FLOAT, false, 0, 0);
      }
      const moved = new Float32Array(3 * vertices.length);
      gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, gl.createBuffer());
      gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, moved.byteLength, gl.STATIC_READ);
      gl.enable(gl.RASTERIZER_DISCARD);
      gl.beginTransformFeedback(gl.POINTS);
      gl.drawArrays(gl.POINTS, 0, vertices.length);
      gl.endTransformFeedback();
      gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, moved);
      return { log: log.join(""), moved: [...moved] };
    },
    { body, vertices: VERTICES, wind: WIND },
  );
}

test.each([
  ["Godot", "wind.gdshader", ofGodot],
  ["Unity", "wind.hlsl", ofUnity],
] as const)("the shader for %s compiles, and moves vertices as the formula has it", async (_, file, translated) => {
  const { log, moved } = await run(translated(await readFile(join(SHADERS, file), "utf8")));
  expect(log).toBe("");
  const expected = VERTICES.flatMap(wanted);
  expect(moved.length).toBe(expected.length);
  for (const [i, each] of moved.entries()) expect(Math.abs(each - expected[i]!), `${file} ${i}`).toBeLessThan(1e-4);
});
