import { describe, expect, it } from "vitest";
import { savedTree } from "../../../test/saved-tree";
import { MAX_WOOD_BYTES, type SavedTree } from "../../wire/generated";
import { refusal } from "../requests/request";
import { type TreeFile, TreeFiles } from "./tree-files";

const file = (name: string, size = 3): TreeFile => ({ name, size, arrayBuffer: async () => new ArrayBuffer(size) });

/** What is sent, and what is said of it; a file with `bad` in its name is refused. */
function library() {
  const [sent, said, opened]: [string[], string[], SavedTree[]] = [[], [], []];
  const gates: (() => void)[] = [];
  const files = new TreeFiles(async (path, { body }, stop, tell) => {
    sent.push(path);
    tell?.({ bytes: 1, total: (body as Uint8Array).byteLength });
    if (path.includes("slow")) {
      await new Promise<void>((go) => gates.push(go));
      stop?.throwIfAborted();
    }
    if (path.includes("bad")) {
      throw refusal(400, { code: "malformed", reason: "not-a-tree-file", cause: "line 3: no radius", detail: "No." });
    }
    const tree = savedTree({ id: `${sent.length}`, name: new URLSearchParams(path.split("?")[1]).get("name") ?? "" });
    return path.includes("doubt")
      ? { ...tree, import_notes: [{ note: "unknown-species", found: "triffid", message: "No such species." }] }
      : tree;
  });
  const acts: (() => void)[] = [];
  const taking = {
    show: (text: string, action?: { act: () => void }) => {
      said.push(text);
      if (action) acts.push(action.act);
    },
    open: (tree: SavedTree) => void opened.push(tree),
  };
  return { files, take: (...all: TreeFile[]) => files.take(all, taking), sent, said, acts, opened, gates };
}

describe("files", () => {
  it("become trees with the files' names, one after another, which can be opened", async () => {
    const { files, take, sent, said, acts, opened } = library();
    await take(file("Old oak.MTG"), file("a & b.espalier"));
    expect(sent).toEqual([
      "/api/v1/trees/import?name=Old+oak&format=mtg",
      "/api/v1/trees/import?name=a+%26+b&format=espalier",
    ]);
    expect(said).toEqual(["“Old oak” is in the library now", "“a & b” is in the library now"]);
    expect(files.added.value?.name).toBe("a & b");
    acts[0]?.();
    expect(opened[0]?.name).toBe("Old oak");
  });

  it("IM3: that were taken with a doubt say so", async () => {
    const { take, said } = library();
    await take(file("doubt.mtg"));
    expect(said).toEqual([
      "“doubt” is in the library now. No species here is called “triffid”; what the file does not say itself is as usual",
    ]);
  });

  it("IM3: of scans are taken in the units and as the species chosen, and can be taken again otherwise", async () => {
    const { files, take, sent } = library();
    expect(files.scan.value).toBeNull();
    await take(file("oak.espalier"));
    expect(files.scan.value, "a document knows its units").toBeNull();
    await take(file("walnut.mtg"));
    expect(files.scan.value?.name).toBe("walnut.mtg");
    files.units.value = { length: "cm", diameter: "mm/10" };
    await take(file("walnut.mtg"), file("oak.json"));
    files.units.value = { length: "in", diameter: "same" };
    await take(file("ash.csv"));
    files.species.value = "ash";
    await take(file("ash.csv"), file("ash.json"));
    await take(file("birch.csv"));
    expect(sent.slice(1)).toEqual([
      "/api/v1/trees/import?name=walnut&format=mtg",
      "/api/v1/trees/import?name=walnut&format=mtg&unit=0.01&diameter_unit=0.0001",
      "/api/v1/trees/import?name=oak&format=json",
      "/api/v1/trees/import?name=ash&format=csv&unit=0.0254",
      "/api/v1/trees/import?name=ash&format=csv&unit=0.0254&species=ash",
      "/api/v1/trees/import?name=ash&format=json",
      "/api/v1/trees/import?name=birch&format=csv&unit=0.0254",
    ]);
  });

  it("that are refused are named with the reason, and the others go on", async () => {
    const { take, sent, said } = library();
    await take(file("bad.csv"), file("picture.png"), file("huge.json", MAX_WOOD_BYTES + 1), file("good.json"));
    expect(sent.length, "what cannot be a tree is not sent").toBe(2);
    expect(said).toEqual([
      "bad.csv: It cannot become a tree: line 3: no radius.",
      "picture.png: Only files of these kinds become trees: .espalier, .mtg, .csv, .json.",
      "huge.json: The file is larger than 64 MiB.",
      "“good” is in the library now",
    ]);
  });

  it("say how far they are, wait for each other, and stop at once", async () => {
    const { files, take, sent, said, gates } = library();
    const taking = take(file("slow.csv"), file("next.csv"));
    await expect.poll(() => gates.length).toBe(1);
    expect(files.transfer.progress.value).toEqual({ bytes: 1, total: 3 });
    await take(file("other.csv"));
    expect(said).toEqual(["Wait until the file before is in the library."]);
    files.transfer.cancel();
    gates[0]?.();
    await taking;
    expect([sent.length, said.length, files.transfer.progress.value]).toEqual([1, 1, null]);
  });
});
