import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { chosen, type Entry, FOLDER, query, readCatalogue, readScript, scriptOf, treesOf } from "../gallery/catalogue";
import { packed } from "../gallery/loop";
import { readOrder } from "../gallery/order";
import { DRAFT, Player } from "../gallery/player";
import { becameTree, changed, colours, Darkroom } from "./picture";
import { program } from "./server";
import { theBrowser, theServer } from "./shared";

const ENTRY: Entry = { name: "test", seed: 5, shot: { yaw: 20, width: 600, height: 600 } };
const GROWN = ['{"kind":"grow","steps":9}'];
const grown = (...commands: string[]) => ({ seed: ENTRY.seed, commands });

describe("the gallery", () => {
  it("has a script, a picture and a sentence for each sketch", async () => {
    const page = await readFile(join(FOLDER, "README.md"), "utf8");
    const entries = await readCatalogue();
    expect(entries.length).toBeGreaterThanOrEqual(26);
    expect(new Set(entries.map(({ name }) => name)).size).toBe(entries.length);
    for (const entry of entries) {
      const { name } = entry;
      for (const tree of treesOf(entry)) {
        const commands = (await readScript(tree)).map((line) => JSON.parse(line) as { kind?: string });
        expect(commands.length, tree.script).toBeGreaterThan(1);
        expect(commands.every(({ kind }) => typeof kind === "string")).toBe(true);
      }
      expect(existsSync(join(FOLDER, `${name}.jpg`)), `${name}.jpg`).toBe(true);
      expect(page, name).toContain(`](${name}.jpg)`);
    }
  });

  it("has sketches that grow without a browser", async () => {
    const run = promisify(execFile);
    // Several pictures show what one script grows.
    const trees = (await readCatalogue()).flatMap(treesOf);
    const seeds = new Map(trees.map((tree) => [scriptOf(tree), tree.seed]));
    for (const [script, seed] of seeds) {
      const { stdout } = await run(program, ["replay", script, "--seed", String(seed), "--stats", "json"]);
      expect((JSON.parse(stdout) as { metamers_alive: number }).metamers_alive, script).toBeGreaterThan(500);
    }
  });

  it("has at least twenty sketches that a hand drew", async () => {
    const drawn = new Set<string>();
    for (const tree of (await readCatalogue()).flatMap(treesOf)) {
      const isDrawn = (await readScript(tree)).some((line) => /"kind":"(stroke_move|lasso)"/.test(line));
      if (isDrawn) drawn.add(scriptOf(tree));
    }
    expect(drawn.size).toBeGreaterThanOrEqual(20);
  });

  it("reads which sketches, how and whereto", () => {
    expect(readOrder([], "/here")).toEqual({ names: [], draft: false, out: FOLDER });
    expect(readOrder(["oak", "--draft", "--out", "there"], "/here")).toEqual({
      names: ["oak"],
      draft: true,
      out: "/here/there",
    });
    expect(() => readOrder(["--drift"], "/here")).toThrow("--drift");
  });

  it("plays what is asked for, and knows what there is", () => {
    const entries = ["oak", "swan"].map((name) => ({ ...ENTRY, name }));
    expect(chosen(entries, [])).toEqual(entries);
    expect(chosen(entries, ["swan"]).map(({ name }) => name)).toEqual(["swan"]);
    expect(() => chosen(entries, ["yew"])).toThrow("no such sketch: yew; there are oak, swan");
    expect(query({ yaw: 20, zoom: 1.5, width: 600, height: 600 })).toBe("?yaw=20&zoom=1.5");
  });
});

