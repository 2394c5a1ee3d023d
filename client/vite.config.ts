import { join } from "node:path";
import { defineConfig } from "vitest/config";
import { firstPictureChunk } from "./first-picture-chunk.ts";
import { firstPictureBudget } from "./first-picture-plugin.ts";
import { leanShaders } from "./shader-plugin.ts";
import { shellWorker } from "./shell-plugin.ts";
import { leanThree } from "./three-plugin.ts";
import { wordsByLanguage } from "./words-plugin.ts";

// `./dev` starts both.
const server = `http://127.0.0.1:${process.env.ESPALIER_PORT ?? 7700}`;

export default defineConfig({
  base: "/",
  plugins: [wordsByLanguage(), leanThree(), leanShaders(), firstPictureBudget(), shellWorker()],
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  // `first-picture-plugin.ts` says how much may be loaded at once.
  build: {
    target: "es2022",
    sourcemap: false,
    chunkSizeWarningLimit: 800,
    rolldownOptions: {
      output: { codeSplitting: { groups: [{ name: firstPictureChunk(join(import.meta.dirname, "src/main.tsx")) }] } },
    },
  },
  // `/s/NAME` needs no proxy: Vite answers unknown paths with index.html, as the server does.
  server: { proxy: { "/api": { target: server, ws: true }, "/health": server } },
  test: {
    include: ["src/**/*.test.{ts,tsx}", "test/**/*.test.ts"],
    environment: "node",
    setupFiles: ["test/words.ts"],
    // Only keeps a test from hanging: a busy machine is slow.
    testTimeout: 60_000,
  },
});
