import { InstancedBufferGeometry, type Mesh, PerspectiveCamera, type WebGLRenderer } from "three";

/**
 * Prepares the shader programs in advance. It says when all are linked; and it has one instance of everything essential
 * drawn before there is anything to draw, outside the visible picture: a linked program is not yet one that the graphics card can
 * run. Drivers finish it when it is first drawn with, and whatever they are asked next waits for that.
 */
export class Rehearsal {
  /** Whether anything may have been drawn. */
  prepared = false;
  /** Whether every program is linked; drawing would wait for that. */
  private linked = false;
  private played = false;
  private begun = false;

  /** `told` is called when every program is linked. */
  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly cast: readonly Mesh[],
    private readonly told: () => void,
  ) {}

  /** Has the programs made, once. */
  begin(): void {
    if (this.begun) return;
    this.begun = true;
    const camera = new PerspectiveCamera();
    void Promise.all(this.cast.map((mesh) => this.renderer.compileAsync(mesh, camera))).then(() => {
      this.linked = true;
      this.told();
    });
  }

  /** Says whether it is time to draw, and has everything asked of the programs that has to be known for it. */
  prepare(): boolean {
    if (this.linked && !this.prepared) {
      this.prepared = true;
      // Asked for one after the other among the drawing, each answer would wait for all that was drawn before.
      for (const program of this.renderer.info.programs ?? []) program.getUniforms();
    }
    return this.prepared;
  }

  /** Has everything drawn once by what draws the scene, if it is time for that and has not been done. */
  play(draw: () => void): void {
    if (this.played) return;
    this.played = true;
    const { cast } = this;
    const before = cast.map(({ visible }) => visible);
    this.enter(1);
    for (const mesh of cast) mesh.visible = true;
    draw();
    this.enter(0);
    for (const [i, mesh] of cast.entries()) mesh.visible = before[i]!;
  }

  private enter(instances: number): void {
    for (const { geometry } of this.cast) {
      if (geometry instanceof InstancedBufferGeometry) geometry.instanceCount = instances;
    }
  }
}
