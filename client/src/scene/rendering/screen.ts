import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  GLSL3,
  LinearFilter,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  Scene,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { Quality } from "./quality";

const SAMPLES = 4;

const VERTEX = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }
`;
const FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D uPicture;
uniform sampler2D uBefore;
uniform float uShare;
out vec4 colour;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 picture = texelFetch(uPicture, at, 0).rgb;
  if (uShare < 1.0) picture = mix(texture(uBefore, gl_FragCoord.xy / vec2(textureSize(uPicture, 0))).rgb, picture, uShare);
  colour = vec4(picture, 1.0);
}
`;
/** How long a better picture takes to come over a lesser one, in milliseconds. */
const FADE = 260;

/** The canvas's pixels: as many as it shows and antialiased, or fewer and plain where frames must be quick. */
export class Screen {
  private readonly target = new WebGLRenderTarget(1, 1, {
    samples: SAMPLES,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    generateMipmaps: false,
  });
  /** A lesser picture that the present one comes over. */
  private readonly before = new WebGLRenderTarget(1, 1, {
    minFilter: LinearFilter,
    magFilter: LinearFilter,
    generateMipmaps: false,
  });
  private readonly share = { value: 1 };
  /** When it began to, or null. */
  private fading: number | null = null;
  private readonly material = new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: {
      uPicture: { value: this.target.texture },
      uBefore: { value: this.before.texture },
      uShare: this.share,
    },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    depthTest: false,
    depthWrite: false,
  });
  /** Pixels drawn, across and down. */
  readonly size = new Vector2(1, 1);
  private readonly copy = new Scene();
  private readonly whole: Mesh;
  private width = 1;
  private height = 1;
  private ratio = 1;
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

  /** The canvas's size in CSS pixels, and how many of its own make one of those. */
  resize(width: number, height: number, ratio: number): void {
    this.width = width;
    this.height = height;
    this.ratio = ratio;
    this.allot();
  }

  /** Chooses a share of the pixels along each side, antialiased or plain. */
  fit(scale: number, smooth: boolean): void {
    if (scale === this.scale && smooth === this.smooth) return;
    this.scale = scale;
    this.smooth = smooth;
    this.allot();
  }

  /** Whether a picture drawn like this would be a better one than the last. */
  improves(scale: number, smooth: boolean): boolean {
    return scale > this.scale || (smooth && !this.smooth);
  }

  /** Keeps the last picture, or draws it once more as coarsely, for the next one to come over it by and by. */
  remember(scene: Scene, camera: Camera): void {
    const { renderer, before, size, material } = this;
    before.setSize(size.x, size.y);
    renderer.setRenderTarget(before);
    renderer.clear();
    if (this.kept) {
      // What is drawn into must not be read as well.
      material.uniforms.uBefore!.value = this.target.texture;
      this.share.value = 1;
      renderer.render(this.copy, camera);
      material.uniforms.uBefore!.value = before.texture;
    } else {
      renderer.render(scene, camera);
    }
    renderer.setRenderTarget(null);
  }

  /** Shows what was drawn a little more, and says whether that goes on; null if it is shown already. */
  fade(camera: Camera): boolean | null {
    if (this.fading === null) return null;
    const share = Math.min(1, (performance.now() - this.fading) / FADE);
    this.share.value = share * share * (3 - 2 * share);
    this.renderer.render(this.copy, camera);
    if (share === 1) this.fading = null;
    return share < 1;
  }

  /** Draws the scene; it comes over what was remembered just before, or shows at once. */
  draw(scene: Scene, camera: Camera, over = false): void {
    const { renderer, target } = this;
    this.share.value = over ? 0 : 1;
    this.fading = null;
    this.kept = this.smooth;
    if (!this.smooth) {
      renderer.clear();
      renderer.render(scene, camera);
      return;
    }
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.copy, camera);
    // The time it took to draw is no part of the fade.
    if (over) this.fading = performance.now();
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

  private allot(): void {
    this.kept = false;
    const { renderer, width, height } = this;
    renderer.setDrawingBufferSize(width, height, this.ratio * this.scale);
    const { domElement } = renderer;
    this.size.set(domElement.width, domElement.height);
    if (this.smooth) this.target.setSize(domElement.width, domElement.height);
  }
}
