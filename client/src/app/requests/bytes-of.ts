import type { Progress } from "./transfer";

/** Reads an answer to its end and reports the progress. */
export async function bytesOf(response: Response, tell: (progress: Progress) => void): Promise<Blob> {
  const type = response.headers.get("content-type") ?? "";
  // The length counts what travels, which is fewer bytes where it is compressed.
  const named = response.headers.has("content-encoding") ? null : response.headers.get("content-length");
  const total = named === null ? null : Number(named);
  const reader = response.body?.getReader();
  if (!reader) {
    return await response.blob();
  }
  const parts: BlobPart[] = [];
  let bytes = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      return new Blob(parts, { type });
    }
    parts.push(value);
    bytes += value.byteLength;
    tell({ bytes, total });
  }
}
