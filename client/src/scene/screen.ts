import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  GLSL3,
  Mesh,
  NearestFilter,
  RawShaderMaterial,
  Scene,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";

const SAMPLES = 4;

const VERTEX = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }
`;
const FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D uPicture;
out vec4 colour;
void main() { colour = vec4(texelFetch(uPicture, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }
`;

/** The canvas's pixels: as many as it shows and antialiased, or fewer and plain where frames must be quick. */
export class Screen {
  private readonly target = new WebGLRenderTarget(1, 1, {
    samples: SAMPLES,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    generateMipmaps: false,
  });
  private readonly material = new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: { uPicture: { value: this.target.texture } },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    depthTest: false,
    depthWrite: false,
  });
  private readonly copy = new Scene();
  private readonly whole: Mesh;
  private width = 1;
  private height = 1;
  private ratio = 1;
  private scale = 1;
  private smooth = true;

  constructor(private readonly renderer: WebGLRenderer) {
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
    this.fit();
  }

  /** Draws with a share of the pixels along each side, antialiased or plain. */
  draw(scene: Scene, camera: Camera, scale: number, smooth: boolean): void {
    const { renderer, target } = this;
    if (scale !== this.scale || smooth !== this.smooth) {
      this.scale = scale;
      this.smooth = smooth;
      this.fit();
    }
    if (!smooth) {
      renderer.clear();
      renderer.render(scene, camera);
      return;
    }
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.copy, camera);
  }

  dispose(): void {
    this.target.dispose();
    this.material.dispose();
    this.whole.geometry.dispose();
  }

  private fit(): void {
    const { renderer, width, height } = this;
    renderer.setDrawingBufferSize(width, height, this.ratio * this.scale);
    const { domElement } = renderer;
    if (this.smooth) this.target.setSize(domElement.width, domElement.height);
  }
}
