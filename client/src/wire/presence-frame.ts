import { ByteReader } from "./bytes";
import { FrameError } from "./frame-error";

type Vec3 = readonly [number, number, number];

/** Where a device points (PS1). */
export type PointerPlace =
  | { readonly kind: "nowhere" }
  /** On wood, with an offset along h, u and w (LF1). */
  | { readonly kind: "wood"; readonly row: number; readonly along: number; readonly offset: Vec3 }
  | { readonly kind: "space"; readonly position: Vec3 };

/** What is new of a device; what is left out is as it was. Lengths are in internodes. */
export interface DeviceNews {
  device: number;
  pointer?: { readonly place: PointerPlace; readonly radius: number };
  /** A line that is being drawn there. */
  sketch?: readonly Vec3[];
  /** Target, yaw, pitch, distance. */
  camera?: readonly number[];
}

const [POINTER, SKETCH, CAMERA] = [1, 2, 4];
const [PLACE_STEPS, RADIUS_STEPS, ALONG_STEPS] = [32, 64, 255];

/** Reads the body of a frame of presence; mirrors `proto/src/presence_frame.rs`. */
export function readPresence(body: Uint8Array): DeviceNews[] {
  const reader = new ByteReader(body);
  const count = reader.varint();
  const devices: DeviceNews[] = [];
  for (let i = 0; i < count; i += 1) devices.push(readDevice(reader));
  if (!reader.done) throw new FrameError("Something follows the last device.");
  return devices;
}

function readDevice(reader: ByteReader): DeviceNews {
  const news: DeviceNews = { device: reader.varint() };
  const parts = reader.byte();
  if ((parts & ~(POINTER | SKETCH | CAMERA)) !== 0) throw new FrameError("A device has unknown news.");
  if (parts & POINTER) news.pointer = { place: readPlace(reader), radius: reader.varint() / RADIUS_STEPS };
  if (parts & SKETCH) news.sketch = readSketch(reader);
  if (parts & CAMERA) news.camera = Array.from({ length: 6 }, () => finite(reader.float()));
  return news;
}

function readPlace(reader: ByteReader): PointerPlace {
  switch (reader.byte()) {
    case 0:
      return { kind: "nowhere" };
    case 1:
      return {
        kind: "wood",
        row: reader.varint(),
        along: reader.byte() / ALONG_STEPS,
        offset: inInternodes(readSteps(reader)),
      };
    case 2:
      return { kind: "space", position: inInternodes(readSteps(reader)) };
    default:
      throw new FrameError("A pointer is in an unknown place.");
  }
}

function readSketch(reader: ByteReader): Vec3[] {
  const count = reader.varint();
  const sketch: Vec3[] = [];
  let [x, y, z] = [0, 0, 0];
  for (let i = 0; i < count; i += 1) {
    const [dx, dy, dz] = readSteps(reader);
    [x, y, z] = [(x + dx) | 0, (y + dy) | 0, (z + dz) | 0];
    sketch.push(inInternodes([x, y, z]));
  }
  return sketch;
}

function readSteps(reader: ByteReader): Vec3 {
  return [reader.zigzag(), reader.zigzag(), reader.zigzag()];
}

function inInternodes([x, y, z]: Vec3): Vec3 {
  return [x / PLACE_STEPS, y / PLACE_STEPS, z / PLACE_STEPS];
}

function finite(value: number): number {
  if (!Number.isFinite(value)) throw new FrameError("A camera is not finite.");
  return value;
}
