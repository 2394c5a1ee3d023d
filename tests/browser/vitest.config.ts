import { defineConfig } from "vitest/config";

// Half of each test is waiting for the page, so two files run at a time; all use one browser, which draws with the
// processor. Time-outs only guard against hanging.
export default defineConfig({
  test: {
    include: ["src/**/*.test.ts"],
    environment: "node",
    globalSetup: "src/shared.ts",
    setupFiles: "src/every-test.ts",
    isolate: false,
    maxWorkers: 2,
    testTimeout: 240_000,
    hookTimeout: 240_000,
    // A page that has little of the processor can miss a moment: once more then, and the report names the test.
    retry: 1,
    expect: { poll: { timeout: 60_000, interval: 50 } },
  },
});
