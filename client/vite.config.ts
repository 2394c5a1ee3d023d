import type { ClientRequest, IncomingMessage } from "node:http";
import { join } from "node:path";
import type { ProxyOptions } from "vite";
import { defineConfig } from "vitest/config";
import { firstPictureChunk } from "./first-picture-chunk.ts";
import { firstPictureBudget } from "./first-picture-plugin.ts";
import { leanShaders } from "./shader-plugin.ts";
import { shellWorker } from "./shell-plugin.ts";
import { leanThree } from "./three-plugin.ts";
import { wordsByLanguage } from "./words-plugin.ts";

// `./dev` starts both.
const server = `http://127.0.0.1:${process.env.ESPALIER_PORT ?? 7700}`;

const LOOPBACK = /^(127\.|::1$|::ffff:127\.)/;

/** Says of whom it passes on a request, so that a tablet is not taken for this machine (`AC1`). */
const saysForWhom: ProxyOptions["configure"] = (proxy) => {
  const say = (passedOn: ClientRequest, { socket }: IncomingMessage) => {
    const { remoteAddress = "" } = socket;
    if (!LOOPBACK.test(remoteAddress)) {
      passedOn.setHeader("x-forwarded-for", remoteAddress);
    }
  };
  proxy.on("proxyReq", say);
  proxy.on("proxyReqWs", say);
};

/** The tablet itself, and the page of the API, of which the tablet loads nothing. */
const PAGES = ["index.html", "api.html"];

export default defineConfig({
  base: "/",
  plugins: [wordsByLanguage(), leanThree(), leanShaders(), firstPictureBudget(), shellWorker()],
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  // `first-picture-plugin.ts` says how much may be loaded at once.
  build: {
    target: "es2022",
    sourcemap: false,
    // What others ask to be said where their libraries are passed on.
    license: { fileName: "licences.txt" },
    // Every browser that has the rest of what is used here preloads modules by itself.
    modulePreload: { polyfill: false },
    // The page of the API is one library.
    chunkSizeWarningLimit: 1600,
    rolldownOptions: {
      input: PAGES.map((page) => join(import.meta.dirname, page)),
      output: { codeSplitting: { groups: [{ name: firstPictureChunk(join(import.meta.dirname, "src/main.tsx")) }] } },
    },
  },
  // `/s/NAME` needs no proxy: Vite answers unknown paths with index.html, as the server does.
  server: { proxy: { "/api/": { target: server, ws: true, configure: saysForWhom }, "/health": server } },
  test: {
    include: ["src/**/*.test.{ts,tsx}", "test/**/*.test.ts"],
    environment: "node",
    setupFiles: ["test/words.ts"],
    // Only keeps a test from hanging: a busy machine is slow.
    testTimeout: 60_000,
  },
});
