import type { Camera, ClientMessage } from "../../wire/generated";

export type Here = Extract<ClientMessage, { type: "here" }>;

/** A camera that nobody follows is told so often, in milliseconds. */
const CAMERA_PAUSE = 500;

/** What a page says of itself, as often as anything of it is new. */
export class OwnWords {
  #said = "";
  #camera = "";
  #cameraAt = Number.NEGATIVE_INFINITY;
  #name = "";

  /** There is a new connection: all of it is said again. */
  again(): void {
    [this.#said, this.#camera, this.#cameraAt, this.#name] = ["", "", Number.NEGATIVE_INFINITY, ""];
  }

  /** What is to be said now; null where nothing is new. */
  next(
    now: number,
    here: Omit<Here, "camera" | "name">,
    camera: Camera | null,
    name: string,
    followed: boolean,
  ): Here | null {
    const words = JSON.stringify(here);
    const seen = camera && JSON.stringify(camera);
    const showsCamera = seen !== null && seen !== this.#camera && (followed || now - this.#cameraAt >= CAMERA_PAUSE);
    if (words === this.#said && !showsCamera && name === this.#name) {
      return null;
    }
    const message: Here = {
      ...here,
      ...(showsCamera && camera ? { camera } : {}),
      ...(name !== this.#name && name !== "" ? { name } : {}),
    };
    this.#said = words;
    this.#name = name;
    if (showsCamera) {
      [this.#camera, this.#cameraAt] = [seen, now];
    }
    return message;
  }
}
