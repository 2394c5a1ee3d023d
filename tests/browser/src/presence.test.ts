import type { Page } from "playwright-core";
import { afterEach, expect, test } from "vitest";
import { factsOf } from "./facts";
import { misses } from "./hits";
import { guestsLink, ownersLink } from "./invitations";
import type { Screen } from "./screens";
import { until } from "./server";
import { SlowLink } from "./slow-link";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

// People come by links of their own: whoever sits at the machine would be the same person on all pages.
const workshop = Workshop.withItsOwnServer(["--auth"]);

const links: SlowLink[] = [];
afterEach(async () => {
  for (const link of links.splice(0)) await link.close();
});

const GLASS: Screen = { width: 700, height: 560, detail: 0.2 };

/** Ann's tablet, which shows who is here and notes what it says, and Bo's, whose way to the server can be cut or stalled. */
async function two() {
  const ann = await workshop.open(ownersLink(workshop.server, "Ann"), GLASS);
  const bosLink = await guestsLink(ann, "Elm", "Bo");
  const link = await SlowLink.to(workshop.server.address);
  links.push(link);
  const bo = await workshop.open(link.address(bosLink), GLASS);
  await ann.press(ann.page.locator(".people-chip"));
  await row(ann, "Bo").waitFor();
  await until("he is here", async () => (await states(ann, "Bo")) === "here");
  return { ann, bo, link, noted: await noting(ann, "Bo") };
}

function row({ page }: Tablet, name: string) {
  return page.locator(".people > li").filter({ hasText: name });
}

/** How each of somebody's devices is, as a page shows it; empty if they are not in the list. */
async function states(tablet: Tablet, name: string): Promise<string> {
  const devices = row(tablet, name).locator(".person-device");
  return (await devices.evaluateAll((all) => all.map((one) => one.dataset.state))).join();
}

/** What a page shows of somebody from now on: all states of their devices, one after the other, and all notes of them. */
async function noting({ page }: Tablet, name: string): Promise<() => Promise<{ states: string[]; notes: string[] }>> {
  const noted = await page.evaluateHandle((name) => {
    const noted = { states: [] as string[], notes: [] as string[] };
    const look = () => {
      const row = [...document.querySelectorAll(".people > li")].find((row) => row.textContent?.includes(name));
      const devices = [...(row?.querySelectorAll<HTMLElement>(".person-device") ?? [])];
      const now = devices.map(({ dataset }) => dataset.state).join();
      if (now !== noted.states.at(-1)) noted.states.push(now);
    };
    look();
    const options = { subtree: true, childList: true, attributes: true, characterData: true };
    new MutationObserver((changes) => {
      look();
      for (const { addedNodes } of changes) {
        for (const node of addedNodes) {
          const toasts = node instanceof Element ? node.querySelectorAll(".toast") : [];
          for (const toast of toasts) if (toast.textContent?.includes(name)) noted.notes.push(toast.textContent);
        }
      }
    }).observe(document.body, options);
    return noted;
  }, name);
  return () => noted.evaluate((noted) => noted);
}

const untilStates = (tablet: Tablet, name: string, what: string, wanted: string) =>
  until(what, async () => (await states(tablet, name)) === wanted);

const untilConnected = (page: Page) =>
  until("the page is connected", async () => (await factsOf(page)).connection === "connected");

test("PS3: a person with two pages is one in the list, and has left when both are closed", async () => {
  const { ann, bo, noted } = await two();
  const second = await bo.page.context().newPage();
  await second.goto(bo.page.url());
  await untilConnected(second);
  await untilStates(ann, "Bo", "both pages are there", "here,here");
  expect(await row(ann, "Bo").count(), "one person").toBe(1);
  await row(ann, "Bo").getByText("2 devices").waitFor();
  expect(await row(ann, "Bo").getByRole("button", { name: "Follow" }).count(), "each can be followed").toBe(2);
  // Of his own other page he is told as well.
  await bo.press(bo.page.locator(".people-chip"));
  await row(bo, "Bo").getByText("2 devices").waitFor();
  expect(await bo.page.locator(".people > li").count()).toBe(2);
  await second.close();
  await untilStates(ann, "Bo", "one page is left", "here");
  await bo.page.close();
  await untilStates(ann, "Bo", "nobody is left", "");
  await until("it is said that he has left", async () => (await noted()).notes.length > 0);
  const { states: seen, notes } = await noted();
  // A page that is being closed may still say that nobody looks at it.
  expect(seen.filter((state) => !state.includes("away"))).toEqual(["here", "here,here", "here", ""]);
  expect(notes).toEqual(["Bo has left"]);
});

test("PS3: who plays the design stays in the list, as one who does that", async () => {
  const { ann, bo, noted } = await two();
  await workshop.actAs(ann, [{ kind: "grow", steps: 4 }]);
  await bo.until("it has grown", ({ present }) => present === 4);
  const person = await row(ann, "Bo").getAttribute("data-person");
  const shown = bo.page.getByRole("button", { name: "Replay", exact: true });
  const folded = bo.page.getByRole("button", { name: "Show the timeline" });
  await shown.or(folded).first().waitFor();
  if ((await folded.count()) > 0) await bo.press(folded);
  await bo.press(shown);
  await bo.page.locator(".replay").waitFor();
  await row(ann, "Bo").getByText("Plays the design").waitFor();
  expect(await row(ann, "Bo").getByRole("button", { name: "Follow" }).count(), "there is nothing to follow").toBe(0);
  await ann.showNow("79-who-plays-the-design");
  // What he sees there is nobody's: others go on.
  await workshop.actAs(ann, [{ kind: "grow", steps: 1 }]);
  await ann.until("it grows on", ({ present }) => present === 5);
  await bo.press(bo.page.getByRole("button", { name: "Back to the tree" }));
  await untilStates(ann, "Bo", "he is at it again", "here");
  await row(ann, "Bo").getByRole("button", { name: "Follow" }).waitFor();
  expect(await row(ann, "Bo").getAttribute("data-person"), "he is who he was").toBe(person);
  await bo.until("he has what was done meanwhile", ({ present }) => present === 5);
  const { states: seen, notes } = await noted();
  // Between two sockets he may be nowhere for a moment, and each of them begins as one that is here.
  const stays = seen.filter((state) => state !== "");
  expect(stays.filter((state, place) => state !== stays[place - 1])).toEqual(["here", "away", "here"]);
  expect(notes, "he had not left").toEqual([]);
});

