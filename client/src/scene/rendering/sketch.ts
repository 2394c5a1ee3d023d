import { PerspectiveCamera } from "three";
import type { Sitting } from "./still-pictures";

/** What lines are drawn on before there is a sky. */
const PAPER = [0.91, 0.91, 0.902, 1] as const;
const NOTHING = [0, 0, 0, 1] as const;

/** Draws the tree on the canvas; the camera goes on with its movement by so many seconds. */
export type Sketch = (step: number) => void;

/**
 * A large tree as lines on paper: where the processor draws, it is seen so before its bark and leaves are drawn for the
 * first time. One program is enough for it, and it is made before all others.
 */
export async function sketch({ renderer, screen, world, camera }: Sitting): Promise<Sketch> {
  await renderer.compileAsync(world.tree.lines, new PerspectiveCamera());
  return (step) => {
    camera.rig.keep(world.reach());
    camera.rig.step(step);
    const sight = camera.aimed();
    world.uniforms.uTime!.value = world.table.now();
    // Lines are as wide as on a picture of all pixels.
    screen.fit(1, false);
    const { color } = renderer.state.buffers;
    color.setClear(...PAPER, false);
    renderer.setRenderTarget(null);
    renderer.clear();
    color.setClear(...NOTHING, false);
    world.tree.sketch((lines) => renderer.render(lines, sight.camera));
  };
}
