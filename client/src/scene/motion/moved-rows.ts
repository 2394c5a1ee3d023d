import {
  BufferAttribute,
  BufferGeometry,
  Camera,
  DataTexture,
  FloatType,
  GLSL3,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  RGBAFormat,
  RGBAIntegerFormat,
  Scene,
  UnsignedIntType,
  Vector3,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { CHUNK_ROWS } from "../../wire/generated";
import type { Uniforms } from "../materials";
import type { Blend } from "./blend";
import { ROW_NUMBERS } from "./moving";
import { type Hinges, STAND } from "./pose";
import { JOINT_TEXELS, JOINTS_A_LINE, MOST_GUSTS, MOVE_FRAGMENT, MOVE_VERTEX } from "./sway-shaders";
import { LIVE_PERIOD } from "./wind";

const TEXEL = 4;
const LINE = CHUNK_ROWS * ROW_NUMBERS;
/** More lines than these are uploaded sooner with all others at once. */
const MOST_PARTS = 64;
/** Cells of the noise of leaves that go by in a second: a whole number of times around in the period of the wind. */
export const FLUTTER_CELLS = (256 * 10) / 600;

/** What a frame of moving rows is made with. */
export interface Motion {
  /** All winds together that blow. */
  readonly blend: Blend;
  readonly internodeLength: number;
  readonly time: number;
  /** How much of the wind there is, 0 to 1. */
  readonly amount: number;
  /** How much of this frame is shown over the one that was held, 0 to 1. */
  readonly share: number;
  /** How much leaves flutter beside those of others. */
  readonly leaves: number;
}

/** How each row moves, as a texture that the graphics card makes from joints: a fragment a row and frame. */
export class MovedRows {
  private readonly uniforms: Uniforms;
  private readonly material: RawShaderMaterial;
  private readonly scene = new Scene();
  private readonly camera = new Camera();
  private readonly whole: Mesh;
  private targets: [WebGLRenderTarget, WebGLRenderTarget];
  private rides = new Float32Array(0);
  private joints = new Float32Array(0);
  private stale: [first: number, end: number] | null = null;
  /** Whether a target has yet to be made: shaders cannot read one that is not there. */
  private missing = true;

  /** The uniforms are those that all shaders share. */
  constructor(private readonly shared: Uniforms) {
    this.targets = [target(1), target(1)];
    this.uniforms = {
      uNodes: shared.uNodes!,
      uRides: { value: null },
      uJoints: { value: null },
      uBefore: { value: null },
      uShare: { value: 1 },
      uRows: { value: 0 },
      uGusts: { value: 0 },
      uGust: { value: new Float32Array(TEXEL * MOST_GUSTS) },
      uSize: { value: new Float32Array(TEXEL * Math.ceil(MOST_GUSTS / TEXEL)) },
      uAir: { value: new Vector3() },
    };
    shared.uMoved = { value: this.targets[0].texture };
    shared.uLee = { value: new Vector3(1, 0, 0) };
    shared.uFlutter = { value: [1, 0] };
    shared.uWeather = { value: [0, 0] };
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      uniforms: this.uniforms,
      vertexShader: MOVE_VERTEX,
      fragmentShader: MOVE_FRAGMENT,
      depthTest: false,
      depthWrite: false,
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.whole = new Mesh(geometry, this.material);
    this.whole.frustumCulled = false;
    this.scene.add(this.whole);
  }

  /** What makes the texture, so that its program can be made in advance. */
  get essential(): Mesh {
    return this.whole;
  }

  /** Rows ride like this from now on; `from` is the first that does not ride as before. */
  ride(rows: Float32Array, count: number, from = 0): void {
    const lines = Math.max(1, Math.ceil(count / CHUNK_ROWS));
    const capacity = 2 ** Math.ceil(Math.log2(lines));
    this.uniforms.uRows!.value = count;
    if (this.rides.length !== capacity * LINE) {
      this.rides = new Float32Array(capacity * LINE);
      replace(this.uniforms.uRides!, texture(this.rides, CHUNK_ROWS * (ROW_NUMBERS / TEXEL), capacity));
      for (const each of this.targets) each.setSize(CHUNK_ROWS, capacity);
      this.missing = true;
      from = 0;
    }
    this.rides.set(rows.subarray(ROW_NUMBERS * from, ROW_NUMBERS * count), ROW_NUMBERS * from);
    const [first, end] = [Math.floor(from / CHUNK_ROWS), lines];
    this.stale = this.stale ? [Math.min(this.stale[0], first), Math.max(this.stale[1], end)] : [first, end];
  }

  /** What is shown now is held, for what comes to be shown over it by and by. */
  remember(): void {
    this.targets.reverse();
  }

  /** Joints stand like this, each with its share of the wind. */
  stand({ count }: Hinges, stands: Float64Array, exposure: Float64Array): void {
    const lines = 2 ** Math.ceil(Math.log2(Math.max(1, Math.ceil(count / JOINTS_A_LINE))));
    const size = TEXEL * JOINT_TEXELS;
    if (this.joints.length !== lines * JOINTS_A_LINE * size) {
      this.joints = new Float32Array(lines * JOINTS_A_LINE * size);
      replace(this.uniforms.uJoints!, texture(this.joints, JOINTS_A_LINE * JOINT_TEXELS, lines));
    }
    const { joints } = this;
    for (let joint = 0; joint < count; joint += 1) {
      const [to, from] = [size * joint, STAND * joint];
      for (let a = 0; a < 3; a += 1) joints[to + a] = stands[from + a]!;
      joints[to + 3] = exposure[joint]!;
      for (let a = 0; a < 4; a += 1) joints[to + 4 + a] = stands[from + 3 + a]!;
      for (let a = 0; a < 3; a += 1) joints[to + 8 + a] = stands[from + 7 + a]!;
    }
    (this.uniforms.uJoints!.value as DataTexture).needsUpdate = true;
  }

  /** Makes the texture. */
  draw(renderer: WebGLRenderer, motion: Motion): void {
    const { uniforms, shared } = this;
    const [now, before] = this.targets;
    this.blow(motion);
    uniforms.uShare!.value = motion.share;
    uniforms.uBefore!.value = before.texture;
    this.uploadRides();
    const target = renderer.getRenderTarget();
    if (this.missing) for (const each of this.targets) renderer.setRenderTarget(each);
    this.missing = false;
    renderer.setRenderTarget(now);
    renderer.render(this.scene, this.camera);
    renderer.setRenderTarget(target);
    shared.uMoved!.value = now.texture;
  }

  /** A restored context has lost every texture. */
  restored(): void {
    this.missing = true;
    for (const { value } of [this.uniforms.uRides!, this.uniforms.uJoints!]) if (value) value.needsUpdate = true;
  }

  dispose(): void {
    for (const part of [...this.targets, this.material, this.whole.geometry]) part.dispose();
    for (const { value } of [this.uniforms.uRides!, this.uniforms.uJoints!]) value?.dispose();
  }

  private uploadRides(): void {
    if (!this.stale) return;
    const rides = this.uniforms.uRides!.value as DataTexture;
    const [first, end] = this.stale;
    // Of a new texture all has to be uploaded, or the rest would be empty; a part that is uploaded lies in one line.
    rides.clearUpdateRanges();
    if (rides.version > 1 && end - first <= MOST_PARTS) {
      for (let line = first; line < end; line += 1) rides.addUpdateRange(line * LINE, LINE);
    }
    rides.needsUpdate = true;
    this.stale = null;
  }

  /** The gusts that pass over the tree, as they are now. */
  private blow({ blend, internodeLength, time, amount, leaves }: Motion): void {
    const { uniforms, shared } = this;
    const [waves, sizes] = [uniforms.uGust!.value as Float32Array, uniforms.uSize!.value as Float32Array];
    const gusts = blend.gusts.slice(0, MOST_GUSTS);
    for (const [at, { wave, angle, size }] of gusts.entries()) {
      for (let a = 0; a < 3; a += 1) waves[TEXEL * at + a] = wave[a]! * internodeLength;
      waves[TEXEL * at + 3] = angle;
      sizes[at] = size;
    }
    uniforms.uGusts!.value = gusts.length;
    const gone = time - LIVE_PERIOD * Math.floor(time / LIVE_PERIOD);
    (uniforms.uAir!.value as Vector3).set(blend.speed, gone, amount);
    (shared.uLee!.value as Vector3).set(blend.lee[0], 0, blend.lee[2]);
    shared.uWeather!.value = [amount * blend.snow, amount * blend.rain];
    shared.uFlutter!.value = [blend.flutter * leaves, (gone * FLUTTER_CELLS) % 256];
  }
}

function target(lines: number): WebGLRenderTarget {
  return new WebGLRenderTarget(CHUNK_ROWS, lines, {
    format: RGBAIntegerFormat,
    type: UnsignedIntType,
    internalFormat: "RGBA32UI",
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    generateMipmaps: false,
    depthBuffer: false,
  });
}

function texture(numbers: Float32Array<ArrayBuffer>, width: number, height: number): DataTexture {
  const made = new DataTexture(numbers, width, height, RGBAFormat, FloatType);
  made.minFilter = NearestFilter;
  made.magFilter = NearestFilter;
  made.generateMipmaps = false;
  made.needsUpdate = true;
  return made;
}

function replace(uniform: { value: DataTexture | null }, value: DataTexture): void {
  uniform.value?.dispose();
  uniform.value = value;
}
