import type { BrowserContext, Page } from "playwright-core";
import { afterEach, describe, expect, it } from "vitest";
import { withClient } from "./client-build";
import { factsOf } from "./facts";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { type Server, until } from "./server";
import { theBrowser } from "./shared";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop: Workshop<Server> = Workshop.withItsOwnServer();
const contexts: BrowserContext[] = [];

afterEach(async () => {
  for (const context of contexts.splice(0)) await context.close();
});

/** A tablet with a tree that is saved under a name. */
async function withTree(name: string, screen: Screen): Promise<Tablet> {
  const { tablet, address } = await workshop.fresh(screen);
  await workshop.act(address, [{ kind: "grow", steps: 3 }]);
  await tablet.until("it has grown", ({ metamers }) => metamers > 0);
  await tablet.untilQuiet();
  await tablet.page.evaluate(async (name) => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const headers = { "content-type": "application/json" };
    await fetch("/api/v1/trees", { method: "POST", headers, body: JSON.stringify({ session, name }) });
  }, name);
  return tablet;
}

/** Opens what shares a tree, from its card. */
async function shareFromLibrary(tablet: Tablet, name: string): Promise<void> {
  const { page } = tablet;
  await press(tablet, "Library");
  await page.getByRole("button", { name: `More for ${name}`, exact: true }).tap();
  await page.locator(".card-menu").getByRole("button", { name: "Share by link…" }).tap();
  await page.getByText("Nobody has been invited").waitFor();
}

/** Opens a link on a device that was never here, and that is not let in for being at the machine. */
async function visit(link: string): Promise<Page> {
  const browser = await theBrowser();
  const context = await browser.newContext({
    viewport: { width: 600, height: 500 },
    // A proxy passes the request on, as far as the server knows.
    extraHTTPHeaders: { via: "1.1 test" },
  });
  contexts.push(context);
  await withClient(context);
  const page = await context.newPage();
  await page.goto(link);
  return page;
}

const linkOf = async (page: Page) => page.getByLabel("Link that lets one device in").inputValue();
const rows = (page: Page) => page.locator(".link-row");

