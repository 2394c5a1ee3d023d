import { spawnSync } from "node:child_process";
import type { BrowserContext, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect, it } from "vitest";
import { withClient } from "./client-build";
import { factsOf } from "./facts";
import { program, Server, until } from "./server";
import { theBrowser } from "./shared";
import { type Point, way } from "./ways";

/** It trusts nobody at its machine, as if all came from elsewhere. */
const server = new Server(["--no-local"]);
const contexts: BrowserContext[] = [];
/** The trees of the library: their ids by their names. */
const trees: Record<string, string> = {};

const TABLET = { width: 1194, height: 834 };
const PHONE = { width: 390, height: 844 };

beforeAll(async () => {
  await server.start();
  const { page } = await device("/", TABLET, invite());
  await until("the owner is in", async () => (await factsOf(page)).connection === "connected");
  for (const name of ["Ash", "Oak"]) {
    trees[name] = await page.evaluate(async (name) => {
      const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
      const headers = { "content-type": "application/json" };
      const body = JSON.stringify({ session, name });
      return (await (await fetch("/api/v1/trees", { method: "POST", headers, body })).json()).id;
    }, name);
  }
});
afterAll(() => server.stop());
afterEach(async () => {
  for (const context of contexts.splice(0)) await context.close();
});

/** The secret of a new invitation. */
function invite(...options: string[]): string {
  const { stdout, stderr } = spawnSync(program, ["invite", "--database", server.database, ...options], {
    encoding: "utf8",
  });
  const secret = /\/pair#(\S+)/.exec(stdout)?.[1];
  if (!secret) throw new Error(`no link in ${stdout}${stderr}`);
  return secret;
}

/** A device that was let in by a secret and is shown a path; with it, what it asked for and may not have. */
async function device(path: string, viewport: { width: number; height: number }, secret: string) {
  const browser = await theBrowser();
  // Nothing is looked at here: the fewer pixels the sooner.
  const context = await browser.newContext({
    viewport,
    hasTouch: true,
    isMobile: true,
    deviceScaleFactor: 0.2,
    locale: "en",
  });
  contexts.push(context);
  await context.addInitScript(() => localStorage.setItem("espalier.tour", "true"));
  await withClient(context);
  const page = await context.newPage();
  const refused: string[] = [];
  page.on("response", (answer) => {
    const path = new URL(answer.url()).pathname;
    if (answer.status() === 403) refused.push(`${answer.request().method()} ${path}`);
  });
  await page.request.post(`${server.address}/api/v1/redeem`, { data: { secret } });
  await page.goto(server.address + path);
  return { page, refused };
}

async function openLibrary(page: Page): Promise<void> {
  await page.locator(".tool-bar").getByRole("button", { name: "Library", exact: true }).tap();
  await page.locator(".card").first().waitFor();
}

/** One finger goes along a path. */
async function swipe(page: Page, [from, ...path]: readonly Point[]): Promise<void> {
  const glass = await page.context().newCDPSession(page);
  await glass.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [from!] });
  for (const to of path) await glass.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [to] });
  await glass.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
}

/** Nothing that changes a tree is offered, and one finger turns it. */
async function expectToLook(page: Page): Promise<void> {
  await until("the tree is there", async () => (await factsOf(page)).rows > 0);
  await page.getByText("You may look, not draw").waitFor();
  for (const name of ["Brush", "Lasso", "Undo", "Save", "New", "Architecture"]) {
    expect(await page.getByRole("button", { name, exact: true }).count(), name).toBe(0);
  }
  const strip = page.getByRole("slider");
  const before = await strip.getAttribute("aria-valuenow");
  await swipe(page, way({ x: 200, y: 400 }, { x: 300, y: 400 }));
  await expect.poll(() => strip.getAttribute("aria-valuenow")).not.toBe(before);
  expect((await factsOf(page)).sent).toBe(0);
}

it.each([
  ["a tablet", TABLET],
  ["a phone", PHONE],
])("AC5: who may look at the library alone lands there, on %s", async (_, screen) => {
  const { page, refused } = await device("/", screen, invite("--role", "viewer"));
  await page.getByRole("dialog", { name: "Library" }).waitFor();
  expect(await page.getByRole("button", { name: /^(Open a file|Select|New collection)/ }).count()).toBe(0);
  await page.getByRole("button", { name: "More for Oak" }).tap();
  expect(await page.locator(".card-menu button").allTextContents()).toEqual(["Open", "Versions (1)", "Download…"]);
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Open Oak" }).tap();
  await page.waitForURL(/\/s\//);
  await expectToLook(page);
  expect(refused, "it asks for nothing that a viewer may not have").toEqual([]);
});

it.each([
  ["a tablet", TABLET],
  ["a phone", PHONE],
])("AC5: a guest lands on their tree and asks for nothing else, on %s", async (_, screen) => {
  const { page, refused } = await device("/", screen, invite("--role", "viewer", "--tree", trees.Ash!));
  await page.waitForURL(/\/s\//);
  await expectToLook(page);
  await openLibrary(page);
  expect(await page.locator(".card-name").allTextContents()).toEqual(["Ash"]);
  await page.getByText("You are invited to this tree.").waitFor();
  expect(await page.getByRole("searchbox").count()).toBe(0);
  expect(refused).toEqual([]);
});
