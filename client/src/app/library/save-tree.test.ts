import { afterEach, expect, it, vi } from "vitest";
import { MAX_THUMBNAIL_BYTES } from "../../wire/generated";
import { type SavedFrom, saveAsNew } from "./save-tree";

afterEach(() => vi.unstubAllGlobals());

/** The picture that is sent where those of a size have so many bytes. */
async function sent(bytes: (size: number) => number): Promise<string | undefined> {
  let body: { thumbnail?: string } = {};
  vi.stubGlobal("fetch", async (_: string, request: RequestInit) => {
    body = JSON.parse(String(request.body));
    return Response.json({});
  });
  const url = (size: number) => `data:image/webp;base64,${Buffer.alloc(bytes(size)).toString("base64")}`;
  await saveAsNew(
    {
      stage: { thumbnail: async (size: number) => url(size) },
      unsaved: { saved: () => undefined },
      trees: { call: () => undefined },
      settings: { author: { peek: () => "" } },
    } as unknown as SavedFrom,
    "oak",
    "Oak",
  );
  return body.thumbnail;
}

it("sends the largest picture that the server takes", async () => {
  const largest = await sent(() => MAX_THUMBNAIL_BYTES);
  expect(Buffer.from(largest?.split(",")[1] ?? "", "base64").length).toBe(MAX_THUMBNAIL_BYTES);
});

it("sends a smaller picture, or none, where one would be refused", async () => {
  const smaller = await sent((size) => (size > 256 ? MAX_THUMBNAIL_BYTES + 1 : 300));
  expect(Buffer.from(smaller?.split(",")[1] ?? "", "base64").length).toBe(300);
  expect(await sent(() => MAX_THUMBNAIL_BYTES + 1)).toBeUndefined();
});
