import { execFileSync } from "node:child_process";
import { expect, test } from "vitest";
import { perform } from "../gallery/performance";
import { LANDSCAPE, type Screen } from "./screens";
import { program, until } from "./server";
import { KEEPING, sideBySide } from "./side-by-side";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { type Point, way } from "./ways";
import { seedling, Workshop } from "./workshop";

// People log in: on a server of one's own whoever sits at it would be the same person on both pages.
const workshop = Workshop.withItsOwnServer(["--auth"]);

/** Drawn all the time, so that pins are where the wood is. */
function seen(screen: Screen): Screen {
  return { ...screen, detail: 0.6, watched: true };
}

/** A link that lets in Ann, who owns the server. */
function invitation(): string {
  const { database, address } = workshop.server;
  const options = ["--role", "owner", "--name", "Ann", "--database", database, "--url", address];
  const printed = execFileSync(program, ["invite", ...options], { encoding: "utf8" });
  const link = /http:\/\/\S+\/pair#\S+/.exec(printed)?.[0];
  if (!link) throw new Error(`there is no link in ${printed}`);
  return link;
}

/** Ann's page with a tree on it, places about its stem, and a link for Bo. */
async function anns(screen: Screen) {
  const ann = await workshop.open(invitation(), seen(screen));
  await ann.page.getByLabel("Brush radius", { exact: true }).focus();
  await ann.page.keyboard.press("Home");
  const seed = await seedling(ann);
  const scale = Math.min(1, seed.x / 320);
  const at = (right: number, up: number): Point => ({ x: seed.x + scale * right, y: seed.y - scale * up });
  await ann.swipe([way(at(0, 0), at(0, 300))]);
  await ann.untilQuiet();
  const session = ann.page.url().slice(ann.page.url().lastIndexOf("/") + 1);
  await perform(ann.page, session, ['{"kind":"grow","steps":8}']);
  const link = await ann.page.evaluate(async (session) => {
    const post = async (path: string, body: object) => {
      const headers = { "content-type": "application/json" };
      return await (await fetch(path, { method: "POST", headers, body: JSON.stringify(body) })).json();
    };
    const tree = await post("/api/v1/trees", { session, name: "Oak by the gate" });
    return (await post(`/api/v1/trees/${tree.id}/links`, { role: "editor", name: "Bo" })).url as string;
  }, session);
  return { ann, link, at };
}

/** Where the pin of the first thread is on a page, once it rests there. */
async function pinOn(tablet: Tablet): Promise<Point> {
  await tablet.page.locator('.comment-pin[data-shown="true"][data-thread="1"]').waitFor({ state: "attached" });
  await tablet.untilStill();
  return tablet.page.evaluate(() => {
    const button = document.querySelector<HTMLElement>('.comment-pin[data-thread="1"] button');
    const place = /^(-?[\d.]+)px (-?[\d.]+)px$/.exec(button?.style.translate ?? "");
    return { x: Number(place?.[1]), y: Number(place?.[2]) };
  });
}

// The walk of docs/review.md, which takes minutes where the processor draws: it is walked when its pictures are taken.
test.runIf(KEEPING).each<[string, Screen, Screen]>([["tablets", LANDSCAPE, LANDSCAPE]])(
  "two review a tree in one room, on %s",
  async (name, annsScreen, bosScreen) => {
    const picture = (step: string) =>
      sideBySide(`${name}-${step}`, [
        ["Ann", ann],
        ["Bo", bo],
      ]);
    const { ann, link, at } = await anns(annsScreen);
    const bo = await workshop.open(link, seen(bosScreen));
    for (const page of [ann, bo]) {
      await until("the other one is shown", async () => (await page.page.locator(".people-chip").count()) === 1);
    }
    await ann.untilQuiet();
    await ann.untilStill();

    // Ann draws: Bo sees her name, her brush and the tree grow.
    await ann.lead([way(at(0, 250), at(110, 370))]);
    await bo.page.locator('.companion[data-shown="true"]').waitFor({ state: "attached" });
    await picture("1-presence");
    await ann.touch("touchEnd", []);
    await ann.untilQuiet();

    // Bo follows her.
    await bo.press(bo.page.locator(".people-chip"));
    await bo.press(bo.page.locator(".people").getByRole("button", { name: "Follow" }));
    await bo.page.locator("[data-following]").waitFor();
    await ann.page.getByRole("slider", { name: "Turn the tree" }).focus();
    await ann.page.keyboard.press("PageUp");
    const turned = async ({ page }: Tablet) =>
      Number(await page.getByRole("slider", { name: "Turn the tree" }).getAttribute("aria-valuenow"));
    await until("it has turned", async () => Math.abs(await turned(ann)) > 5);
    await ann.untilStill();
    await until("both see the same side", async () => Math.abs((await turned(ann)) - (await turned(bo))) <= 1);
    await bo.untilStill();
    await picture("2-follow");
    await bo.press(bo.page.locator("[data-following]").getByRole("button", { name: "Stop" }));
    await ann.page.keyboard.press("PageDown");
    await ann.untilStill();

    // She comments on a place, for Bo.
    await press(ann, "Comments");
    await ann.press(ann.page.getByRole("button", { name: "Comment on a place" }));
    await ann.page.locator(".comment-glass[data-placing]").waitFor();
    await ann.untilStill();
    const trunk = await ann.page.evaluate(() => {
      const { left, top, width } = document.querySelector("#workspace")!.getBoundingClientRect();
      return { x: left + width / 2, y: top };
    });
    // The panel has moved the tree aside; its trunk stays in the middle of the picture.
    await until("the place is on wood", async () => {
      if ((await ann.page.locator(".comment-compose").count()) > 0) return true;
      await ann.tapAt({ x: trunk.x, y: at(0, 90).y });
      return false;
    });
    const words = ann.page.getByLabel("What you want to say");
    await words.fill("Could this limb come lower? ");
    await words.pressSequentially("@");
    await ann.press(ann.page.getByRole("button", { name: "@Bo", exact: true }));
    await expect.poll(() => words.inputValue()).toBe("Could this limb come lower? @Bo ");
    await ann.press(ann.page.getByRole("button", { name: "Send" }));
    await ann.page.locator(".mention", { hasText: "@Bo" }).waitFor();
    // Bo is told that something is for him.
    await bo.page.locator('.unread[data-me="true"]').first().waitFor();
    await pinOn(bo);
    await picture("3-comment");
    await bo.press(bo.page.locator('.comment-pin[data-thread="1"] button'));
    await bo.page.locator('.mention[data-me="true"]').waitFor();
    await until("it is read", async () => (await bo.page.locator(".unread").count()) === 0);
    await bo.press(bo.page.getByRole("button", { name: "Answer" }));
    await bo.page.getByLabel("What you want to say").fill("I will draw one.");
    await bo.press(bo.page.getByRole("button", { name: "Send" }));
    await ann.page.locator(".comment-text", { hasText: "I will draw one." }).waitFor();
    await picture("4-answer");
  },
  900_000,
);
