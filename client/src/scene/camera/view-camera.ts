import { CameraRig } from "./camera-rig";
import type { Box, CameraView } from "./camera-view";
import { Sight } from "./sight";
import type { View } from "./view";

/** What a camera may be asked to show, and what it tells. */
export interface ViewCameraOptions {
  /** The box around the tree. */
  readonly tree: () => Box;
  /** The same with the ghost beside it. */
  readonly shown: () => Box;
  /** It is on its way to another view. */
  readonly stirred: () => void;
}

/** The camera before the canvas: moved by fingers, and by what it is to show. */
export class ViewCamera {
  readonly rig = new CameraRig();
  readonly sight = new Sight();

  constructor(private readonly options: ViewCameraOptions) {}

  /** Turns around the target. */
  orbit(dxPixels: number, dyPixels: number): void {
    this.rig.orbit(dxPixels, dyPixels);
    this.options.stirred();
  }

  /** Turns to the front. */
  face(): void {
    this.rig.face();
    this.options.stirred();
  }

  /** Moves the picture with the fingers. */
  pan(dxPixels: number, dyPixels: number): void {
    this.rig.pan(dxPixels, dyPixels, this.sight.height);
    this.options.stirred();
  }

  /** Brings what is under a place on the canvas nearer (factor above 1) or further away. */
  zoom(factor: number, x: number, y: number): void {
    const { width, height } = this.sight;
    this.rig.zoom(factor, (2 * x - width) / height, 1 - (2 * y) / height);
    this.options.stirred();
  }

  /** Eases to a view of the whole tree and the ghost beside it; something may cover a share of the foot, and of the head. */
  fitTree(covered = 0, head = 0): void {
    this.fitBox(this.options.shown(), covered, head);
  }

  /** Eases to a view of what will be there. */
  fitBox(box: Box, covered = 0, head = 0): void {
    this.rig.fit(box, this.aspect, covered, head);
    this.options.stirred();
  }

  /** Shows the whole tree at once, as a view wants it. */
  look(view: View): void {
    this.rig.look(this.options.tree(), this.aspect, view);
    this.options.stirred();
  }

  /** Eases back to where it was before the last fit, unless the user has moved it since. */
  restore(): void {
    this.rig.restore();
    this.options.stirred();
  }

  /** Goes along with another camera; that is no move of the user's. */
  accompany(view: CameraView): void {
    this.rig.accompany(view);
    this.options.stirred();
  }

  /** Eases to where another camera is; `restore` leads back. */
  visit(view: CameraView): void {
    this.rig.visit(view);
    this.options.stirred();
  }

  /** Whether it has come where it goes. */
  get arrived(): boolean {
    return this.rig.arrived;
  }

  /** How often the user has moved it. */
  get moves(): number {
    return this.rig.moves;
  }

  /** Whether the whole box is in the picture, once it has come where it goes. */
  frames(box: Box): boolean {
    return this.rig.frames(box, this.aspect);
  }

  /** Eases back until it is. */
  widen(box: Box): void {
    this.rig.widen(box, this.aspect);
    this.options.stirred();
  }

  /** Whether it has done that, and the user has not moved it since. */
  get isWidened(): boolean {
    return this.rig.isWidened;
  }

  /** Eases to where it was before. */
  unwiden(): void {
    this.rig.unwiden();
    this.options.stirred();
  }

  /** The eye, put where the camera stands now. */
  aimed(): Sight {
    this.sight.aim(this.rig.view, this.rig.eye());
    return this.sight;
  }

  private get aspect(): number {
    return this.sight.width / this.sight.height;
  }
}
