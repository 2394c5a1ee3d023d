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
const ANNS = "correct horse";

beforeAll(() => {
  const options = ["user", "add", "Ann", "--admin", "--database", workshop.server.database];
  const added = spawnSync(program, options, { input: ANNS, encoding: "utf8" });
  expect(added.stderr).toBe("");
});

/** A page of somebody who has logged in. */
async function loggedIn(name: string, password: string, screen: Screen): Promise<Tablet> {
  const tablet = await workshop.open(ownersLink(workshop.server, name), screen);
  const status = await tablet.page.evaluate(
    async (account) => {
      const headers = { "content-type": "application/json" };
      return (await fetch("/api/v1/login", { method: "POST", headers, body: JSON.stringify(account) })).status;
    },
    { name, password },
  );
  expect(status, `${name} logs in`).toBeLessThan(300);
  await tablet.page.reload();
  await tablet.untilReady();
  return tablet;
}

/** Opens the card of accounts from the settings, by the button that somebody has there. */
async function openAccounts(tablet: Tablet, button: string): Promise<void> {
  await press(tablet, "Settings");
  await tablet.press(tablet.page.getByRole("button", { name: button, exact: true }));
  await tablet.page.getByRole("tablist", { name: "What is shown" }).waitFor();
}

const within = (tablet: Tablet) => tablet.page.getByRole("dialog");
const pressThere = (tablet: Tablet, name: string) =>
  tablet.press(within(tablet).getByRole("button", { name, exact: true }));
const turnTo = (tablet: Tablet, name: string) => tablet.press(within(tablet).getByRole("tab", { name, exact: true }));
const note = (tablet: Tablet, text: string) => tablet.page.locator(".toast", { hasText: text });

/** Says what no finger hits in the card, once no note lies over it. */
async function missed(tablet: Tablet, where: string): Promise<string[]> {
  const notes = tablet.page.locator(".toast");
  await until("no note is left", async () => (await notes.count()) === 0, 20_000);
  return misses(tablet, where, ".sheet", false);
}

