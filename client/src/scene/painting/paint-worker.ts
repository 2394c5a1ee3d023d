import { type Order, paint } from "./paint";

// Paints what it is sent, in order, beside the page.
self.addEventListener("message", ({ data }: MessageEvent<Order>) => {
  const painted = paint(data);
  const texels = painted.flatMap(({ colour, relief }) => [...colour, ...relief]);
  self.postMessage(painted, { transfer: texels.map(({ buffer }) => buffer) });
});
