import { describe, expect, it } from "vitest";
import { SMALL, type Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Loads the page again without the worker that keeps its files, and without those of a pattern. */
async function reloadWithout(tablet: Tablet, files: string): Promise<void> {
  await tablet.page.addInitScript(() => Reflect.deleteProperty(Navigator.prototype, "serviceWorker"));
  await tablet.page.evaluate(async () => {
    const workers = (await navigator.serviceWorker?.getRegistrations()) ?? [];
    await Promise.all(workers.map((worker) => worker.unregister()));
  });
  await tablet.page.route(files, (route) => route.abort());
  await tablet.page.reload();
  await tablet.untilReady();
}

describe("parts of the page", () => {
  it("that do not come say so in their place, and come when they are asked for again", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const files = "**/assets/brush-panel-*.js";
    await reloadWithout(tablet, files);
    await tablet.tap("Brush");
    const panel = tablet.page.getByRole("region", { name: "Brush", exact: true });
    await panel.getByRole("alert").waitFor();
    await tablet.page.unroute(files);
    // The browser remembers that the file did not come; the page is loaded anew, with its panels closed.
    const loaded = tablet.page.waitForEvent("load");
    await panel.getByRole("button", { name: "Try again" }).tap();
    await loaded;
    await tablet.untilReady();
    await tablet.tap("Brush");
    await panel.getByRole("slider").first().waitFor();
    expect(await panel.getByRole("alert").count()).toBe(0);
  });
});
