import { FrameError } from "./frame-error";

/** Unpacks raw deflate (RFC 1951) to exactly `length` bytes; stops reading at the first byte too many (FR2). */
export async function inflateRaw(packed: Uint8Array<ArrayBuffer>, length: number): Promise<Uint8Array> {
  const out = new Uint8Array(length);
  let filled = 0;
  const stream = new DecompressionStream("deflate-raw");
  const writer = stream.writable.getWriter();
  // Errors of the writing side come back on the reading side; here they must only not go unhandled.
  writer.write(packed).catch(() => {});
  writer.close().catch(() => {});
  const reader = stream.readable.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (filled + value.length > length) {
        await reader.cancel();
        throw new FrameError("The body unpacks to more than the header says.");
      }
      out.set(value, filled);
      filled += value.length;
    }
  } catch (error) {
    if (error instanceof FrameError) throw error;
    throw new FrameError("The body is not raw deflate.");
  }
  if (filled !== length) throw new FrameError("The body unpacks to less than the header says.");
  return out;
}
