import { expect, it } from "vitest";
import { shaderFunctions } from "../../../test/shader-functions";
import { FLUTTERS } from "../../../test/swaying-trees";
import { FLAT_NOISE_SIDE, lattice } from "../noise-texture";
import type { Vec3 } from "../vector";
import { CALM } from "./air-settings";
import { blendOf } from "./blend";
import { FLUTTER_CELLS } from "./moved-rows";
import { FLUTTER, MOVE_FRAGMENT } from "./sway-shaders";
import { windOf } from "./wind";

/** The shader of leaves, with the lattice as a list: a texture is read between two of its texels as here. */
const SOURCE = FLUTTER.replace(
  "uniform sampler2D uFlatNoise;",
  `uniform float uLattice[${FLAT_NOISE_SIDE ** 2}];
float sampled(vec2 at) {
  float cell = floor(at.x - 0.5);
  int line = int(at.y - 0.5) * ${FLAT_NOISE_SIDE};
  int here = line + int(mod(cell + 2560.0, ${FLAT_NOISE_SIDE}.0));
  int next = line + int(mod(cell + 2561.0, ${FLAT_NOISE_SIDE}.0));
  return mix(uLattice[here], uLattice[next], at.x - 0.5 - cell);
}`,
)
  .replace(`textureLod(uFlatNoise, at / ${FLAT_NOISE_SIDE}.0, 0.0).r`, "sampled(at)")
  .replace(/#ifdef SPRIG[^#]*#endif/, "")
  .replace(/void flutter\([\s\S]*/, "");
const LATTICE = Array.from(lattice(FLAT_NOISE_SIDE ** 2, 2), (value) => value / 255);

interface Leaves {
  flutterNoise(along: number, seed: number): number;
  fluttered(air: number, base: Vec3, more: number[], d: Vec3, side: Vec3): number[];
}
const leaves = (uniforms: { uLee: Vec3; uFlutter: number[]; uWeather: number[] }) =>
  shaderFunctions<Leaves>(SOURCE, ["flutterNoise", "fluttered"], { ...uniforms, uLattice: LATTICE });

it("leaves find the noise that exports find", () => {
  const { flutterNoise } = leaves({ uLee: [1, 0, 0], uFlutter: [1, 0], uWeather: [0, 0] });
  for (const [along, seed, value] of FLUTTERS.noise) expect(flutterNoise(along, seed)).toBeCloseTo(value, 4);
});

it("leaves flutter, stream and hang as in exports", () => {
  expect(FLUTTERS.leaves.length).toBeGreaterThan(10);
  for (const sample of FLUTTERS.leaves) {
    const { base, direction, side, own, lee, much, snow, wet, air, time, turn } = sample;
    const settings = { ...CALM, snow };
    const calm = () => windOf({ velocity: [0, 0, 0], turbulence: 0, seed: 0 }, 600);
    const covered = blendOf([{ settings, share: 1 }], calm, 0).snow;
    const cells = ((time % 600) * FLUTTER_CELLS) % FLAT_NOISE_SIDE;
    const { fluttered } = leaves({ uLee: lee, uFlutter: [much, cells], uWeather: [covered, wet] });
    const found = fluttered(air, base, [...own, 0], direction, side);
    for (const [i, wanted] of turn.entries()) expect(found[i]).toBeCloseTo(wanted, 4);
  }
});

it("twigs quiver as in exports", () => {
  const source = `uniform vec3 uAir;\n${/float quiver\([\s\S]*?\n\}/.exec(MOVE_FRAGMENT)![0]}`;
  interface Twigs {
    quiver(number: number, least: number): number;
  }
  for (const [number, least, time, value] of FLUTTERS.quivers) {
    const { quiver } = shaderFunctions<Twigs>(source, ["quiver"], { uAir: [0, time % 600, 1] });
    expect(quiver(number, least)).toBeCloseTo(value, 4);
  }
});
