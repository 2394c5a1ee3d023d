import { spawnSync } from "node:child_process";
import { beforeAll, expect, test } from "vitest";
import { misses } from "./hits";
import { ownersLink } from "./invitations";
import { LANDSCAPE, PHONE, type Screen, SMALL } from "./screens";
import { program, until } from "./server";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer(["--auth"]);
const PASSWORD = "correct horse";
const SCREENS: readonly (readonly [string, Screen])[] = [
  ["tablet", LANDSCAPE],
  ["upright tablet", { ...LANDSCAPE, width: 834, height: 1194 }],
  ["phone", PHONE],
  ["small phone", { ...PHONE, width: 320, height: 568 }],
];

beforeAll(() => {
  const said = (args: readonly string[]) =>
    spawnSync(program, [...args, "--database", workshop.server.database], { input: PASSWORD, encoding: "utf8" }).stderr;
  expect(said(["user", "add", "Ann", "--admin"])).toBe("");
  expect(said(["user", "add", "Olga", "--role", "owner"])).toBe("");
  for (const [name] of SCREENS) expect(said(["user", "add", `Bo of the ${name}`, "--role", "none"])).toBe("");
  expect(said(["group", "add", "Studio", "--role", "none"])).toBe("");
});

/** A page of somebody who has logged in. */
async function loggedIn(name: string, screen: Screen): Promise<Tablet> {
  const tablet = await workshop.open(ownersLink(workshop.server, name), screen);
  const status = await tablet.page.evaluate(
    async (account) => {
      const headers = { "content-type": "application/json" };
      return (await fetch("/api/v1/login", { method: "POST", headers, body: JSON.stringify(account) })).status;
    },
    { name, password: PASSWORD },
  );
  expect(status, `${name} logs in`).toBeLessThan(300);
  return tablet;
}

/** Somebody's page with a tree that lies in a collection. */
async function withTree(name: string, tree: string, screen: Screen): Promise<Tablet> {
  const tablet = await loggedIn(name, screen);
  await tablet.page.reload();
  await tablet.untilReady();
  await tablet.page.evaluate(async (name) => {
    const post = async (path: string, body: object) => {
      const headers = { "content-type": "application/json" };
      return await (await fetch(path, { method: "POST", headers, body: JSON.stringify(body) })).json();
    };
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const { id } = await post("/api/v1/trees", { session, name });
    const collection = (await post("/api/v1/collections", { name: `Where ${name} lies` })).id;
    const headers = { "content-type": "application/json" };
    await fetch(`/api/v1/trees/${id}`, { method: "PATCH", headers, body: JSON.stringify({ collection }) });
  }, tree);
  return tablet;
}

const within = (tablet: Tablet) => tablet.page.getByRole("dialog");
const pressThere = (tablet: Tablet, name: string) =>
  tablet.press(within(tablet).getByRole("button", { name, exact: true }));
const note = (tablet: Tablet, text: string) => tablet.page.locator(".toast-row", { hasText: text });
const row = (tablet: Tablet, name: string) => tablet.page.locator(`[data-member="${name}"]`);

/** Opens the menu of a tree or a collection, and in it what shares it with people. */
async function shareFrom(tablet: Tablet, menu: string): Promise<void> {
  await pressThere(tablet, menu);
  await tablet.press(tablet.page.locator(".card-menu").getByRole("button", { name: "Share with people…" }));
  await tablet.page.getByRole("dialog", { name: "Share with people" }).waitFor();
}

/** Says what no finger hits in the card, once no note lies over it. */
async function missed(tablet: Tablet, where: string): Promise<string[]> {
  const notes = tablet.page.locator(".toast");
  await until("no note is left", async () => (await notes.count()) === 0, 20_000);
  return misses(tablet, where, ".sheet", false);
}

/** The trees that somebody's library lists. */
const listed = ({ page }: Tablet) =>
  page.evaluate(async () => {
    const { trees } = await (await fetch("/api/v1/trees")).json();
    return (trees as { name: string }[]).map(({ name }) => name);
  });

