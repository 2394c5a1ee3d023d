import { type CameraView, FIELD_OF_VIEW } from "../../scene/camera/camera-view";

const DEGREES = 180 / Math.PI;
/** Pixels along the longer side of a picture that is as the screen shows it. */
const LONGER = 800;

/** The view of the page as the server is asked for it (`EX6`): its camera, and the shape of its picture. */
export function cameraOptions(
  { target, yaw, pitch, distance }: CameraView,
  screen: { readonly width: number; readonly height: number },
  metres: number,
): ReadonlyMap<string, string> {
  const scale = LONGER / Math.max(screen.width, screen.height);
  const [width, height] = [screen.width, screen.height].map((side) => Math.max(16, Math.round(side * scale)));
  const text = (value: number) => String(Number(value.toFixed(4)));
  return new Map([
    ["size", `${width}x${height}`],
    ["turn", text((yaw * DEGREES) % 360)],
    ["rise", text(pitch * DEGREES)],
    ["fov", text(FIELD_OF_VIEW * DEGREES)],
    ["distance", text(distance * metres)],
    ["target", target.map((place) => text(place * metres)).join(",")],
  ]);
}
