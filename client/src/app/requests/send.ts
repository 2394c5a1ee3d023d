import { principal } from "./principal";
import { refusal, silence } from "./request";
import type { Progress } from "./transfer";

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
