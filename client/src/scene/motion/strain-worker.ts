import { brokenBy, type StrainOrder } from "./strain";

// Finds what would break beside the page, so that no frame waits for it.
self.addEventListener("message", ({ data }: MessageEvent<StrainOrder>) => {
  const rows = brokenBy(data);
  self.postMessage(rows, { transfer: [rows.buffer] });
});
