import { describe, expect, it } from "vitest";
import { SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Loads the page again without the files of a pattern. */
async function reloadWithout(tablet: Tablet, files: string): Promise<void> {
  await tablet.page.route(files, (route) => route.abort());
  await tablet.page.reload();
  await tablet.untilReady();
}

/** Keeps the rows of the tree back from the page that is loaded next; what this returns lets them through. */
async function holdRows({ page }: Tablet): Promise<() => void> {
  let through = false;
  const held: (() => void)[] = [];
  await page.routeWebSocket(/.*/, (socket) => {
    const server = socket.connectToServer();
    server.onMessage((message) => {
      if (typeof message === "string" || through) socket.send(message);
      else held.push(() => socket.send(message));
    });
  });
  return () => {
    through = true;
    for (const send of held.splice(0)) send();
  };
}

describe("parts of the page", () => {
  it("that the first picture does without come after it", async () => {
    const { tablet, address } = await workshop.fresh(SMALL);
    await workshop.act(address, [{ kind: "grow", steps: 5 }]);
    await tablet.until("it has grown", ({ metamers }) => metamers > 0);
    const { page } = tablet;
    const letThrough = await holdRows(tablet);
    const asked: string[] = [];
    page.on("request", (request) => {
      if (/script|stylesheet/.test(request.resourceType())) asked.push(new URL(request.url()).pathname);
    });
    // What the page before still asked for does not count.
    page.on("framenavigated", () => asked.splice(0));
    await page.reload();
    await tablet.until("the page knows of the tree", ({ operations }) => operations !== "");
    await tablet.frames();
    // What paints comes beside the page, which does not wait for it; what one without a graphics card has of its own first.
    const first = /\/(index|paint-worker|sketch|slowness-chip)-/;
    const later = asked.filter((path) => path.startsWith("/assets/") && !first.test(path));
    expect(later).toEqual([]);
    letThrough();
    await until("they come", () => asked.some((path) => path.startsWith("/assets/button-label-")));
    await page.getByRole("slider", { name: "Time", exact: true }).waitFor();
  });

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
