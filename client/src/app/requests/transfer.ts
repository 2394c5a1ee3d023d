import { signal } from "@preact/signals";
import { principal } from "./principal";
import { refusal, silence } from "./request";

/** How far something on its way has come; `total` is null where it is not known. */
export interface Progress {
  readonly bytes: number;
  readonly total: number | null;
  /** Whether it is still made where it comes from. */
  readonly isMaking?: boolean;
}

/** Something large on its way to or from the server, one at a time: shown while it lasts, and can be given up. */
export class Transfer {
  /** Null where nothing is in progress. */
  readonly progress = signal<Progress | null>(null);
  #stop: AbortController | null = null;

  /** Runs it; null if it was given up, or one was in progress already. */
  async run<Result>(
    work: (signal: AbortSignal, tell: (progress: Progress) => void) => Promise<Result>,
  ): Promise<Result | null> {
    if (this.#stop) {
      return null;
    }
    const stop = new AbortController();
    this.#stop = stop;
    this.progress.value = { bytes: 0, total: null };
    try {
      return await work(stop.signal, (progress) => {
        if (!stop.signal.aborted) {
          this.progress.value = progress;
        }
      });
    } catch (error) {
      if (stop.signal.aborted) {
        return null;
      }
      throw error;
    } finally {
      this.#stop = null;
      this.progress.value = null;
    }
  }

  cancel(): void {
    this.#stop?.abort();
  }
}

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

/** Posts bytes and reports how many are sent, which `fetch` cannot; gives the answer's JSON. */
export function send(
  path: string,
  { type, body }: { readonly type: string; readonly body: Uint8Array<ArrayBuffer> | Blob },
  stop?: AbortSignal,
  tell?: (progress: Progress) => void,
): Promise<unknown> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open("POST", path);
    for (const [name, value] of Object.entries({ ...principal(), "content-type": type })) {
      request.setRequestHeader(name, value);
    }
    request.responseType = "json";
    request.upload.onprogress = ({ loaded }) =>
      tell?.({ bytes: loaded, total: body instanceof Blob ? body.size : body.byteLength });
    request.onload = () =>
      request.status >= 200 && request.status < 300
        ? resolve(request.response)
        : reject(refusal(request.status, request.response));
    request.onerror = () => reject(silence());
    request.onabort = () => reject(stop?.reason ?? silence());
    stop?.addEventListener("abort", () => request.abort());
    request.send(body);
  });
}