describe("sharing a tree", () => {
  it.each<[string, Screen]>([
    ["tablet", LANDSCAPE],
    ["phone", PHONE],
  ])("AC12: a link made on a %s lets one device in to look, and is revoked", async (name, screen) => {
    const tree = `Oak on a ${name}`;
    const tablet = await withTree(tree, screen);
    const { page } = tablet;
    await shareFromLibrary(tablet, tree);
    await tablet.show(`share-form-${name}`);
    await page.getByRole("radio", { name: "30 days" }).check();
    await page.getByLabel("For whom (optional)").fill("Ann");
    await page.getByRole("button", { name: "Make a link" }).tap();
    await page.getByText("For Ann, to look.").waitFor();
    await page.getByText("Others cannot reach this link", { exact: false }).waitFor();
    await page.getByRole("img", { name: "The link as a QR code" }).waitFor();
    await rows(page).getByText("not used yet", { exact: false }).waitFor();
    const days = await page.evaluate(async () => {
      const { trees } = await (await fetch("/api/v1/trees?limit=1")).json();
      const [{ until, role }] = await (await fetch(`/api/v1/trees/${trees[0].id}/links`)).json();
      return [role, Math.round((Date.parse(until) - Date.now()) / 86_400_000)];
    });
    expect(days).toEqual(["viewer", 30]);
    await tablet.show(`share-link-${name}`);
    const guest = await visit(await linkOf(page));
    await guest.waitForURL(/\/s\//);
    await guest.getByText("You may look, not draw").waitFor();
    // Whoever shows the code sees that it has worked.
    await page.getByText("Ann is in.").waitFor();
    await rows(page).getByText("Came in", { exact: false }).waitFor();
    await tablet.show(`share-came-${name}`);
    await page.getByRole("button", { name: "Revoke the link of Ann" }).tap();
    await page.getByRole("button", { name: "Keep", exact: true }).tap();
    expect(await rows(page).count(), "it is asked about once").toBe(1);
    await page.getByRole("button", { name: "Revoke the link of Ann" }).tap();
    await tablet.show(`share-revoke-${name}`);
    await page.getByRole("button", { name: "Revoke", exact: true }).tap();
    await page.getByText("Nobody has been invited").waitFor();
    await expect.poll(() => guest.evaluate(async () => (await fetch("/api/v1/me")).status)).toBe(401);
    await page.getByRole("button", { name: "To the library" }).tap();
    await page.getByRole("dialog", { name: "Library" }).waitFor();
  });

  it("the tree on the page is shared once it is saved, and guests may draw", async () => {
    const { tablet, address } = await workshop.fresh(PHONE);
    const { page } = tablet;
    await workshop.act(address, [{ kind: "grow", steps: 3 }]);
    await tablet.untilQuiet();
    await press(tablet, "Share");
    await page.getByText("A tree that is saved can be shown", { exact: false }).waitFor();
    await page.getByRole("button", { name: "Save tree" }).tap();
    await page.getByLabel("Name", { exact: true }).fill("Elm");
    await page.getByRole("dialog", { name: "Save this tree" }).getByRole("button", { name: "Save tree" }).tap();
    await page.getByRole("dialog").waitFor({ state: "detached" });
    await press(tablet, "Share");
    await page.getByText("Nobody has been invited").waitFor();
    await page.getByRole("radio", { name: "Draw and save" }).check();
    await page.getByRole("radio", { name: "As long as they come" }).check();
    await page.getByRole("button", { name: "Make a link" }).tap();
    await page.getByText("For Guest, to draw.").waitFor();
    const guest = await visit(await linkOf(page));
    await guest.waitForURL(/\/s\//);
    await until("the guest is in", async () => (await factsOf(guest)).connection === "connected");
    expect(new URL(guest.url()).pathname).toBe(new URL(address).pathname);
    // Who is invited to a tree does not invite others to it.
    await guest.locator(".tool-bar").getByRole("button", { name: "More", exact: true }).click();
    await guest.getByRole("button", { name: "Share", exact: true }).click();
    await guest.getByLabel("Link to this tree").waitFor();
    expect(await guest.getByText("Invite to this tree").count()).toBe(0);
  });

  it("a link is copied also where the clipboard is closed, and handed on where the device can", async () => {
    const tablet = await withTree("Ash", LANDSCAPE);
    const { page } = tablet;
    // As on plain http.
    await page.evaluate(() => {
      Object.defineProperty(navigator, "clipboard", { value: undefined });
      Object.defineProperty(navigator, "share", { value: undefined, configurable: true });
      document.addEventListener("copy", () => {
        document.title = String(getSelection() ?? "") || (document.activeElement as HTMLInputElement).value;
      });
    });
    await press(tablet, "Share");
    const link = page.getByLabel("Link to this tree");
    await link.waitFor();
    expect(await page.getByRole("button", { name: "Send…" }).count()).toBe(0);
    await page.getByRole("button", { name: "Copy link" }).tap();
    await page.getByText("Link copied", { exact: true }).waitFor();
    expect(await page.title()).toBe(await link.inputValue());
    await page.keyboard.press("Escape");
    await page.evaluate(() => {
      Object.defineProperty(navigator, "canShare", { value: () => true });
      Object.defineProperty(navigator, "share", {
        value: async ({ url }: { url: string }) => {
          document.title = `sent ${url}`;
        },
      });
    });
    await page.getByRole("dialog").waitFor({ state: "detached" });
    await press(tablet, "Share");
    await page.getByRole("button", { name: "Send…" }).tap();
    await expect.poll(() => page.title()).toBe(`sent ${await link.inputValue()}`);
  });

  it("says why links are not known, and asks again", async () => {
    const tablet = await withTree("Yew", LANDSCAPE);
    const { page } = tablet;
    await page.route("**/links", (route) => route.abort());
    await press(tablet, "Share");
    await page.getByRole("alert").getByText("The server does not answer", { exact: false }).waitFor();
    await tablet.show("share-silent");
    await page.unroute("**/links");
    await page.getByRole("button", { name: "Try again" }).tap();
    await page.getByText("Nobody has been invited").waitFor();
    // The browser writes down each request that is cut off.
    tablet.errors.length = 0;
  });
});