test.each([
  ["a tablet", GLASS],
  ["a phone", { width: 390, height: 844, detail: 0.2 }],
] as const)("RP1: who may only look finds the way to play the design, on %s", async (name, glass) => {
  const ann = await workshop.open(ownersLink(workshop.server, "Ann"), GLASS);
  await workshop.actAs(ann, [{ kind: "grow", steps: 4 }]);
  const viewer = await workshop.open(await guestsLink(ann, "Elm", "Vi", "viewer"), glass);
  await ann.press(ann.page.locator(".people-chip"));
  await untilStates(ann, "Vi", "she is here", "here");
  expect(await viewer.page.getByRole("slider", { name: "Time" }).count(), "she does not travel").toBe(0);
  await viewer.showNow(`79-viewer-${name}`);
  expect(await misses(viewer, name, ".foot"), "each control is hit where it is drawn").toEqual([]);
  await viewer.press(viewer.page.getByRole("button", { name: "Replay", exact: true }));
  await viewer.page.locator(".replay").waitFor();
  await untilStates(ann, "Vi", "she plays it", "away");
  await viewer.press(viewer.page.getByRole("button", { name: "Back to the tree" }));
  await untilStates(ann, "Vi", "she is at it again", "here");
});

test("PS3: a tablet that sleeps is shown as one that does not answer, and is here again when it wakes", async () => {
  const { ann, bo, link, noted } = await two();
  // What it sends and what is sent to it waits; nobody ends the connection.
  link.stall();
  await untilStates(ann, "Bo", "he does not answer", "gone");
  await row(ann, "Bo").getByText("Does not answer").waitFor();
  await ann.page.locator('.person-badge[data-state="away"]').waitFor({ state: "attached" });
  // Nor does he see what he cannot know.
  await bo.until("his page knows it", ({ connection }) => connection !== "connected");
  expect(await bo.page.locator(".people-chip").count()).toBe(0);
  link.flow();
  await untilConnected(bo.page);
  await untilStates(ann, "Bo", "he is here again", "here");
  await bo.page.locator(".people-chip").waitFor();
  const { states: seen, notes } = await noted();
  // The connection of before may end on the way.
  expect(seen.filter((state) => state !== "")).toEqual(["here", "gone", "here"]);
  expect(notes, "he had not left").toEqual([]);
});

test("PS3: who comes into another network is the same device, while the connection of before hangs", async () => {
  const { ann, bo, link, noted } = await two();
  const device = () => ann.page.locator(".people > li").filter({ hasText: "Bo" }).getAttribute("data-person");
  const before = await device();
  link.move();
  await bo.until("his page knows it", ({ connection }) => connection !== "connected");
  await untilConnected(bo.page);
  await untilStates(ann, "Bo", "he is here", "here");
  await bo.page.locator(".people-chip").waitFor();
  expect(await device(), "he has his number").toBe(before);
  const { states: seen, notes } = await noted();
  expect(new Set(seen), "never two devices, and never none").toSatisfy((all: Set<string>) =>
    [...all].every((state) => ["here", "gone"].includes(state)),
  );
  expect(seen.at(-1)).toBe("here");
  expect(notes).toEqual([]);
});

test("PS3: who is cut off is not in the list, comes back as the same person, and follows whom they followed", async () => {
  const { ann, bo, link, noted } = await two();
  const number = () => row(ann, "Bo").getAttribute("data-person");
  const before = await number();
  await bo.press(bo.page.locator(".people-chip"));
  await bo.press(row(bo, "Ann").getByRole("button", { name: "Follow" }));
  await row(ann, "Bo").getByText("Follows Ann").waitFor();
  link.cut();
  await untilStates(ann, "Bo", "he is not there", "");
  await bo.until("his page knows it", ({ connection }) => connection !== "connected");
  expect(await bo.page.locator(".people-chip").count()).toBe(0);
  link.mend();
  await untilConnected(bo.page);
  await untilStates(ann, "Bo", "he is back", "here");
  expect(await number()).toBe(before);
  await row(ann, "Bo").getByText("Follows Ann").waitFor();
  // And once more by loading the page anew.
  await bo.page.reload();
  await untilConnected(bo.page);
  await untilStates(ann, "Bo", "he is back with one device", "here");
  expect(await number()).toBe(before);
  const { states: seen, notes } = await noted();
  // A page that is being closed may still say that nobody looks at it.
  expect(new Set(seen.filter((state) => state !== "away"))).toEqual(new Set(["here", ""]));
  // Whether that was short enough not to be spoken of, the machine decides; nobody comes who has not left.
  expect(notes.filter((note) => note.endsWith("is here")).length).toBe(
    notes.filter((note) => note.endsWith("has left")).length,
  );
});
