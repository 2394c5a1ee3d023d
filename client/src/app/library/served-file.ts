import type { ExportProgress } from "../../wire/generated";
import { newClientKey } from "../connection/client-record";
import { bytesOf } from "../requests/bytes-of";
import { ask, askFor } from "../requests/request";
import type { Progress } from "../requests/transfer";

/** How often the server is asked how far a file is. */
const EVERY = 500;

/** The file with an ending that the server makes of the tree at a place of its API: a session, or a version of a tree. */
export async function servedFile(
  place: string,
  ending: string,
  options: ReadonlyMap<string, string>,
  stop: AbortSignal,
  tell: (progress: Progress) => void,
): Promise<Blob> {
  const ticket = newClientKey();
  let isMaking = true;
  const watch = setInterval(
    () => void tellProgress(`${place}/exports/${ticket}`, (progress) => isMaking && tell(progress)),
    EVERY,
  );
  try {
    const asked = new URLSearchParams([...options, ["ticket", ticket]]);
    const answer = await askFor("GET", `${place}/tree.${ending}?${asked}`, undefined, { signal: stop });
    if (!answer.headers.has("content-length")) {
      // It comes while it is made, so what is made of it is how far it is.
      return await bytesOf(answer, () => {});
    }
    isMaking = false;
    clearInterval(watch);
    return await bytesOf(answer, tell);
  } finally {
    isMaking = false;
    clearInterval(watch);
  }
}

/** Tells how far a file is that the server makes; it is no loss where the server does not say. */
async function tellProgress(path: string, tell: (progress: Progress) => void): Promise<void> {
  const progress = await ask<ExportProgress>("GET", path).catch(() => null);
  if (progress) {
    tell({ bytes: progress.written, total: progress.expected, isMaking: true, ahead: progress.ahead });
  }
}
