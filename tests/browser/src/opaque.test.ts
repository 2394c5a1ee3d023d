import { expect, test } from "vitest";
import { QUALITIES } from "../../../client/src/scene/rendering/quality";
import { WATCHED } from "./screens";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** More frames than it takes to try every quality. */
const FRAMES = 1500;

/** What a frame was: pixels drawn across, before they are enlarged, and pixels of the canvas that the page shines through. */
interface Frame {
  readonly across: number;
  readonly translucent: number;
}

/**
 * Turns the tree by its strip and reads the canvas back after every frame. The page's own clock says that frames are quick
 * until the whole quality is drawn, and from then on that each takes a little too long, so that it goes from one quality to
 * the next on any machine. Ends when as many pixels across were drawn as each of `sizes` says.
 */
function turnThroughQualities(strip: Element, [sizes, most]: readonly [readonly number[], number]): Promise<Frame[]> {
  const canvas = document.querySelector<HTMLCanvasElement>("#workspace")!;
  const gl = canvas.getContext("webgl2")!;
  const [quick, slow] = [5, 46];
  let [now, step, across] = [performance.now(), quick, 0];
  performance.now = () => now;
  const { drawElementsInstanced } = gl;
  gl.drawElementsInstanced = (...args) => {
    const [, , width, height] = gl.getParameter(gl.VIEWPORT) as Int32Array;
    // A shadow map is square.
    if (width !== height) across = width!;
    drawElementsInstanced.apply(gl, args);
  };
  const request = window.requestAnimationFrame.bind(window);
  const frames: Frame[] = [];
  const read = () => {
    if (across === 0) return;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let translucent = 0;
    for (let at = 3; at < pixels.length; at += 4) if (pixels[at] !== 255) translucent += 1;
    frames.push({ across, translucent });
    if (across === Math.max(...sizes)) step = slow;
    across = 0;
  };
  window.requestAnimationFrame = (callback) =>
    request((time) => {
      callback(time);
      read();
    });
  return new Promise((resolve) => {
    const turn = (left: number) => {
      const missing = sizes.filter((size) => !frames.some(({ across }) => across === size));
      if (missing.length === 0 || left === 0) return resolve(frames);
      now += step;
      strip.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true }));
      request(() => turn(left - 1));
    };
    turn(most);
  });
}

test("the page never shines through the picture, however quickly it is drawn", async () => {
  const { tablet } = await workshop.drawn(WATCHED);
  await tablet.untilStill();
  const strip = tablet.page.getByRole("slider", { name: "Turn the tree" });
  const canvas = Math.floor(WATCHED.width * WATCHED.detail);
  const sizes = QUALITIES.map(({ scale }) => Math.floor(scale * canvas));
  const frames = await strip.evaluate(turnThroughQualities, [sizes, FRAMES] as const);
  expect(
    frames.filter(({ translucent }) => translucent > 0),
    "translucent pixels",
  ).toEqual([]);
  expect(new Set(frames.map(({ across }) => across))).toEqual(new Set(sizes));
});
