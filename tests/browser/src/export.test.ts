import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { validateBytes } from "gltf-validator";
import { afterAll, beforeAll, expect, it } from "vitest";
import { program } from "./server";

const run = promisify(execFile);
let folder = "";

beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), "espalier-export-"));
});

afterAll(async () => {
  await rm(folder, { recursive: true, force: true });
});

/** A tree as a glTF file. */
async function grown(name: string, options: readonly string[]): Promise<Uint8Array> {
  const file = join(folder, `${name}.glb`);
  await run(program, ["grow", ...options, "--export", file]);
  const bytes = await readFile(file);
  await rm(file);
  return bytes;
}

/** Names of all species, as the program lists them. */
async function species(): Promise<string[]> {
  const { stdout } = await run(program, ["species"]);
  const slugs = stdout.split("\n").map((line) => /^([a-z][a-z-]*)\s/.exec(line)?.[1]);
  return slugs.filter((slug) => slug !== undefined);
}

it("files of every species are glTF without error or warning, says Khronos' validator", async () => {
  const slugs = await species();
  expect(slugs.length).toBeGreaterThan(20);
  for (const slug of slugs) {
    const { issues, info } = await validateBytes(await grown(slug, ["--species", slug, "--author", "Ada"]));
    expect(issues.messages, slug).toEqual([]);
    expect([issues.numErrors, issues.numWarnings], slug).toEqual([0, 0]);
    expect(info.totalTriangleCount, slug).toBeGreaterThan(1000);
    // Wood, and leaves or flowers: each with its textures.
    expect(info.materialCount, slug).toBeGreaterThanOrEqual(2);
    expect(info.resources?.filter((resource) => resource.mimeType === "image/png").length).toBeGreaterThanOrEqual(5);
  }
}, 1_200_000);

/** Each option in one of three files that have as many as go together. */
const TOGETHER = [
  [["--lod", "set", "--hull", "--by-limb", "--quantised"], ["UNUSED_OBJECT"]],
  // The validator does not know these two, and says so as information.
  [
    ["--compressed", "--instanced", "--hull"],
    ["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"],
  ],
  // Bones, weights and light maps cost little of a coarse file.
  [["--sway", "64", "--wind-weights", "--lightmap", "512", "--lod", "2"], ["UNUSED_OBJECT"]],
] as const;

it.each(TOGETHER)(
  "so are files of every species with %j",
  async (options, information) => {
    for (const slug of await species()) {
      const { issues } = await validateBytes(await grown(slug, ["--species", slug, ...options]));
      expect([issues.numErrors, issues.numWarnings], slug).toEqual([0, 0]);
      const codes = new Set(issues.messages.map(({ code }) => code));
      for (const code of codes) expect(information, slug).toContain(code);
    }
  },
  1_200_000,
);

it.each([
  [["--by-limb"], []],
  [["--lod", "1"], []],
  [["--lod", "2"], []],
  // The depths of a billboard belong to no material of glTF.
  [["--lod", "3"], ["UNUSED_OBJECT"]],
  [["--compressed", "--quantised"], ["UNSUPPORTED_EXTENSION"]],
  [["--instanced"], ["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"]],
  [["--sway", "256"], []],
  [["--sway", "64", "--by-limb", "--hull", "--quantised", "--lod", "set"], ["UNUSED_OBJECT"]],
  [["--sway", "1024", "--compressed"], ["UNSUPPORTED_EXTENSION"]],
  // Light is baked later: no material uses the places in light maps.
  [["--wind-weights"], ["UNUSED_OBJECT"]],
  [["--wind-weights", "--sway", "64", "--lightmap", "512", "--quantised", "--lod", "set"], ["UNUSED_OBJECT"]],
  [["--lightmap", "1024"], ["UNUSED_OBJECT"]],
  [["--lightmap", "512", "--lod", "set", "--hull", "--quantised"], ["UNUSED_OBJECT"]],
])(
  "so are files with %j",
  async (options, information) => {
    const { issues } = await validateBytes(await grown("options", ["--species", "cherry", ...options]));
    expect([issues.numErrors, issues.numWarnings]).toEqual([0, 0]);
    expect([...new Set(issues.messages.map(({ code }) => code))].sort()).toEqual(information);
  },
  120_000,
);

it("so is the file of a tree of no species", async () => {
  const { issues } = await validateBytes(await grown("tree", ["--metamers", "500", "--licence", "CC0-1.0"]));
  expect([issues.numErrors, issues.numWarnings]).toEqual([0, 0]);
});