test.each<[string, Screen]>([
  ["tablet", LANDSCAPE],
  ["phone", PHONE],
])(
  "AC19, AC20, AC21: on a %s people, groups, passwords and programs are looked after by touch",
  async (name, screen) => {
    const bo = `Bo of the ${name}`;
    const ann = await loggedIn("Ann", ANNS, screen);
    const { page } = ann;
    await openAccounts(ann, "People, groups and programs");
    const own = page.locator('[data-user="Ann"]');
    await own.getByText("Ann (you)").waitFor();

    // The last administrator stays one.
    await own.getByRole("combobox").selectOption("viewer");
    await note(ann, "Nobody else is an administrator").waitFor();
    expect(await own.getByRole("combobox").inputValue()).toBe("admin");
    await ann.press(own.getByRole("button", { name: "Remove Ann" }));
    await ann.show(`accounts-last-${name}`);
    await ann.press(own.getByRole("button", { name: "Remove", exact: true }));
    await until("it is said once more", async () => (await note(ann, "Nobody else is an administrator").count()) > 0);
    await own.waitFor();

    // Somebody is added.
    await pressThere(ann, "Add somebody");
    await within(ann).getByLabel("Name", { exact: true }).fill(bo);
    await pressThere(ann, "Suggest one");
    expect(await missed(ann, "the form")).toEqual([]);
    await ann.show(`accounts-add-${name}`);
    await pressThere(ann, "Add somebody");
    await page.getByText(`${bo} can log in now`, { exact: false }).waitFor();
    const password = await within(ann).locator(".fresh-link").getByLabel("Password", { exact: true }).inputValue();
    await ann.show(`accounts-added-${name}`);
    await pressThere(ann, "Passed on");
    const his = page.locator(`[data-user="${bo}"]`);
    await his.waitFor();

    // He takes another password, and lets a program in.
    const guest = await loggedIn(bo, password, { ...SMALL, width: 700, height: 800 });
    const tools = guest.page.getByRole("button", { name: /^(Brush|Undo|Save)$/ });
    await until("he may draw", async () => (await tools.count()) > 0);
    await openAccounts(guest, "Password and programs");
    expect(await within(guest).getByRole("tab").allTextContents(), "others are not his to see").toEqual([
      "Programs",
      "You",
    ]);
    await within(guest).getByLabel("Password until now").fill("a wrong guess");
    await within(guest).getByLabel("Password from now on").fill("battery staple");
    await pressThere(guest, "Change the password");
    await within(guest).getByRole("alert").waitFor();
    await guest.show(`accounts-own-${name}`);
    await within(guest).getByLabel("Password until now").fill(password);
    await pressThere(guest, "Change the password");
    await note(guest, "Your password is changed").waitFor();
    await turnTo(guest, "Programs");
    await within(guest).getByLabel("What the program is called").fill("Farm");
    await pressThere(guest, "Make a token");
    const token = await within(guest).getByLabel("Token", { exact: true }).inputValue();
    await guest.show(`accounts-token-${name}`);
    const asked = async () =>
      (await fetch(`${workshop.server.address}/api/v1/trees`, { headers: { authorization: `Bearer ${token}` } }))
        .status;
    expect(await asked(), "the program is let in").toBe(200);
    await pressThere(guest, "I have copied it");
    await pressThere(guest, "Revoke the token of Farm");
    await pressThere(guest, "Revoke");
    await within(guest).getByText("No program has a token.").waitFor();
    expect(await asked(), "and then no longer").toBe(401);
    await pressThere(guest, "Close");

    // What he may changes under his hands, and back.
    await his.getByRole("combobox").selectOption("viewer");
    await note(ann, `${bo} may now: Look`).waitFor();
    await until("no tool is left", async () => (await tools.count()) === 0);
    await his.getByRole("combobox").selectOption("editor");
    await until("the tools are back", async () => (await tools.count()) > 0);

    // A group gives him more.
    await turnTo(ann, "Groups");
    await pressThere(ann, "Add a group");
    const group = `Studio of the ${name}`;
    await within(ann).getByLabel("Name", { exact: true }).fill(group);
    await within(ann).getByRole("combobox", { name: "May", exact: true }).selectOption("owner");
    await pressThere(ann, "Add a group");
    const row = page.locator(`[data-group="${group}"]`);
    await row.getByText("Nobody is in it.").waitFor();
    await row.getByRole("combobox", { name: `Add to ${group}…` }).selectOption({ label: bo });
    await row.getByRole("button", { name: `Take ${bo} out of ${group}` }).waitFor();
    expect(await missed(ann, "the groups")).toEqual([]);
    await ann.show(`accounts-groups-${name}`);
    await turnTo(ann, "People");
    await his.getByText("Through a group: Also delete and invite", { exact: false }).waitFor();
    await ann.show(`accounts-people-${name}`);
    await turnTo(ann, "Groups");
    await ann.press(row.getByRole("button", { name: `Take ${bo} out of ${group}` }));
    await ann.press(
      page.locator(".toast-row", { hasText: `${bo} is no longer in` }).getByRole("button", { name: "Undo" }),
    );
    await row.getByRole("button", { name: `Take ${bo} out of ${group}` }).waitFor();
    await ann.press(row.getByRole("button", { name: `Remove ${group}` }));
    await ann.press(row.getByRole("button", { name: "Remove", exact: true }));
    await row.waitFor({ state: "detached" });

    // He forgets his password and gets another; then he is removed, and stands before the door.
    await turnTo(ann, "People");
    await ann.press(his.getByRole("button", { name: `Change name or password of ${bo}` }));
    await ann.press(his.getByRole("button", { name: "Suggest one" }));
    await ann.press(his.getByRole("button", { name: "Save" }));
    await page.getByText(`${bo} logs in with this password now`, { exact: false }).waitFor();
    await guest.page.getByRole("heading", { name: "Log in" }).waitFor();
    await pressThere(ann, "Passed on");
    await ann.press(his.getByRole("button", { name: `Remove ${bo}` }));
    await ann.press(his.getByRole("button", { name: "Remove", exact: true }));
    await his.waitFor({ state: "detached" });
  },
);

test.each<[string, Screen]>([
  ["upright tablet", { ...LANDSCAPE, width: 834, height: 1194 }],
  ["small phone", { ...PHONE, width: 360, height: 640 }],
])("AC19: on an %s every control of people, groups and programs is hit where it is drawn", async (name, screen) => {
  const ann = await loggedIn("Ann", ANNS, screen);
  await openAccounts(ann, "People, groups and programs");
  await ann.page.locator('[data-user="Ann"]').waitFor();
  for (const tab of ["People", "Groups", "Programs", "You"]) {
    await turnTo(ann, tab);
    expect(await missed(ann, tab)).toEqual([]);
    await ann.show(`accounts-${tab.toLowerCase()}-${name.replace(" ", "-")}`);
  }
});
