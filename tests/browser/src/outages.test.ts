import { describe, expect, it } from "vitest";
import { changed } from "./picture";
import { SMALL } from "./screens";
import { inTime, until } from "./server";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

describe("without a server", () => {
  it("the page opens all the same, says so, and finds it again", async () => {
    const { tablet, address } = await workshop.fresh({ ...SMALL, kept: true });
    await tablet.page.evaluate(async () => {
      await navigator.serviceWorker.ready;
    });
    const kept = await tablet.page.evaluate(async () => {
      const names = await caches.keys();
      const paths = await Promise.all(
        names.map(async (name) => (await (await caches.open(name)).keys()).map(({ url }) => new URL(url).pathname)),
      );
      return paths.flat();
    });
    expect(kept).toContain("/");
    expect(kept.some((path) => path.startsWith("/api") || path.startsWith("/health"))).toBe(false);
    await workshop.server.kill();
    await tablet.page.goto(address);
    await tablet.page.getByRole("heading", { name: "The server does not answer" }).waitFor();
    await workshop.server.start();
    await tablet.untilReady();
    await tablet.page.getByRole("alert").waitFor({ state: "detached" });
  });
});

describe("a picture that the device drops", () => {
  it("is spoken of until it is back, also when another tree is opened", async () => {
    const { tablet } = await workshop.fresh({ ...SMALL, watched: true });
    const { page } = tablet;
    const card = page.getByRole("heading", { name: "The picture is gone" });
    /** Has the picture dropped, and gives after how many milliseconds something is said of it. */
    const dropped = () =>
      page.evaluate(async () => {
        const canvas = document.querySelector<HTMLCanvasElement>("#workspace")!;
        // A context that is lost gives out no more extensions.
        const loss = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
        Object.assign(globalThis, { restore: () => loss.restoreContext() });
        const lost = performance.now();
        loss.loseContext();
        await new Promise<void>((said) => {
          const watcher = new MutationObserver(() => {
            if (document.querySelector('[data-hindrance="no-picture"]') === null) return;
            watcher.disconnect();
            said();
          });
          watcher.observe(document, { subtree: true, childList: true, attributes: true });
        });
        return performance.now() - lost;
      });
    expect(await inTime("it is spoken of", dropped()), "most devices give it back at once").toBeGreaterThan(1000);
    await card.waitFor();
    await page.getByRole("alert").getByRole("button", { name: "Reload" }).waitFor();
    const gone = await tablet.glimpse("picture-gone");
    const before = page.url();
    await tablet.tap("New tree");
    await until("another tree is open", () => page.url() !== before);
    await tablet.untilReady();
    await tablet.untilSettled();
    expect(await card.count(), "there is no picture of it either").toBe(1);
    await page.evaluate(() => (globalThis as unknown as { restore(): void }).restore());
    await card.waitFor({ state: "detached" });
    const beside = { x: 690, y: 120, width: 150, height: 300 };
    expect(changed(gone, await tablet.photograph("picture-back"), beside), "it is drawn again").toBeGreaterThan(0.5);
  });
});
