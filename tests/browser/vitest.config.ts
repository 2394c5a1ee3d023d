import { defineConfig } from "vitest/config";

/** Files that take minutes and concern what a tree looks like alone; `BROWSER_TESTS=quick` leaves them out. */
const LONG = ["light", "looks"].map((name) => `src/${name}.test.ts`);

// The browser draws with the processor: one page at a time, and time-outs that only guard against hanging.
export default defineConfig({
  test: {
    include: ["src/**/*.test.ts"],
    exclude: process.env.BROWSER_TESTS === "quick" ? LONG : [],
    environment: "node",
    globalSetup: "src/one-browser.ts",
    fileParallelism: false,
    testTimeout: 240_000,
    hookTimeout: 240_000,
    expect: { poll: { timeout: 60_000, interval: 50 } },
  },
});
