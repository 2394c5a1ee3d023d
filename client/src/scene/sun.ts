import {
  DepthTexture,
  FloatType,
  LessEqualCompare,
  LinearFilter,
  Matrix4,
  NearestFilter,
  OrthographicCamera,
  Scene,
  Vector3,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { Box } from "./camera-rig";
import type { Uniforms } from "./materials";

const MAP_SIZE = 2048;
/** Leaves stand this far out of the box around the nodes. */
const MARGIN = 2;

/** The sun and the shadow map seen from it. */
export class Sun {
  /** What casts a shadow. */
  readonly casters = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly target: WebGLRenderTarget;
  private readonly direction = new Vector3(-0.52, 0.76, 0.44).normalize();

  constructor(uniforms: Uniforms) {
    const depth = new DepthTexture(MAP_SIZE, MAP_SIZE, FloatType);
    depth.compareFunction = LessEqualCompare;
    depth.minFilter = LinearFilter;
    depth.magFilter = LinearFilter;
    this.target = new WebGLRenderTarget(MAP_SIZE, MAP_SIZE, {
      depthTexture: depth,
      minFilter: NearestFilter,
      magFilter: NearestFilter,
      generateMipmaps: false,
    });
    uniforms.uSun = { value: this.direction };
    uniforms.uSunFromWorld = { value: new Matrix4() };
    uniforms.uShadow = { value: depth };
    uniforms.uShadowTaps = { value: 3 };
    uniforms.uShadowTexel = { value: 1 / MAP_SIZE };
  }

  /** Draws the shadow map for what stands in `box`. */
  render(renderer: WebGLRenderer, uniforms: Uniforms, box: Box): void {
    const { camera } = this;
    const centre = new Vector3(
      (box.min[0] + box.max[0]) / 2,
      (box.min[1] + box.max[1]) / 2,
      (box.min[2] + box.max[2]) / 2,
    );
    const half = new Vector3(box.max[0], box.max[1], box.max[2]).sub(centre).length() + MARGIN;
    camera.position.copy(centre).addScaledVector(this.direction, 2 * half);
    camera.lookAt(centre);
    camera.left = -half;
    camera.right = half;
    camera.top = half;
    camera.bottom = -half;
    camera.near = 0.5 * half;
    camera.far = 3.5 * half;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    uniforms.uSunFromWorld!.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.casters, camera);
    renderer.setRenderTarget(null);
  }

  dispose(): void {
    this.target.depthTexture?.dispose();
    this.target.dispose();
  }
}
