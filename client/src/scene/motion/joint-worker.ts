import { type JointTask, JointWork } from "./joint-work";

// Makes joints beside the page, so that no frame waits for it.
const work = new JointWork();
self.addEventListener("message", ({ data }: MessageEvent<JointTask>) => {
  const made = work.make(data);
  self.postMessage(made, { transfer: made.moving ? [made.moving.rows.buffer] : [] });
});
