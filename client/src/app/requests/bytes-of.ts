import type { Progress } from "./transfer";

/** Bytes that are held in script at most: a browser keeps more than that elsewhere, on disk where there is much. */
const HELD = 8 * 1024 * 1024;

/** Reads an answer to its end and reports the progress. */
export async function bytesOf(response: Response, tell: (progress: Progress) => void, held = HELD): Promise<Blob> {
  const type = response.headers.get("content-type") ?? "";
  // The length counts what travels, which is fewer bytes where it is compressed.
  const named = response.headers.has("content-encoding") ? null : response.headers.get("content-length");
  const total = named === null ? null : Number(named);
  const reader = response.body?.getReader();
  if (!reader) {
    return await response.blob();
  }
  const whole: Blob[] = [];
  let parts: Uint8Array<ArrayBuffer>[] = [];
  let [bytes, kept] = [0, 0];
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      return new Blob([...whole, ...parts], { type });
    }
    parts.push(value);
    bytes += value.byteLength;
    kept += value.byteLength;
    if (kept >= held) {
      whole.push(new Blob(parts));
      [parts, kept] = [[], 0];
    }
    tell({ bytes, total });
  }
}
