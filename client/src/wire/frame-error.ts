/** Bytes that are not a frame, or a frame that does not fit the table it is for (FR1). */
export class FrameError extends Error {
  override readonly name = "FrameError";
}
