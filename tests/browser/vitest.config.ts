import { defineConfig } from "vitest/config";

// The browser draws with the processor: one page at a time, and time-outs that only guard against hanging.
export default defineConfig({
  test: {
    include: ["src/**/*.test.ts"],
    environment: "node",
    fileParallelism: false,
    testTimeout: 240_000,
    hookTimeout: 240_000,
  },
});
