import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { expect, test } from "vitest";
import { screenshots } from "./browser";
import { misses } from "./hits";
import { print } from "./paper";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

const SEEN: Screen = { width: 1180, height: 760, detail: 0.2 };

const UPRIGHT: Screen = { width: 834, height: 1194, detail: 0.5 };
/** A phone on its side. */
const LOW: Screen = { width: 740, height: 360, detail: 0.5 };

/** Saves the tree on a page, so that comments have a tree to belong to. */
async function save(tablet: Tablet, name: string): Promise<string> {
  return tablet.page.evaluate(async (name) => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const headers = { "content-type": "application/json" };
    const body = JSON.stringify({ session, name });
    return (await (await fetch("/api/v1/trees", { method: "POST", headers, body })).json()).id as string;
  }, name);
}

/** Where a page shows the pin of a thread, and whether it stands on its wood; null where it shows none. */
async function pinOn(tablet: Tablet, thread: number): Promise<(Point & { stands: boolean }) | null> {
  return tablet.page.evaluate((thread) => {
    const pin = document.querySelector(`.comment-pin[data-shown="true"][data-thread="${thread}"]`);
    const button = pin?.querySelector("button");
    const place = /^(-?[\d.]+)px (-?[\d.]+)px$/.exec(button?.style.translate ?? "");
    return place && pin
      ? { x: Number(place[1]), y: Number(place[2]), stands: pin.getAttribute("data-stands") === "true" }
      : null;
  }, thread);
}

async function untilPin(
  tablet: Tablet,
  what: string,
  check: (pin: Point & { stands: boolean }) => boolean,
): Promise<Point> {
  let pin: Awaited<ReturnType<typeof pinOn>> = null;
  const holds = async () => {
    pin = await pinOn(tablet, 1);
    return pin !== null && check(pin);
  };
  await until(what, holds).catch((error) => {
    throw new Error(`${error}; it is at ${JSON.stringify(pin)}`);
  });
  return pin!;
}

async function openComments(tablet: Tablet): Promise<void> {
  await press(tablet, "Comments");
  await tablet.page.locator(".drawer").waitFor();
}

/** Says something of a place that is touched. */
async function comment(tablet: Tablet, at: Point, text: string): Promise<void> {
  await tablet.press(tablet.page.getByRole("button", { name: "Comment on a place" }));
  await tablet.page.locator(".comment-glass[data-placing]").waitFor();
  await tablet.tapAt(at);
  await tablet.page.getByLabel("What you want to say").fill(text);
}

test("CT1, CT2: two pages talk about a place that rides with its branch, goes with it and comes back", async () => {
  const { tablet, address, at } = await workshop.stem(SEEN);
  await save(tablet, "Oak");
  const middle = () =>
    tablet.page.evaluate(() => {
      const { left, width } = document.querySelector("#workspace")!.getBoundingClientRect();
      return left + width / 2;
    });
  const before = await middle();
  await openComments(tablet);
  // The panel takes its room: the stem has moved on the glass with the middle of the picture.
  const { x, y } = at(0, 200);
  const stem = { x: x - before + (await middle()), y };
  await comment(tablet, stem, "Thinner here, <b>please</b>");
  await tablet.press(tablet.page.getByRole("button", { name: "Draw on the view" }));
  await tablet.swipe([way({ x: stem.x - 60, y: stem.y - 40 }, { x: stem.x + 60, y: stem.y + 40 })]);
  await until("a line is drawn", async () => (await tablet.page.locator(".sketch-line").count()) === 1);
  await tablet.show("comment-written");
  await tablet.press(tablet.page.getByRole("button", { name: "Send" }));
  await tablet.page.locator(".comments > li").waitFor();
  const first = await untilPin(tablet, "the pin stands on the stem", ({ stands }) => stands);
  expect(Math.abs(first.x - stem.x)).toBeLessThan(30);

  const other = await workshop.open(address, SEEN);
  await untilPin(other, "the other page shows it", ({ stands }) => stands);
  await other.page.locator(".comment-pin[data-unread] button").waitFor();
  await other.press(other.page.locator(".comment-pin button"));
  await other.page.locator(".comment-text", { hasText: "Thinner here, <b>please</b>" }).waitFor();
  await until("the picture is there", async () =>
    other.page.evaluate(() => (document.querySelector<HTMLImageElement>(".comments img")?.naturalWidth ?? 0) > 100),
  );
  await other.press(other.page.getByRole("button", { name: "Answer" }));
  await other.page.getByLabel("What you want to say").fill("It is done");
  await other.press(other.page.getByRole("button", { name: "Send" }));
  // The first page is told without asking.
  await tablet.page.locator(".comment-text", { hasText: "It is done" }).waitFor();
  await other.show("comment-answered");

  // The branch is bent: the pin rides along, on both.
  await workshop.act(address, [{ kind: "turn_branch", row: 3, rotation: [0, 0, 0.3, 0.954] }]);
  await untilPin(tablet, "it rides along", ({ x, stands }) => stands && Math.abs(x - first.x) > 20);
  // Time goes back to before the branch: it is hollow where it was, and stands again when time has come back.
  await workshop.act(address, [{ kind: "undo" }, { kind: "undo" }]);
  await untilPin(other, "it is not there yet", ({ stands }) => !stands);
  await tablet.show("comment-not-yet");
  await workshop.act(address, [{ kind: "redo" }, { kind: "redo" }]);
  await untilPin(other, "it stands again", ({ stands }) => stands);

  await tablet.press(tablet.page.getByRole("button", { name: "Resolve" }));
  await tablet.page.getByText("Resolved by", { exact: false }).waitFor();
  await tablet.press(tablet.page.getByRole("button", { name: "All comments", exact: false }));
  await tablet.page.getByText("No thread is like that.").waitFor();
  await tablet.press(tablet.page.getByRole("button", { name: "All", exact: true }));
  await tablet.page.locator('.comment-threads > li[data-resolved="true"]').waitFor();
  await tablet.show("comment-list");
});

