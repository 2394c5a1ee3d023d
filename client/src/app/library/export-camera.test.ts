import { expect, it } from "vitest";
import { CameraRig } from "../../scene/camera/camera-rig";
import { cameraOptions } from "./export-camera";

it("puts the eye of the server's picture where that of the page is", () => {
  const view = { target: [3, 12, -4] as [number, number, number], yaw: 7.1, pitch: -0.3, distance: 30 };
  const options = cameraOptions(view, { width: 1600, height: 1000 }, 0.1);
  const [turn, rise, distance, fov] = ["turn", "rise", "distance", "fov"].map((name) => Number(options.get(name)));
  const target = options.get("target")?.split(",").map(Number) ?? [];
  // The server's eye: around to the right from the front, and up from the horizon.
  const [around, up] = [turn!, rise!].map((degrees) => (degrees * Math.PI) / 180);
  const way = [Math.sin(around!) * Math.cos(up!), Math.sin(up!), Math.cos(around!) * Math.cos(up!)];
  const eye = new CameraRig().eye(view);
  for (const axis of [0, 1, 2]) {
    expect(target[axis]! + distance! * way[axis]!).toBeCloseTo(0.1 * eye[axis]!, 3);
  }
  expect([options.get("size"), options.get("target"), fov]).toEqual(["800x500", "0.3,1.2,-0.4", 32]);
});

it("keeps the shape of a tall and of a flat screen", () => {
  const view = { target: [0, 0, 0] as [number, number, number], yaw: 0, pitch: 0, distance: 1 };
  const size = (width: number, height: number) => cameraOptions(view, { width, height }, 1).get("size");
  expect([size(390, 844), size(844, 390), size(9000, 3)]).toEqual(["370x800", "800x370", "800x16"]);
});
