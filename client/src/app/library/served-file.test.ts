import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Progress } from "../requests/transfer";
import { servedFile } from "./served-file";

const PIECE = new Uint8Array(1000);

/** A server that says how far a file is and sends it in two pieces, the second when it is told to. */
function server(length: string | null): () => void {
  let finish = () => {};
  const promise = new Promise<void>((resolve) => {
    finish = resolve;
  });
  const headers: HeadersInit = length === null ? {} : { "content-length": length };
  vi.stubGlobal("fetch", async (path: string) => {
    if (path.includes("/exports/")) {
      return Response.json({ written: 1500, expected: 3000, ahead: 0 });
    }
    const body = new ReadableStream({
      async start(controller) {
        controller.enqueue(PIECE);
        await promise;
        controller.enqueue(PIECE);
        controller.close();
      },
    });
    return new Response(body, { headers });
  });
  return () => finish();
}

beforeEach(() => {
  vi.useFakeTimers();
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

async function told(length: string | null): Promise<Progress[]> {
  const finish = server(length);
  const all: Progress[] = [];
  const file = servedFile("/api/v1/sessions/a", "usda", new Map(), new AbortController().signal, (progress) =>
    all.push(progress),
  );
  await vi.advanceTimersByTimeAsync(1100);
  finish();
  expect((await file).size).toBe(2000);
  await vi.advanceTimersByTimeAsync(5000);
  return all;
}

test("a file that is sent while it is made is as far as the server says", async () => {
  const all = await told(null);
  expect(all).toEqual([
    { bytes: 1500, total: 3000, isMaking: true, ahead: 0 },
    { bytes: 1500, total: 3000, isMaking: true, ahead: 0 },
  ]);
});

test("a file that is whole is as far as it has come", async () => {
  const all = await told("2000");
  expect(all).toEqual([
    { bytes: 1000, total: 2000 },
    { bytes: 2000, total: 2000 },
  ]);
});
