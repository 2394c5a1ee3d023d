import { FrontSide, GLSL3, Group, Quaternion, RawShaderMaterial, Vector3, Vector4 } from "three";
import type { Box } from "../camera/camera-view";
import { LeafRows } from "../foliage/leaf-rows";
import { BRANCH_VERTEX, branchFragment } from "../glsl/branch";
import { LEAF_DEPTH_FRAGMENT, leafFragment, leafVertex } from "../glsl/leaf";
import { DEPTH_FRAGMENT } from "../glsl/shadow";
import type { Uniforms } from "../materials";
import { NodeTexture } from "../table/node-texture";
import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import { Branches } from "../wood/branches";

/** Where a ghost stands: what lies at `from` lies at `to`, turned about it by `turn` (x, y, z, w). */
export interface GhostPlacement {
  readonly turn: readonly [number, number, number, number];
  readonly from: Vec3;
  readonly to: Vec3;
}

const PALE = new Vector4(0.86, 0.93, 1, 0.7);

/** A predicted plant or a branch that is being placed: drawn translucent, at any place. */
export class Ghost {
  readonly group = new Group();
  private readonly nodes = new NodeTexture();
  private readonly materials: RawShaderMaterial[];
  private readonly branches: Branches;
  private readonly leaves: LeafRows;
  private readonly placement = { turn: new Quaternion(), from: new Vector3(), to: new Vector3() };
  private box: Box | null = null;

  constructor(shared: Uniforms) {
    const uniforms: Uniforms = {
      ...shared,
      uNodes: this.nodes.uniform,
      // A ghost is always lit: draw modes have no numbers for its rows.
      uMode: { value: 0 },
      // Both passes must meet the very same leaves, however they are looked at.
      uLeafLevel: { value: new Vector3(2, 1, 1) },
      uLeafTwig: { value: 0 },
      uLeafBand: { value: new Vector3(0, 0, 1) },
      uGhostTurn: { value: this.placement.turn },
      uGhostFrom: { value: this.placement.from },
      uGhostTo: { value: this.placement.to },
      uGhostTint: { value: PALE },
    };
    // The nearest surface is found first and then drawn alone: leaf behind leaf would add up to a solid crown.
    const depth = {
      colorWrite: false,
      transparent: true,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
    };
    const colour = { depthWrite: false, transparent: true };
    const shader = (vertexShader: string, fragmentShader: string, options: object, defines: object = {}) =>
      new RawShaderMaterial({
        glslVersion: GLSL3,
        uniforms,
        vertexShader,
        fragmentShader,
        side: FrontSide,
        defines: { GHOST: "", ...defines },
        ...options,
      });
    const both = { side: 2 } as const;
    const bark = shader(BRANCH_VERTEX, branchFragment(), colour);
    const branchDepth = shader(BRANCH_VERTEX, DEPTH_FRAGMENT, depth);
    const leaf = shader(leafVertex(), leafFragment(), { ...colour, ...both });
    const leafDepth = shader(leafVertex(), LEAF_DEPTH_FRAGMENT, { ...depth, ...both });
    this.materials = [bark, branchDepth, leaf, leafDepth];
    this.branches = new Branches({ bark, twig: bark, branchDepth }, { strips: false });
    this.leaves = new LeafRows({ leaf, leafDepth }, uniforms);
    const seen = [...this.branches.meshes, this.leaves.mesh];
    const first = [...this.branches.casters, this.leaves.caster];
    for (const mesh of first) mesh.renderOrder = 1;
    for (const mesh of seen) mesh.renderOrder = 2;
    this.group.add(...first, ...seen);
    this.hide();
  }

  /** The box around it where it stands; its corners turned, so that it may be larger than need be. */
  bounds(): Box | null {
    return this.box && carried(this.box, this.placement);
  }

  /** Shows these rows of a table, or all of them, in place of what was shown before. */
  show(table: TreeTable, rows: Iterable<number> | null): void {
    this.hide();
    this.nodes.reserve(table.rows);
    const low: [number, number, number] = [Infinity, Infinity, Infinity];
    const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
    for (const row of rows ?? all(table.rows)) {
      // A metamer is drawn from its parent's node, and swells where its limb leaves another.
      for (const needed of [row, table.parent[row]!, table.limbOrigin[row]!]) {
        if (needed >= 0) this.nodes.write(table, needed);
      }
      this.branches.update(table, row);
      this.leaves.update(table, row);
      if (table.radiusCode[row] === 0) continue;
      for (const axis of [0, 1, 2] as const) {
        const at = table.course.placed[3 * row + axis]!;
        low[axis] = Math.min(low[axis], at);
        high[axis] = Math.max(high[axis], at);
      }
    }
    this.nodes.upload();
    this.branches.upload(table);
    this.leaves.upload();
    // Both passes must meet the very same surface.
    this.branches.detail(false);
    this.group.visible = true;
    this.box = low[0] <= high[0] ? { min: low, max: high } : { min: [0, 0, 0], max: [0, 0, 0] };
  }

  /** Places the ghost. */
  place({ turn, from, to }: GhostPlacement): void {
    this.placement.turn.set(...turn);
    this.placement.from.set(...from);
    this.placement.to.set(...to);
  }

  hide(): void {
    this.box = null;
    this.group.visible = false;
    this.branches.truncate(0);
    this.leaves.truncate(0);
    this.branches.upload();
    this.leaves.upload();
  }

  /** A restored context has lost every texture. */
  restored(): void {
    this.nodes.uploadWhole();
    this.branches.restored();
    this.leaves.restored();
  }

  dispose(): void {
    this.branches.dispose();
    this.leaves.dispose();
    this.nodes.dispose();
    for (const material of this.materials) material.dispose();
  }
}

function* all(rows: number): Iterable<number> {
  for (let row = 0; row < rows; row += 1) yield row;
}

function carried({ min, max }: Box, placement: { turn: Quaternion; from: Vector3; to: Vector3 }): Box {
  const low = new Vector3(Infinity, Infinity, Infinity);
  const high = low.clone().negate();
  for (let corner = 0; corner < 8; corner += 1) {
    const pick = (axis: 0 | 1 | 2) => ((corner >> axis) & 1 ? max : min)[axis];
    const place = new Vector3(pick(0), pick(1), pick(2))
      .sub(placement.from)
      .applyQuaternion(placement.turn)
      .add(placement.to);
    low.min(place);
    high.max(place);
  }
  return { min: [low.x, low.y, low.z], max: [high.x, high.y, high.z] };
}