test("CT5: what its author deletes comes back with Undo, and is gone for everyone when the page is closed", async () => {
  const { tablet, address } = await workshop.fresh(SEEN);
  const tree = await save(tablet, "Rowan");
  await openComments(tablet);
  const said = (page: Tablet, text: string) => page.page.locator(".comment-text", { hasText: text });
  const toast = tablet.page.locator(".toast-row", { hasText: "Deleted: Thinner here" });
  const onServer = () =>
    tablet.page.evaluate(async (tree) => {
      const threads = await (await fetch(`/api/v1/trees/${tree}/threads`)).json();
      return threads.map(({ comments }: { comments: { text: string }[] }) => comments.map(({ text }) => text));
    }, tree);
  await tablet.press(tablet.page.getByRole("button", { name: "Comment on the whole tree" }));
  await tablet.page.getByLabel("What you want to say").fill("Thinner here");
  await tablet.press(tablet.page.getByRole("button", { name: "Send" }));
  await said(tablet, "Thinner here").waitFor();
  const other = await workshop.open(address, SEEN);
  await openComments(other);
  await other.press(other.page.locator(".comment-threads > li > button"));
  await said(other, "Thinner here").waitFor();
  await other.press(other.page.getByRole("button", { name: "Answer" }));
  await other.page.getByLabel("What you want to say").fill("It is done");
  await other.press(other.page.getByRole("button", { name: "Send" }));
  await said(tablet, "It is done").waitFor();

  const remove = () =>
    tablet.press(tablet.page.locator(".comments > li").first().getByRole("button", { name: "Delete" }));
  await remove();
  await said(tablet, "Thinner here").waitFor({ state: "detached" });
  expect(await onServer(), "the server still has it").toEqual([["Thinner here", "It is done"]]);
  await tablet.press(toast.getByRole("button", { name: "Undo" }));
  await said(tablet, "Thinner here").waitFor();
  await toast.waitFor({ state: "detached" });

  await remove();
  await toast.waitFor();
  await tablet.page.goto(`${workshop.server.address}/health`);
  await said(other, "Thinner here").waitFor({ state: "detached" });
  await said(other, "It is done").waitFor();
});

test("CT6: the summary opens as a page of its own, and asks for nothing", async () => {
  const { tablet } = await workshop.stem(SEEN);
  const tree = await save(tablet, "<Elm>");
  await tablet.page.evaluate(async (tree) => {
    const headers = { "content-type": "application/json" };
    const body = JSON.stringify({ comment: { text: "<img src=x onerror=alert(1)>", author: "Ann" } });
    await fetch(`/api/v1/trees/${tree}/threads`, { method: "POST", headers, body });
  }, tree);
  const page = await tablet.page.context().newPage();
  const asked: string[] = [];
  page.on("request", (request) => asked.push(new URL(request.url()).pathname));
  const origin = new URL(tablet.page.url()).origin;
  await page.goto(`${origin}/api/v1/trees/${tree}/review.html?language=de`);
  await page.getByRole("heading", { name: "Kommentare zu <Elm>" }).waitFor();
  await page.getByText("<img src=x onerror=alert(1)>").waitFor();
  expect(asked).toEqual([`/api/v1/trees/${tree}/review.html`]);
  await page.close();
});

