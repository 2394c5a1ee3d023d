import { spawnSync } from "node:child_process";
import { mkdir } from "node:fs/promises";
import { join } from "node:path";
import type { BrowserContext, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { screenshots } from "./browser";
import { withClient } from "./client-build";
import { factsOf } from "./facts";
import { program, Server, until } from "./server";
import { theBrowser } from "./shared";

/** It trusts nobody at its machine, as if all came from elsewhere. */
const server = new Server(["--no-local"]);
const contexts: BrowserContext[] = [];

beforeAll(() => server.start());
afterAll(() => server.stop());
afterEach(async () => {
  for (const context of contexts.splice(0)) await context.close();
});

/** The secret of the first link in what was printed. */
function secretIn(printed: string): string {
  const secret = /\/pair#(\S+)/.exec(printed)?.[1];
  if (!secret) throw new Error(`no link in ${printed}`);
  return secret;
}

function invite(...options: string[]): string {
  const done = spawnSync(program, ["invite", "--database", server.database, ...options], { encoding: "utf8" });
  expect(done.stderr).toBe("");
  return done.stdout;
}

/** A device that was never here. */
async function device(path: string, options: { width?: number; height?: number; locale?: string } = {}): Promise<Page> {
  const { width = 1194, height = 834, locale = "en" } = options;
  const browser = await theBrowser();
  const context = await browser.newContext({ viewport: { width, height }, hasTouch: true, isMobile: true, locale });
  contexts.push(context);
  await withClient(context);
  const page = await context.newPage();
  await page.goto(`${server.address}${path}`);
  return page;
}

async function untilConnected(page: Page): Promise<void> {
  await page.waitForURL(/\/s\//);
  await until("the page connects", async () => (await factsOf(page)).connection === "connected");
}

describe("the door", () => {
  it("AC3: opens to the printed link, once, and keeps its secret out of the address", async () => {
    await until("the link is printed", () => server.printed.includes("Ctrl+C"));
    const secret = secretIn(server.printed);
    const page = await device(`/pair#${secret}`);
    await untilConnected(page);
    expect(page.url()).not.toContain(secret);
    await page.reload();
    await untilConnected(page);

    const late = await device(`/pair#${secret}`);
    await late.getByText("This code was used already", { exact: false }).waitFor();
    expect(late.url()).toBe(`${server.address}/pair`);
  });

  it.each([
    ["tablet", { width: 1194, height: 834 }, "You need an invitation", "Link or code", "Come in"],
    ["phone", { width: 360, height: 640, locale: "de" }, "Du brauchst eine Einladung", "Link oder Code", "Eintreten"],
  ])("AC2: asks whoever knocks for the code, on a %s", async (name, screen, title, field, enter) => {
    const owner = await device(`/pair#${secretIn(invite())}`);
    await untilConnected(owner);
    const address = new URL(owner.url()).pathname;

    const page = await device(address, screen);
    await page.getByRole("heading", { name: title }).waitFor();
    await mkdir(screenshots, { recursive: true });
    await page.screenshot({ path: join(screenshots, `entry-${name}.png`) });
    const button = page.getByRole("button", { name: enter });
    expect(await button.isDisabled()).toBe(true);
    await page.getByLabel(field).fill("of-nobody");
    await button.tap();
    await page.getByRole("alert").waitFor();
    await page.screenshot({ path: join(screenshots, `entry-${name}-refused.png`) });
    await page.getByLabel(field).fill(`http://192.168.1.7:7700/pair#${secretIn(invite("--role", "viewer"))}`);
    await button.tap();
    await untilConnected(page);
    expect(new URL(page.url()).pathname).toBe(address);
  });

  it("AC2: is used to its end by a finger on glass that is lower than what it asks", async () => {
    const screen = { width: 844, height: 330 };
    const page = await device("/pair", screen);
    const button = page.getByRole("button", { name: "Come in" });
    const end = async () => {
      const box = await button.boundingBox();
      return box === null ? Number.POSITIVE_INFINITY : box.y + box.height;
    };
    await button.waitFor();
    expect(await end()).toBeGreaterThan(screen.height);
    expect((await page.locator(".entry-card").boundingBox())?.y, "its top is in view").toBeGreaterThanOrEqual(0);
    const glass = await page.context().newCDPSession(page);
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", touchPoints: { x: number; y: number }[]) =>
      glass.send("Input.dispatchTouchEvent", { type, touchPoints });
    await touch("touchStart", [{ x: 100, y: 300 }]);
    for (let y = 290; y >= 10; y -= 10) await touch("touchMove", [{ x: 100, y }]);
    await touch("touchEnd", []);
    await expect.poll(end).toBeLessThanOrEqual(screen.height);
  });

  it("AC9: asks for name and password where anybody has one, and the settings lead out again", async () => {
    const added = spawnSync(program, ["user", "add", "Ada", "--database", server.database], {
      input: "correct horse",
      encoding: "utf8",
    });
    expect(added.stderr).toBe("");
    const page = await device("/");
    await page.getByRole("heading", { name: "Log in" }).waitFor();
    await page.screenshot({ path: join(screenshots, "entry-login.png") });
    await page.getByLabel("Name").fill("Ada");
    await page.getByLabel("Password").fill("guess");
    await page.getByRole("button", { name: "Log in", exact: true }).tap();
    await page.getByRole("alert").waitFor();
    await page.screenshot({ path: join(screenshots, "entry-login-refused.png") });
    await page.getByLabel("Password").fill("correct horse");
    await page.getByRole("button", { name: "Log in", exact: true }).tap();
    await untilConnected(page);
    await page.getByRole("button", { name: "Settings" }).tap();
    await page.getByText("Logged in as Ada (may draw and save)").waitFor();
    await page.screenshot({ path: join(screenshots, "settings-account.png") });
    await page.getByRole("button", { name: "Log out" }).tap();
    await page.getByRole("heading", { name: "Log in" }).waitFor();
    await page.getByRole("button", { name: "I have a link or a code" }).tap();
    await page.getByLabel("Link or code").waitFor();
    const removed = spawnSync(program, ["user", "remove", "Ada", "--database", server.database]);
    expect(removed.status).toBe(0);
  });

  it("AC4: closes behind whoever is let out", async () => {
    const page = await device(`/pair#${secretIn(invite("--name", "lost"))}`);
    await untilConnected(page);
    await page.getByRole("button", { name: "Settings" }).tap();
    await page.getByText("Let in as lost (may draw, save and delete)").waitFor();
    await page.getByText("Who logs out here needs a new invitation to come back.").waitFor();
    const { status } = spawnSync(program, ["device", "revoke", "lost", "--database", server.database]);
    expect(status).toBe(0);
    await page.getByRole("heading", { name: "You need an invitation" }).waitFor();
  });
});
