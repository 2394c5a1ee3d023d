import { expect, test } from "vitest";
import { misses } from "./hits";
import { PHONE } from "./screens";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

test("AC22: where nobody can log in, sharing says why, and offers a link and to add people", async () => {
  const { tablet, address } = await workshop.fresh(PHONE);
  const { page } = tablet;
  await workshop.act(address, [{ kind: "grow", steps: 3 }]);
  await tablet.untilQuiet();
  await page.evaluate(async () => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const headers = { "content-type": "application/json" };
    await fetch("/api/v1/trees", { method: "POST", headers, body: JSON.stringify({ session, name: "Ash" }) });
  });
  const shown = page.getByRole("dialog");
  const choose = async () => {
    await tablet.press(shown.getByRole("button", { name: "More for Ash", exact: true }));
    await tablet.press(page.locator(".card-menu").getByRole("button", { name: "Share with people…" }));
    await page.getByText("There is nobody to share it with by name", { exact: false }).waitFor();
  };
  await press(tablet, "Library");
  await choose();
  await tablet.show("gifts-closed");
  expect(await misses(tablet, "nobody logs in", ".sheet", false)).toEqual([]);
  await tablet.press(shown.getByRole("button", { name: "Share by a link instead…" }));
  await page.getByText("Nobody has been invited").waitFor();
  await tablet.press(shown.getByRole("button", { name: "To the library" }));
  await choose();
  await tablet.press(shown.getByRole("button", { name: "Add people…" }));
  await shown.getByRole("button", { name: "Add somebody" }).waitFor();
});
