import { Painter } from "../src/scene/painting/painter";

/** A painter whose worker never answers: what it would paint is not what is tested. */
export function idlePainter(): Painter {
  return new Painter(undefined, () => ({ onmessage: null, onerror: null, postMessage() {}, terminate() {} }));
}
