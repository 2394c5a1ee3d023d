import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { misses } from "./hits";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
let folder = "";

beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), "replay-"));
});
afterAll(() => rm(folder, { recursive: true, force: true }));

/** A tree that two people have grown in turns. */
async function grown(screen: Screen) {
  const { tablet, address } = await workshop.fresh({ ...screen, moves: true });
  await workshop.act(address, [{ kind: "grow", steps: 4 }]);
  await tablet.until("one has grown it", ({ present }) => present === 4);
  await workshop.act(address, [
    { kind: "grow", steps: 3 },
    { kind: "go_to", step: 6 },
  ]);
  await tablet.until(
    "another as well, and goes back a step",
    ({ present, lastStep }) => present === 6 && lastStep === 7,
  );
  return { tablet, address, before: await tablet.untilQuiet() };
}

async function replay(tablet: Tablet): Promise<void> {
  const { page } = tablet;
  const shown = page.getByRole("button", { name: "Replay", exact: true });
  const folded = page.getByRole("button", { name: "Show the timeline" });
  await shown.or(folded).first().waitFor();
  if ((await folded.count()) > 0) await tablet.press(folded);
  await tablet.press(shown);
  await page.locator(".replay").waitFor();
}

const button = (tablet: Tablet, name: string | RegExp) => tablet.page.locator(".replay").getByRole("button", { name });

test.each([
  ["a tablet", LANDSCAPE],
  ["a phone", PHONE],
] as const)("RP1: on %s the design is played from its beginning to where it stands", async (name, screen) => {
  const { tablet, address, before } = await grown(screen);
  const { page } = tablet;
  await replay(tablet);
  expect(await page.locator(".tool-bar").count(), "there is nothing to draw with").toBe(0);
  await tablet.until("it plays by itself, from the beginning", ({ present }) => present < 3);
  await tablet.press(button(tablet, "Pause"));
  await tablet.showNow(`replay-${name}-paused`);
  expect(await misses(tablet, "the replay", ".replay", false), "each control is hit where it is drawn").toEqual([]);
  // Meanwhile somebody goes on in the session.
  await workshop.act(address, [{ kind: "go_to", step: 7 }]);
  await tablet.press(button(tablet, /^Speed/));
  await tablet.press(button(tablet, /^Speed/));
  await button(tablet, "Speed: 4 times").waitFor();
  await tablet.press(button(tablet, "Play"));
  await tablet.until(
    "it ends where the design stood",
    ({ present, metamers }) => present === 6 && metamers === before.metamers,
  );
  await button(tablet, "Play").waitFor();
  await page.locator(".replay-caption").getByText("Growth").waitFor();
  await tablet.show(`replay-${name}-end`);
  // A tap on the line goes there.
  const track = await tablet.boxOf(page.getByRole("slider", { name: "Time" }));
  await tablet.tapAt({ x: track.x + 0.25 * track.width, y: track.y + track.height / 2 });
  await tablet.until("a tap goes there", ({ present }) => present === 4);
  await tablet.press(button(tablet, "Back to the tree"));
  await page.locator(".tool-bar").waitFor();
  await tablet.until(
    "the session goes on where it is",
    ({ present, sent, acknowledged }) => present === 7 && sent === acknowledged,
  );
});

/** Asks for a recording of a replay of a small tree, and gives the form; on a page without an encoder if there is to be none. */
async function recording({ encodes }: { encodes: boolean }) {
  // A phone that lies: pictures are as wide as on any glass, and low.
  const { tablet } = await grown({ width: 844, height: 390, detail: 0.2 });
  const { page } = tablet;
  if (!encodes) {
    // As on a page that came by http from another machine.
    await page.addInitScript(() => Reflect.deleteProperty(globalThis, "VideoEncoder"));
    await page.reload();
    await tablet.untilReady();
  }
  await replay(tablet);
  const form = page.getByRole("form", { name: "Save as a video or pictures" });
  const record = async (kind: string) => {
    await form.getByRole("radio", { name: kind }).check();
    await form.getByRole("radio", { name: "5 s", exact: true }).check();
    const saved = await tablet.download(form.getByRole("button", { name: "Record" }));
    const file = join(folder, kind);
    await saved.saveAs(file);
    return await readFile(file);
  };
  await tablet.press(button(tablet, "Save as a video or pictures"));
  await until(
    "it is known what can be encoded",
    async () => !(await form.getByRole("button", { name: "Record" }).isDisabled()),
  );
  return { tablet, form, record };
}

const PICTURES = "Pictures (PNG in a ZIP file)";
const NO_VIDEO = "This browser encodes no video here";

function expectPictures(archive: Buffer): void {
  expect(archive.subarray(0, 4)).toEqual(Buffer.from("PK\u0003\u0004"));
  // The end of a ZIP file says how many files it holds: five seconds, and one and a half of the last picture.
  expect(archive.readUInt16LE(archive.length - 12)).toBe(24 * 6.5);
}

test("a replay is saved as a video where the browser says that it encodes one", async () => {
  const { tablet, form, record } = await recording({ encodes: true });
  await tablet.show("replay-record");
  // What the browser itself says, of the size that the form offers first.
  const encodes = await tablet.page.evaluate(async () => {
    if (!("VideoEncoder" in globalThis)) return false;
    const size = { width: 1280, height: 592, bitrate: 4e6, framerate: 24 };
    const answers = ["avc1.640028", "vp09.00.40.08", "vp8"].map((codec) =>
      VideoEncoder.isConfigSupported({ codec, ...size }).then(
        ({ supported }) => supported === true,
        () => false,
      ),
    );
    return (await Promise.all(answers)).includes(true);
  });
  const offers = {
    video: await form.getByRole("radio", { name: "Video" }).count(),
    none: await form.getByText(NO_VIDEO).count(),
  };
  expect(offers).toEqual(encodes ? { video: 1, none: 0 } : { video: 0, none: 1 });
  if (!encodes) return;
  const video = await record("Video");
  const isMp4 = video.subarray(4, 8).toString() === "ftyp";
  const isWebM = video.readUInt32BE(0) === 0x1a45dfa3;
  expect(isMp4 || isWebM).toBe(true);
  expect(video.length).toBeGreaterThan(2000);
});

test("where no video can be encoded, the page says why, and pictures are saved", async () => {
  const { tablet, form, record } = await recording({ encodes: false });
  await form.getByText(NO_VIDEO).waitFor();
  await tablet.show("replay-record-no-video");
  expect(await form.getByRole("radio", { name: "Video" }).count()).toBe(0);
  expectPictures(await record(PICTURES));
});
