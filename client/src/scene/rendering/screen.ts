import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  GLSL3,
  LinearFilter,
  Mesh,
  RawShaderMaterial,
  Scene,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { SCREEN_FRAGMENT, SCREEN_VERTEX } from "../glsl/screen";
import type { Quality } from "./quality";

const SAMPLES = 4;
const LINEAR = { minFilter: LinearFilter, magFilter: LinearFilter, generateMipmaps: false } as const;
/** How long a better picture takes to come over a lesser one, in milliseconds. */
const FADE = 260;

/** The canvas, and the picture that is shown on it: of as many pixels and antialiased, or of fewer and plain where frames must be quick. */
export class Screen {
  private readonly target = new WebGLRenderTarget(1, 1, { ...LINEAR, resolveDepthBuffer: false });
  /** A lesser picture that the present one comes over. */
  private readonly before = new WebGLRenderTarget(1, 1, { ...LINEAR, depthBuffer: false });
  private readonly share = { value: 1 };
  /** Pixels the canvas shows, across and down. */
  private readonly shown = { value: new Vector2(1, 1) };
  /** When it began to, which is infinite until it is there; or null. */
  private fading: number | null = null;
  private readonly material = new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: {
      uPicture: { value: this.target.texture },
      uBefore: { value: this.before.texture },
      uShown: this.shown,
      uShare: this.share,
    },
    vertexShader: SCREEN_VERTEX,
    fragmentShader: SCREEN_FRAGMENT,
    depthTest: false,
    depthWrite: false,
  });
  /** Pixels drawn, across and down. */
  readonly size = new Vector2(1, 1);
  private readonly copy = new Scene();
  private readonly whole: Mesh;
  private scale: number;
  private smooth: boolean;
  /** Whether the last picture is in the target still. */
  private kept = false;

  /** The quality is that of the first picture. */
  constructor(
    private readonly renderer: WebGLRenderer,
    { scale, smooth }: Pick<Quality, "scale" | "smooth">,
  ) {
    this.scale = scale;
    this.smooth = smooth;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.whole = new Mesh(geometry, this.material);
    this.whole.frustumCulled = false;
    this.copy.add(this.whole);
  }

  /** What shows the picture, so that its program can be made in advance. */
  get essential(): readonly Mesh[] {
    return [this.whole];
  }

  /** Samples of each pixel: what is thinner than a pixel covers some of them. */
  get samples(): number {
    return this.smooth ? SAMPLES : 1;
  }

  /** The canvas's size in CSS pixels, and how many of its own make one of those. */
  resize(width: number, height: number, ratio: number): void {
    const { renderer, shown } = this;
    renderer.setDrawingBufferSize(width, height, ratio);
    const { domElement } = renderer;
    shown.value.set(domElement.width, domElement.height);
    this.allot();
  }

  /** Chooses a share of the pixels along each side, antialiased or plain. */
  fit(scale: number, smooth: boolean): void {
    if (scale === this.scale && smooth === this.smooth) return;
    this.scale = scale;
    this.smooth = smooth;
    this.allot();
  }

  /** Keeps the last picture for the next one to come over it by and by; says whether there is one. */
  remember(camera: Camera): boolean {
    if (!this.kept) return false;
    const { renderer, before, size, shown, share, material } = this;
    const canvas = shown.value;
    // What is drawn into must not be read as well.
    material.uniforms.uBefore!.value = this.target.texture;
    shown.value = size;
    share.value = 1;
    before.setSize(size.x, size.y);
    renderer.setRenderTarget(before);
    renderer.render(this.copy, camera);
    renderer.setRenderTarget(null);
    shown.value = canvas;
    material.uniforms.uBefore!.value = before.texture;
    return true;
  }

  /** Shows what was drawn a little more, and says whether that goes on; null if it is shown already. */
  fade(camera: Camera): boolean | null {
    if (this.fading === null) return null;
    // The time it took to draw is no part of the fade.
    this.fading = Math.min(this.fading, performance.now());
    const share = Math.min(1, (performance.now() - this.fading) / FADE);
    this.share.value = share * share * (3 - 2 * share);
    this.renderer.render(this.copy, camera);
    if (share === 1) this.fading = null;
    return share < 1;
  }

  /** Draws the scene; it comes over what was remembered just before, or shows at once. */
  draw(scene: Scene, camera: Camera, over = false): void {
    this.share.value = over ? 0 : 1;
    this.fading = null;
    this.kept = true;
    this.drawInto(scene, camera);
    this.renderer.render(this.copy, camera);
    if (over) this.fading = Number.POSITIVE_INFINITY;
  }

  /** Draws a single pixel of the scene, which nobody sees: for what the graphics card does at a first time only. */
  rehearse(scene: Scene, camera: Camera): void {
    const { scissor } = this.target;
    this.target.scissorTest = true;
    scissor.set(0, 0, 1, 1);
    this.drawInto(scene, camera);
    this.target.scissorTest = false;
    scissor.set(0, 0, this.size.x, this.size.y);
  }

  /** A restored context has lost the pictures that were kept. */
  restored(): void {
    this.kept = false;
    this.fading = null;
  }

  dispose(): void {
    this.target.dispose();
    this.before.dispose();
    this.material.dispose();
    this.whole.geometry.dispose();
  }

  private drawInto(scene: Scene, camera: Camera): void {
    const { renderer, target } = this;
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
  }

  private allot(): void {
    this.kept = false;
    const { size, scale, target } = this;
    const { x, y } = this.shown.value;
    size.set(Math.max(1, Math.floor(scale * x)), Math.max(1, Math.floor(scale * y)));
    const samples = this.smooth ? SAMPLES : 0;
    if (samples !== target.samples) target.dispose();
    target.samples = samples;
    target.setSize(size.x, size.y);
  }
}
