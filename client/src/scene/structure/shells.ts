import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  GLSL3,
  Group,
  Mesh,
  RawShaderMaterial,
  Raycaster,
  Vector3,
  Vector4,
} from "three";
import type { Ray, Vec3 } from "../vector";
import type { Envelope } from "./envelope-surface";
import { shellGeometry } from "./shell-geometry";

/** How much a shell stands out: the one that is edited, those beside it, and what encloses them. */
export type Emphasis = "chosen" | "beside" | "around";

/** A silhouette in the scene. */
export interface Shell {
  readonly path: string;
  readonly envelope: Envelope;
  readonly base: Vec3;
  /** Its rotation (x, y, z, w). */
  readonly turn: readonly [number, number, number, number];
  /** Internodes to a unit of its envelope. */
  readonly scale: number;
  readonly emphasis: Emphasis;
}

/** What draws shells needs of the picture. */
export interface ShellStage {
  readonly scene: { add(object: Group): unknown; remove(object: Group): unknown };
  /** Draws again. */
  readonly stir: () => void;
}

/** Colour and strength of each, the strength being that of the rim. */
const LOOKS: Readonly<Record<Emphasis, readonly [number, number, number, number]>> = {
  chosen: [0.47, 0.2, 0.74, 0.78],
  beside: [0.97, 0.98, 0.93, 0.34],
  around: [0.82, 0.88, 0.84, 0.22],
};
/** How strong the faces are that are looked at straight on, as a share of the rim. */
const FACES: Readonly<Record<Emphasis, number>> = { chosen: 0.13, beside: 0.08, around: 0.02 };

const VERTEX = /* glsl */ `precision highp float;
uniform mat4 modelMatrix;
uniform mat4 viewMatrix;
uniform mat4 projectionMatrix;
uniform vec3 cameraPosition;
in vec3 position;
in vec3 normal;
out vec3 vNormal;
out vec3 vEye;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vNormal = mat3(modelMatrix) * normal;
  vEye = cameraPosition - world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}
`;

const FRAGMENT = /* glsl */ `precision highp float;
uniform vec4 uLook;
uniform float uFace;
in vec3 vNormal;
in vec3 vEye;
out vec4 colour;
void main() {
  float facing = abs(dot(normalize(vNormal), normalize(vEye)));
  float rim = pow(1.0 - facing, 2.5);
  colour = vec4(uLook.rgb, uLook.a * mix(uFace, 1.0, rim));
}
`;

/** The silhouettes of branching systems as translucent shells around the wood. */
export class Shells {
  readonly #stage: ShellStage;
  readonly #group = new Group();
  readonly #materials: Readonly<Record<Emphasis, RawShaderMaterial>>;
  /** Surfaces by their envelopes: most branches have the one of another. */
  readonly #surfaces = new Map<string, BufferGeometry>();
  #shown: readonly Mesh[] = [];

  constructor(stage: ShellStage) {
    this.#stage = stage;
    this.#materials = { chosen: material("chosen"), beside: material("beside"), around: material("around") };
    stage.scene.add(this.#group);
  }

  /** Shows these and no others. */
  show(shells: readonly Shell[]): void {
    const used = new Set<string>();
    for (const mesh of this.#shown) {
      this.#group.remove(mesh);
    }
    this.#shown = shells.map((shell) => {
      const key = JSON.stringify(shell.envelope);
      used.add(key);
      const surface = this.#surfaces.get(key) ?? surfaceOf(shell.envelope);
      this.#surfaces.set(key, surface);
      const mesh = new Mesh(surface, this.#materials[shell.emphasis]);
      mesh.name = shell.path;
      mesh.frustumCulled = false;
      // After all that is solid, the one that is edited last.
      mesh.renderOrder = shell.emphasis === "chosen" ? 5 : 4;
      mesh.position.set(...shell.base);
      mesh.quaternion.set(...shell.turn);
      mesh.scale.set(shell.scale, shell.scale, shell.scale);
      mesh.updateMatrixWorld();
      this.#group.add(mesh);
      return mesh;
    });
    for (const [key, surface] of this.#surfaces) {
      if (!used.has(key)) {
        surface.dispose();
        this.#surfaces.delete(key);
      }
    }
    this.#stage.stir();
  }

  /** The branches whose shells a ray goes through, the nearest first, each once. */
  hits({ origin, direction }: Ray): readonly string[] {
    const caster = new Raycaster(new Vector3(...origin), new Vector3(...direction));
    const names = caster.intersectObjects([...this.#shown], false).map(({ object }) => object.name);
    return [...new Set(names)];
  }

  dispose(): void {
    this.show([]);
    this.#stage.scene.remove(this.#group);
    for (const one of Object.values(this.#materials)) {
      one.dispose();
    }
    this.#stage.stir();
  }
}

function surfaceOf(envelope: Envelope): BufferGeometry {
  const { positions, triangles } = shellGeometry(envelope);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  geometry.computeVertexNormals();
  return geometry;
}

function material(emphasis: Emphasis): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    uniforms: { uLook: { value: new Vector4(...LOOKS[emphasis]) }, uFace: { value: FACES[emphasis] } },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
  });
}
