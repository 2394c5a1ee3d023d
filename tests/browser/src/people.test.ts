import { execFileSync } from "node:child_process";
import { expect, test } from "vitest";
import { LANDSCAPE, PHONE } from "./screens";
import { program } from "./server";
import { Workshop } from "./workshop";

// Nobody is let in merely for sitting at the machine.
const workshop = Workshop.withItsOwnServer(["--auth"]);

/** A link that lets in whoever is called so, as an owner. */
function invitation(name: string): string {
  const { database, address } = workshop.server;
  const options = ["--role", "owner", "--name", name, "--database", database, "--url", address];
  const printed = execFileSync(program, ["invite", ...options], { encoding: "utf8" });
  const link = /http:\/\/\S+\/pair#\S+/.exec(printed)?.[0];
  if (!link) throw new Error(`there is no link in ${printed}`);
  return link;
}

test.each([
  ["tablet", LANDSCAPE],
  ["phone", PHONE],
] as const)(
  "AC17, AC18: on a %s a guest is handed the tree, has it taken back, and is removed",
  async (name, screen) => {
    const owner = await workshop.open(invitation("Ann"), screen);
    const { page } = owner;
    const link = await page.evaluate(async () => {
      const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
      const post = async (path: string, body: object) => {
        const headers = { "content-type": "application/json" };
        return await (await fetch(path, { method: "POST", headers, body: JSON.stringify(body) })).json();
      };
      const tree = await post("/api/v1/trees", { session, name: "Beech" });
      return (await post(`/api/v1/trees/${tree.id}/links`, { role: "editor", name: "Bo" })).url as string;
    });
    const guest = await workshop.open(link, { width: 600, height: 500, detail: 0.3 });
    await owner.press(page.locator(".people-chip"));
    const people = page.getByRole("dialog").locator(".people").first();
    const bo = people.locator("li").filter({ hasText: "Bo" });
    await bo.getByRole("button", { name: "Hand the tree over to Bo" }).waitFor();
    await owner.show(`people-here-${name}`);
    await owner.press(bo.getByRole("button", { name: "Hand the tree over to Bo" }));
    await owner.show(`people-hand-over-${name}`);
    await owner.press(bo.getByRole("button", { name: "Hand over", exact: true }));
    await page.getByText("This tree was handed over to Bo.").waitFor();
    await bo.getByText("Owner", { exact: true }).waitFor();
    expect(await bo.getByRole("button", { name: "Remove Bo" }).count(), "owners stay").toBe(0);
    await owner.show(`people-heir-${name}`);
    await owner.press(page.getByRole("button", { name: "Take that back" }));
    await owner.press(bo.getByRole("button", { name: "Remove Bo" }));
    await owner.show(`people-remove-${name}`);
    await owner.press(bo.getByRole("button", { name: "Remove", exact: true }));
    await page.getByText("Bo was removed; their link works no longer").waitFor();
    await bo.waitFor({ state: "detached" });
    await guest.page.getByText("has removed you from this tree. Your link works no longer", { exact: false }).waitFor();
    await guest.showNow(`people-removed-${name}`);
    await expect.poll(() => guest.page.evaluate(async () => (await fetch("/api/v1/me")).status)).toBe(401);
  },
);