test.each(SCREENS)(
  "AC22: on a %s an owner gives a tree and a collection by touch, and takes them back",
  async (name, screen) => {
    const [bo, oak] = [`Bo of the ${name}`, `Oak of the ${name}`];
    const file = name.replace(" ", "-");
    const ann = await withTree("Ann", oak, screen);
    const guest = await loggedIn(bo, { ...SMALL, width: 700, height: 800 });
    expect(await listed(guest)).toEqual([]);
    await press(ann, "Library");
    await shareFrom(ann, `More for ${oak}`);
    await within(ann).getByText("With nobody by name yet", { exact: false }).waitFor();
    await within(ann).getByText(`It lies in “Where ${oak} lies”`, { exact: false }).waitFor();
    expect(await missed(ann, "the form")).toEqual([]);
    await ann.show(`gifts-form-${file}`);

    // Nobody is named, and nobody is called so.
    await pressThere(ann, "Share");
    await within(ann).getByRole("alert").filter({ hasText: "Write the name of a person first." }).waitFor();
    const field = within(ann).getByLabel("Name they log in with");
    await field.fill("Bob");
    await pressThere(ann, "Share");
    await within(ann).getByRole("alert").getByText("Nobody called “Bob” can log in here", { exact: false }).waitFor();
    await ann.show(`gifts-nobody-${file}`);

    // A name is picked while it is typed.
    await field.fill(bo.toUpperCase().slice(0, -2));
    await pressThere(ann, bo);
    expect(await field.inputValue()).toBe(bo);
    await pressThere(ann, "Share");
    await note(ann, `${bo} may now: Look`).waitFor();
    expect(await field.inputValue()).toBe("");
    await row(ann, bo).waitFor();
    expect(await listed(guest)).toEqual([oak]);

    // To a group as well.
    await ann.press(within(ann).getByRole("radio", { name: "A group" }));
    await pressThere(ann, "Studio");
    await within(ann).getByRole("combobox", { name: "They may", exact: true }).selectOption("editor");
    await pressThere(ann, "Share");
    await row(ann, "Studio").getByText("Group", { exact: true }).waitFor();
    expect(await missed(ann, "who has it")).toEqual([]);
    await row(ann, bo).scrollIntoViewIfNeeded();
    await ann.show(`gifts-list-${file}`);

    // Another role, and back by the note; taken back, and back by the note.
    const role = row(ann, bo).getByRole("combobox");
    await role.selectOption("owner");
    await ann.press(note(ann, `${bo} may now: Also delete`).getByRole("button", { name: "Undo" }));
    await until("the role is back", async () => (await role.inputValue()) === "viewer");
    await pressThere(ann, `Take it back from ${bo}`);
    await row(ann, bo).waitFor({ state: "detached" });
    // A note offers that for some seconds only: nothing slow comes before.
    await ann.press(note(ann, `It is no longer shared with ${bo}`).getByRole("button", { name: "Undo" }));
    await row(ann, bo).waitFor();
    expect(await listed(guest)).toEqual([oak]);
    await pressThere(ann, `Take it back from ${bo}`);
    await row(ann, bo).waitFor({ state: "detached" });
    const head = within(ann).getByRole("heading", { name: "Shared with" });
    await until("the focus is not lost with the row", () => head.evaluate((head) => head === document.activeElement));
    expect(await listed(guest)).toEqual([]);
    await ann.show(`gifts-taken-${file}`);

    // The collection, from its own menu.
    await pressThere(ann, "To the library");
    const list = within(ann).getByRole("combobox", { name: "Collections", exact: true });
    const one = within(ann).getByRole("button", { name: `Where ${oak} lies`, exact: true });
    await list.or(one).waitFor();
    await ((await list.isVisible()) ? list.selectOption(`Where ${oak} lies`) : ann.press(one));
    await shareFrom(ann, `More for the collection Where ${oak} lies`);
    await within(ann).getByText("finds this collection", { exact: false }).waitFor();
    await within(ann).getByLabel("Name they log in with").fill(bo);
    await pressThere(ann, "Share");
    await row(ann, bo).waitFor();
    await ann.show(`gifts-collection-${file}`);
    expect(await listed(guest)).toEqual([oak]);
  },
);

test("AC22: an owner who is told no names types them", async () => {
  const olga = await withTree("Olga", "Elm", LANDSCAPE);
  await press(olga, "Share");
  await pressThere(olga, "Share with people…");
  await within(olga).getByText("With nobody by name yet", { exact: false }).waitFor();
  expect(
    await within(olga).getByRole("group", { name: "Names to pick from" }).count(),
    "names are not hers to see",
  ).toBe(0);
  await olga.press(within(olga).getByRole("radio", { name: "A group" }));
  await within(olga).getByLabel("Name of the group").fill("Bo of the phone");
  await pressThere(olga, "Share");
  await within(olga).getByText("There is no group called “Bo of the phone” here.").waitFor();
  await olga.press(within(olga).getByRole("radio", { name: "A person" }));
  await pressThere(olga, "Share");
  await row(olga, "Bo of the phone").waitFor();
  await pressThere(olga, "Back to Share");
  await olga.page.getByRole("dialog", { name: "Share this tree" }).waitFor();
});
