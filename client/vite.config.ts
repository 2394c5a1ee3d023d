import { defineConfig } from "vitest/config";
import { shellWorker } from "./shell-plugin.ts";
import { leanThree } from "./three-plugin.ts";

// `./dev` starts both.
const server = `http://127.0.0.1:${process.env.ESPALIER_PORT ?? 7700}`;

export default defineConfig({
  base: "/",
  plugins: [leanThree(), shellWorker()],
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  // three.js is most of the one chunk, and the first picture needs all of it.
  build: { target: "es2022", sourcemap: false, chunkSizeWarningLimit: 800 },
  // `/s/NAME` needs no proxy: Vite answers unknown paths with index.html, as the server does.
  server: { proxy: { "/api": { target: server, ws: true }, "/health": server } },
  test: { include: ["src/**/*.test.{ts,tsx}", "test/**/*.test.ts"], environment: "node" },
});
