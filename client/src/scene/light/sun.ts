import {
  BufferAttribute,
  BufferGeometry,
  DepthTexture,
  FloatType,
  GLSL3,
  LessEqualCompare,
  LinearFilter,
  LinearMipmapLinearFilter,
  Matrix4,
  Mesh,
  NearestFilter,
  OrthographicCamera,
  RawShaderMaterial,
  Scene,
  Vector2,
  Vector3,
  Vector4,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { Box } from "../camera/camera-view";
import { SHADE_FRAGMENT, SHADE_VERTEX } from "../glsl/shadow";
import type { Uniforms } from "../materials";

/** Texels along each side of the shadow map, at least and at most. */
const MAP_SIZES = [512, 2048] as const;
/** Half as fine: shadows on the ground are soft. */
const SHADE_SHARE = 0.5;
/** Leaves stand this far out of the box around the nodes. */
const MARGIN = 2;
const UP = new Vector3(0, 1, 0);
const NORTH = new Vector3(0, 0, -1);

/** The shadow map, seen from the sun, and what of it lies on the ground, softened. */
export class Sun {
  /** What casts a shadow. */
  readonly casters = new Scene();
  /** What casts one stands at most so far out of its box, in internodes. */
  margin = MARGIN;
  private readonly camera = new OrthographicCamera();
  private readonly target: WebGLRenderTarget;
  private readonly shade: WebGLRenderTarget;
  private readonly shading: RawShaderMaterial;
  private readonly whole: Mesh;
  private readonly sheet = new Scene();
  private readonly groundDepth = new Vector4();
  private readonly scale = new Vector2(1, 1);
  private readonly far = { value: 1 };
  /** Texels along each side at rest, and now. */
  private finest: number = MAP_SIZES[1];
  private size: number = MAP_SIZES[1];

  constructor(private readonly uniforms: Uniforms) {
    const depth = new DepthTexture(this.size, this.size, FloatType);
    depth.compareFunction = LessEqualCompare;
    depth.minFilter = LinearFilter;
    depth.magFilter = LinearFilter;
    this.target = new WebGLRenderTarget(this.size, this.size, {
      depthTexture: depth,
      minFilter: NearestFilter,
      magFilter: NearestFilter,
      generateMipmaps: false,
    });
    this.shade = new WebGLRenderTarget(this.size * SHADE_SHARE, this.size * SHADE_SHARE, {
      depthBuffer: false,
      minFilter: LinearMipmapLinearFilter,
      magFilter: LinearFilter,
      generateMipmaps: true,
    });
    uniforms.uSunFromWorld = { value: new Matrix4() };
    uniforms.uShadow = { value: depth };
    uniforms.uShadowBias = { value: 0 };
    uniforms.uShadowTaps = { value: 3 };
    uniforms.uShadowSize = { value: 0 };
    uniforms.uShadowTexel = { value: 1 / this.size };
    uniforms.uShade = { value: this.shade.texture };
    uniforms.uShadeScale = { value: this.scale };
    this.shading = new RawShaderMaterial({
      glslVersion: GLSL3,
      uniforms: {
        uDepths: { value: this.target.texture },
        uGroundDepth: { value: this.groundDepth },
        uShadeFar: this.far,
      },
      vertexShader: SHADE_VERTEX,
      fragmentShader: SHADE_FRAGMENT,
      depthTest: false,
      depthWrite: false,
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.whole = new Mesh(geometry, this.shading);
    this.whole.frustumCulled = false;
    this.sheet.add(this.whole);
  }

  /** The mesh that softens shadows, so that its program can be made in advance. */
  get essential(): readonly Mesh[] {
    return [this.whole];
  }

  /** From now on the map is as fine as a picture of so many pixels along its longer side can show; says whether that is new. */
  fit(pixels: number): boolean {
    const finest = Math.min(Math.max(2 ** Math.ceil(Math.log2(pixels)), MAP_SIZES[0]), MAP_SIZES[1]);
    const isNew = finest !== this.finest;
    this.finest = finest;
    return isNew;
  }

  /** Draws the shadows of what stands in `box`, lit from a direction, with a share of the texels along each side. */
  render(renderer: WebGLRenderer, box: Box, towards: Vector3, share: number): void {
    this.resize(Math.max(this.finest * share, MAP_SIZES[0]));
    this.aim(box, towards);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.casters, this.camera);
    renderer.setRenderTarget(this.shade);
    renderer.render(this.sheet, this.camera);
    renderer.setRenderTarget(null);
  }

  dispose(): void {
    this.target.depthTexture?.dispose();
    this.target.dispose();
    this.shade.dispose();
    this.shading.dispose();
    this.whole.geometry.dispose();
  }

  private resize(size: number): void {
    if (size === this.size) return;
    this.size = size;
    this.target.setSize(size, size);
    this.shade.setSize(size * SHADE_SHARE, size * SHADE_SHARE);
    this.uniforms.uShadowTexel!.value = 1 / size;
  }

  /** Fits the map to the box as closely as it can be seen from the sun. */
  private aim({ min, max }: Box, towards: Vector3): void {
    const { camera } = this;
    const centre = new Vector3(min[0] + max[0], min[1] + max[1], min[2] + max[2]).multiplyScalar(0.5);
    camera.up.copy(Math.abs(towards.y) > 0.99 ? NORTH : UP);
    camera.position.copy(centre).add(towards);
    camera.lookAt(centre);
    camera.updateMatrixWorld();
    const half = new Vector3();
    for (let i = 0; i < 8; i += 1) {
      const corner = new Vector3((i & 1 ? max : min)[0], (i & 2 ? max : min)[1], (i & 4 ? max : min)[2]);
      half.max(corner.applyMatrix4(camera.matrixWorldInverse));
    }
    // Square texels: a shadow's edge is as soft across as it is along.
    const reach = Math.max(half.x, half.y) + this.margin;
    // From one step towards the sun, where the corners were measured, the nearest is this far before the middle.
    const depth = half.z + 1 + this.margin;
    camera.position.copy(centre).addScaledVector(towards, 2 * depth);
    camera.left = -reach;
    camera.right = reach;
    camera.top = reach;
    camera.bottom = -reach;
    camera.near = 0.9 * depth;
    camera.far = 3.1 * depth;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const clip: Matrix4 = this.uniforms.uSunFromWorld!.value;
    clip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.uniforms.uShadowSize!.value = (2 * reach) / this.size;
    this.uniforms.uShadowBias!.value = 0.035 / (camera.far - camera.near);
    this.measureGround(clip, reach);
  }

  /** The ground's depth changes evenly over the map, which may look at it from however low. */
  private measureGround(clip: Matrix4, reach: number): void {
    const { camera, far, groundDepth, scale } = this;
    const e = clip.clone().invert().elements;
    const across = -e[1]! / e[9]!;
    const upwards = -e[5]! / e[9]!;
    const middle = -e[13]! / e[9]!;
    groundDepth.set(across, upwards, 0.5 * (middle - across - upwards) + 0.5, camera.far - camera.near);
    far.value = camera.far - camera.near;
    scale.set((this.size * SHADE_SHARE) / (2 * reach), far.value);
  }
}