describe("the player", () => {
  let browser: Browser;
  let player: Player;
  let darkroom: Darkroom;

  beforeAll(async () => {
    browser = await theBrowser();
    player = await Player.open(theServer(), browser, DRAFT);
    darkroom = await Darkroom.open(browser);
  });

  afterAll(() => browser?.close());

  it("shows the tree of a script and nothing else", async () => {
    const bare = await darkroom.develop(await player.play(ENTRY, [grown('{"kind":"grow","steps":1}')]));
    const tree = await darkroom.develop(await player.play(ENTRY, [grown(...GROWN)]));
    expect([tree.width, tree.height]).toEqual([300, 300]);
    expect(colours(tree)).toBeGreaterThan(20);
    expect(becameTree(bare, tree, { x: 90, y: 60, width: 120, height: 120 })).toBeGreaterThan(0.2);
    // Where the bars of the interface lie there is only sky.
    expect(changed(bare, tree, { x: 0, y: 0, width: 300, height: 20 })).toBe(0);
  });

  it("puts the tree before its last operations beside it", async () => {
    const entry = { ...ENTRY, undone: 1 };
    const both = await darkroom.develop(await player.play(entry, [grown('{"kind":"grow","steps":4}', ...GROWN)]));
    expect(both.width).toBeGreaterThan(600);
    expect(both.height).toBe(300);
  });

  it("puts trees beside each other in rows", async () => {
    const beside = { row: 2, trees: [] };
    const trees = [GROWN, GROWN, GROWN].map((commands) => grown(...commands));
    const sheet = await darkroom.develop(await player.play({ ...ENTRY, beside }, trees));
    expect(sheet.width).toBeGreaterThan(600);
    expect(sheet.height).toBe(sheet.width);
  });

  it("packs pictures one after the other, as browsers unpack them", async () => {
    const pictures = await player.blank.evaluate(() =>
      ["red", "lime", "blue"].map((colour) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [37, 20];
        const context = canvas.getContext("2d", { alpha: false })!;
        context.fillStyle = colour;
        context.fillRect(0, 0, 37, 20);
        return canvas.toDataURL("image/webp", 0.8).split(",")[1] ?? "";
      }),
    );
    const milliseconds = 1000 / 12;
    const frames = pictures.map((base64) => ({ webp: Buffer.from(base64, "base64"), milliseconds }));
    const file = packed(37, 20, frames).toString("base64");
    const seen = await player.blank.evaluate(async (base64) => {
      const data = await (await fetch(`data:image/webp;base64,${base64}`)).arrayBuffer();
      const decoder = new ImageDecoder({ data, type: "image/webp" });
      await decoder.tracks.ready;
      const { frameCount = 0, repetitionCount } = decoder.tracks.selectedTrack ?? {};
      const seen: { size: string; colour: string; lasts: number }[] = [];
      for (let frameIndex = 0; frameIndex < frameCount; frameIndex += 1) {
        const { image } = await decoder.decode({ frameIndex });
        const canvas = new OffscreenCanvas(1, 1);
        const context = canvas.getContext("2d")!;
        context.drawImage(image, 0, 0);
        const [r = 0, g = 0, b = 0] = context.getImageData(0, 0, 1, 1).data;
        const colour = r > 200 ? "red" : g > 200 ? "lime" : b > 200 ? "blue" : "none";
        const size = `${image.displayWidth} × ${image.displayHeight}`;
        seen.push({ size, colour, lasts: (image.duration ?? 0) / 1000 });
      }
      return { seen, endless: repetitionCount === Number.POSITIVE_INFINITY };
    }, file);
    expect(seen.endless).toBe(true);
    expect(seen.seen.map(({ size, colour }) => `${size} ${colour}`)).toEqual([
      "37 × 20 red",
      "37 × 20 lime",
      "37 × 20 blue",
    ]);
    expect(seen.seen.reduce((sum, { lasts }) => sum + lasts, 0)).toBe(250);
  });

  it("names the line that could not be done", async () => {
    const lines = [...GROWN, '{"kind":"prune","rows":[99999]}'];
    await expect(player.play(ENTRY, [grown(...lines)])).rejects.toThrow(/^line 2: .*not_found/);
  });
});
