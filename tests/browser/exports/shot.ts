import { CameraRig } from "../../../client/src/scene/camera/camera-rig";
import { FIELD_OF_VIEW } from "../../../client/src/scene/camera/camera-view";
import { type View, WHOLE } from "../../../client/src/scene/camera/view";
import { type SkyLight, skyLight } from "../../../client/src/scene/light/sky-light";
import type { Vec3 } from "../../../client/src/scene/vector";
import { type Background, DEFAULT_APPEARANCE } from "../../../client/src/wire/generated";

/** A lamp and paper, so that the trees alone differ. */
export const STUDIO: Background = { ...DEFAULT_APPEARANCE.background, sky: "studio", ground: "plain" };
/** From the front and a little above. */
export const VIEW: View = { ...WHOLE, yaw: 20, pitch: 6, zoom: 1.1 };

/** Where the page's eye is, in metres, and its light. */
export interface Shot {
  readonly eye: Vec3;
  readonly target: Vec3;
  /** Vertical opening angle in degrees. */
  readonly angle: number;
  readonly light: SkyLight;
}

/** What of a skeleton the page's eye depends on. */
export interface Skeleton {
  readonly parameters: { readonly internode_length: number };
  readonly metamers: readonly { readonly position: Vec3 }[];
}

/** The shot that the page makes of a tree by `VIEW`, on a picture that is as wide as it is high. */
export function shotOf({ metamers, parameters }: Skeleton): Shot {
  const metres = parameters.internode_length;
  const along = ([0, 1, 2] as const).map((axis) => metamers.map(({ position }) => position[axis] / metres));
  const box = { min: corner(along, Math.min), max: corner(along, Math.max) };
  const rig = new CameraRig();
  rig.look(box, 1, VIEW);
  return {
    eye: scaled(rig.eye(), metres),
    target: scaled(rig.view.target, metres),
    angle: (FIELD_OF_VIEW * 180) / Math.PI,
    light: skyLight(STUDIO),
  };
}

function corner(along: readonly (readonly number[])[], pick: (a: number, b: number) => number): Vec3 {
  return along.map((places) => places.reduce((a, b) => pick(a, b))) as unknown as Vec3;
}

function scaled(place: Readonly<Vec3>, by: number): Vec3 {
  return place.map((value) => value * by) as unknown as Vec3;
}
