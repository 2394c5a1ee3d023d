import { type Gesture, GestureRecogniser, type PointerSample } from "../src/app/input/gesture-recogniser";

type Device = PointerSample["device"];

/** Hands a recogniser of its own what fingers, a pen and a mouse do; each call gives the gestures it makes of it. */
export function pointers() {
  const recogniser = new GestureRecogniser();
  const at = (id: number, x: number, y: number, time: number, device: Device, pressure = 0.5) => ({
    id,
    x,
    y,
    time,
    device,
    pressure,
  });
  return {
    recogniser,
    down: (id: number, x: number, y: number, time: number, device: Device = "touch", extra: object = {}) =>
      recogniser.down({
        ...at(id, x, y, time, device),
        button: 0,
        pans: false,
        choose: false,
        holdable: false,
        ...extra,
      }),
    move: (id: number, x: number, y: number, time: number, device: Device = "touch") =>
      recogniser.move([at(id, x, y, time, device)]),
    up: (id: number, x: number, y: number, time: number, device: Device = "touch") =>
      recogniser.up(at(id, x, y, time, device)),
    at,
  };
}

/** What kinds of gestures these are. */
export const kinds = (gestures: Gesture[]) => gestures.map(({ kind }) => kind);
/** A place on the glass as a finger tells it: without pressure. */
export const touch = (x: number, y: number) => ({ x, y, pressure: null });
