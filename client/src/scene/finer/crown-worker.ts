import { type CrownOrder, crownField } from "./crown-field";

// Answers each order with its field, beside the page.
self.addEventListener("message", ({ data }: MessageEvent<CrownOrder>) => {
  const field = crownField(data);
  self.postMessage(field, { transfer: [field.buffer] });
});