/** Many threads: with pictures of every shape, with words and names longer than a line, and with more words than a page holds. */
async function muchToSay(tablet: Tablet, tree: string): Promise<void> {
  await tablet.page.evaluate(async (tree) => {
    const picture = (width: number, height: number) => {
      const canvas = Object.assign(document.createElement("canvas"), { width, height });
      const context = canvas.getContext("2d")!;
      for (let x = 0; x < width; x += 20) {
        context.fillStyle = `hsl(${x % 360} 60% 60%)`;
        context.fillRect(x, 0, 20, height);
      }
      return canvas.toDataURL("image/jpeg", 0.6);
    };
    const post = async (path: string, body: object) => {
      const headers = { "content-type": "application/json" };
      // One comment a second is taken from one person.
      for (;;) {
        const answer = await fetch(path, { method: "POST", headers, body: JSON.stringify(body) });
        if (answer.ok) return answer.json();
        if (answer.status !== 429) throw new Error(await answer.text());
        await new Promise((wait) => setTimeout(wait, 300));
      }
    };
    const author = "Annabelle-Charlotte von und zu Waldhausen";
    const threads = `/api/v1/trees/${tree}/threads`;
    const sizes = [
      [1194, 834],
      [834, 1194],
      [390, 844],
      [1600, 200],
      [200, 1600],
    ] as const;
    for (const [width, height] of sizes) {
      const text = `A picture of ${width} by ${height}.`;
      const { thread } = await post(threads, { comment: { text, author, picture: picture(width, height) } });
      await post(`${threads}/${thread}/comments`, { text: "Das wäre dann der dritte Ast von links.", author: "Bo" });
    }
    await post(threads, { comment: { text: "Lignum".repeat(120), author: "W".repeat(80) } });
    const long = Array.from({ length: 640 }, (_, i) => `word${i}`)
      .join(" ")
      .slice(0, 4000);
    await post(threads, { comment: { text: long, author } });
  }, tree);
}

test("CT6: the summary is printed whole, whatever is said and shown", async () => {
  const { tablet } = await workshop.stem(SEEN);
  const tree = await save(tablet, "Robiniapseudoacacia".repeat(4));
  await muchToSay(tablet, tree);
  const page = await tablet.page.context().newPage();
  await page.goto(`${new URL(tablet.page.url()).origin}/api/v1/trees/${tree}/review.html`);
  const { pdf, pages, faults } = await print(page);
  if (process.env.ALBUM === "1") await writeFile(join(screenshots, "summary.pdf"), pdf);
  expect(faults).toEqual([]);
  expect(pages.flatMap(({ pictures }) => pictures).length).toBeGreaterThanOrEqual(5);
  await page.close();
});

/** Somebody answers in the first thread, from elsewhere. */
async function answer(tablet: Tablet, tree: string, text: string): Promise<void> {
  await tablet.page.evaluate(
    async ([tree, text]) => {
      const headers = { "content-type": "application/json" };
      await fetch(`/api/v1/trees/${tree}/threads/1/comments`, {
        method: "POST",
        headers,
        body: JSON.stringify({ text }),
      });
    },
    [tree, text] as const,
  );
}

/** Whether something in the panel is there and not scrolled away. */
async function isInSight(tablet: Tablet, selector: string): Promise<boolean> {
  return tablet.page.evaluate((selector) => {
    const [body, shown] = [document.querySelector(".drawer-body"), document.querySelectorAll(selector)];
    const last = [...shown].at(-1)?.getBoundingClientRect();
    const within = body?.getBoundingClientRect();
    return last !== undefined && within !== undefined && last.top >= within.top && last.bottom <= within.bottom + 1;
  }, selector);
}

test.each<[string, Screen]>([
  ["tablet", LANDSCAPE],
  ["upright", UPRIGHT],
  ["phone", PHONE],
  ["low", LOW],
])("CT1: a %s has room for comments, and says first where they belong", async (name, screen) => {
  const { tablet } = await workshop.fresh(screen);
  await openComments(tablet);
  await tablet.page.getByText("Comments belong to a saved tree", { exact: false }).waitFor();
  const faults: string[] = [];
  const look = async (where: string, within = ".drawer") =>
    void faults.push(...(await misses(tablet, `${name}, ${where}`, within)));
  await look("what is to be saved first");
  await tablet.show(`comments-unsaved-${name}`);
  const tree = await save(tablet, `Ash on a ${name}`);
  await tablet.press(tablet.page.getByRole("button", { name: "Close", exact: false }).first());
  await openComments(tablet);
  await tablet.press(tablet.page.getByRole("button", { name: "Comment on a place" }));
  await look("a place to be touched", ".comment-glass");
  await tablet.press(tablet.page.locator(".comment-glass").getByRole("button", { name: "Cancel" }));
  await tablet.press(tablet.page.getByRole("button", { name: "Comment on the whole tree" }));
  await tablet.page.getByLabel("What you want to say").fill("A fine seed, and nothing else yet.");
  await look("a comment to be written");
  await tablet.press(tablet.page.getByRole("button", { name: "Send" }));
  await tablet.page.locator(".comment-text", { hasText: "A fine seed" }).waitFor();
  await look("a thread");
  await tablet.show(`comments-${name}`);
  await answer(tablet, tree, "And a second line.");
  await until("the answer is in sight", () => isInSight(tablet, ".comments > li:last-child .comment-text"));
  await tablet.press(tablet.page.getByRole("button", { name: "All comments" }));
  await tablet.page.locator(".comment-threads > li").waitFor();
  await look("the list");
  await tablet.press(tablet.page.locator(".comment-threads > li > button"));
  for (let left = 2; left > 0; left--) {
    await tablet.press(tablet.page.locator(".comments > li").first().getByRole("button", { name: "Delete" }));
  }
  await tablet.page.getByText("Nobody has said anything yet.").waitFor();
  await look("comments that were deleted");
  await tablet.show(`comments-deleted-${name}`);
  expect(faults).toEqual([]);
});
