import type { WebGLRenderer } from "three";
import { fitted } from "../camera/camera-rig";
import type { CameraView } from "../camera/camera-view";
import type { PictureSize } from "../camera/sight";
import type { ViewCamera } from "../camera/view-camera";
import { USUAL } from "../mode/shown";
import type { Vec3 } from "../vector";
import type { World } from "../world";
import { pictureInTiles, type Tile } from "./picture-tiles";
import { PICTURE_SAMPLES, QUALITIES, type Quality } from "./quality";
import type { Screen } from "./screen";
import { encodePicture } from "./thumbnail";

/** What a picture beside the one on the canvas is made with. */
export interface Sitting {
  readonly renderer: WebGLRenderer;
  readonly world: World;
  readonly camera: ViewCamera;
  readonly screen: Screen;
  /** Takes over what changed in the table. */
  readonly sync: () => void;
  /** Chooses details for a picture of so many pixels in height, from so far. */
  readonly refine: (height: number, samples: number, quality: Quality, distance: number) => void;
}

/** A picture of the whole tree as a data URL of at most 192 KiB, too small for every detail. */
export async function thumbnail(sitting: Sitting, width: number, height: number): Promise<string> {
  const { renderer, world, camera, sync, refine } = sitting;
  const view = fitted(world.table.bounds(), width / height, camera.rig.view.yaw);
  const passing = [world.brush.mesh, world.ghost.group].filter(({ visible }) => visible);
  for (const object of passing) object.visible = false;
  const { mode, shown, unusual } = world;
  if (unusual) world.show("lit", USUAL);
  sync();
  camera.sight.aim(view, camera.rig.eye(view), width / height);
  refine(height, PICTURE_SAMPLES, QUALITIES[1], view.distance);
  if (world.shadow.isDue) world.drawShadow(renderer);
  const picture = encodePicture(renderer, width, height, () => drawScene(sitting));
  for (const object of passing) object.visible = true;
  if (unusual) world.show(mode, shown);
  return picture;
}

/** The view as PNG, of so many pixels. */
export async function picture(
  sitting: Sitting,
  size: PictureSize,
  stop: AbortSignal,
  tell: (share: number) => void,
): Promise<Blob> {
  const { renderer, camera, sync } = sitting;
  const [view, eye] = [structuredClone(camera.rig.view), camera.rig.eye()];
  sync();
  return pictureInTiles({ renderer, ...size, stop, tell, draw: (tile) => drawTile(sitting, view, eye, size, tile) });
}

function drawTile(sitting: Sitting, view: CameraView, eye: Vec3, size: PictureSize, tile: Tile): void {
  const { renderer, world, camera, screen, refine } = sitting;
  const brush = world.brush.mesh.visible;
  const shown = screen.size.clone();
  world.brush.mesh.visible = false;
  camera.sight.aimAtTile(view, eye, size, tile);
  refine(size.height, PICTURE_SAMPLES, QUALITIES[0], view.distance);
  if (world.shadow.isDue) {
    const target = renderer.getRenderTarget();
    world.drawShadow(renderer);
    renderer.setRenderTarget(target);
  }
  screen.size.set(tile.width, tile.height);
  drawScene(sitting);
  screen.size.copy(shown);
  world.brush.mesh.visible = brush;
  camera.aimed();
}

function drawScene({ renderer, world, camera }: Sitting): void {
  renderer.clear();
  renderer.render(world.scene, camera.sight.camera);
}
