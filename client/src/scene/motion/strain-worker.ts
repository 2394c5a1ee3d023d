import { type StrainTask, StrainWork } from "./strain";

// Finds what would break beside the page, so that no frame waits for it.
const work = new StrainWork();
self.addEventListener("message", ({ data }: MessageEvent<StrainTask>) => {
  const rows = work.broken(data);
  self.postMessage(rows, { transfer: [rows.buffer] });
});
