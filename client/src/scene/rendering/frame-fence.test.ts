import { beforeEach, expect, it, vi } from "vitest";
import { FrameFence } from "./frame-fence";

const gl = {
  SYNC_GPU_COMMANDS_COMPLETE: 1,
  SYNC_STATUS: 2,
  UNSIGNALED: 3,
  fenceSync: vi.fn(() => ({}) as WebGLSync),
  getSyncParameter: vi.fn(() => 3),
  deleteSync: vi.fn(),
  isContextLost: vi.fn(() => false),
  flush: vi.fn(),
};
let fence: FrameFence;

beforeEach(() => {
  vi.clearAllMocks();
  gl.getSyncParameter.mockReturnValue(3);
  gl.isContextLost.mockReturnValue(false);
  fence = new FrameFence(gl as unknown as WebGL2RenderingContext);
});

it("a card that draws one frame while the next is made is not waited for", () => {
  expect(fence.behind(0)).toBe(false);
  fence.set(0);
  expect(fence.behind(17)).toBe(false);
  fence.set(17);
  expect(fence.behind(34)).toBe(false);
});

it("one that is behind is, until it is done with the first frame", () => {
  for (const began of [0, 17, 34]) fence.set(began);
  expect(fence.behind(51)).toBe(true);
  expect(fence.behind(9000)).toBe(true);
  gl.getSyncParameter.mockReturnValue(4);
  expect(fence.behind(9016)).toBe(false);
  expect(gl.deleteSync).toHaveBeenCalledTimes(3);
});

it("one that was behind is waited for from the next frame on, until it is quick again", () => {
  fence.set(0);
  expect(fence.behind(500)).toBe(true);
  gl.getSyncParameter.mockReturnValueOnce(4);
  expect(fence.behind(516)).toBe(false);
  fence.set(516);
  expect(fence.behind(520), "no frame is queued").toBe(true);
  gl.getSyncParameter.mockReturnValueOnce(4);
  expect(fence.behind(532)).toBe(false);
  fence.set(532);
  expect(fence.behind(549)).toBe(false);
});

it("what was asked for before the first picture is forgotten", () => {
  fence.set(0);
  expect(fence.behind(500)).toBe(true);
  gl.getSyncParameter.mockReturnValueOnce(4);
  expect(fence.behind(516)).toBe(false);
  fence.set(516);
  fence.forget();
  expect(gl.deleteSync).toHaveBeenCalledTimes(2);
  expect(fence.behind(600)).toBe(false);
  fence.set(600);
  expect(fence.behind(617), "nor does it say anything of the frames that follow").toBe(false);
});

it("one whose context is lost will never be done, and is not waited for", () => {
  fence.set(0);
  gl.isContextLost.mockReturnValue(true);
  expect(fence.behind(100)).toBe(false);
});

it("a card that comes back is asked for nothing that the one before was to do", () => {
  fence.set(0);
  fence.restored();
  expect(fence.behind(9000)).toBe(false);
  expect(gl.getSyncParameter).not.toHaveBeenCalled();
  expect(gl.deleteSync).not.toHaveBeenCalled();
});
