import { buffer } from "node:stream/consumers";
import { expect, test } from "vitest";
import { misses } from "./hits";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

test.each<[string, Screen]>([
  ["tablet", LANDSCAPE],
  ["phone", PHONE],
])("EX6: a picture of the server's has the size that is chosen on a %s", async (name, screen) => {
  const { tablet, address } = await workshop.fresh(screen);
  const { page } = tablet;
  await workshop.act(address, [{ kind: "grow", steps: 3 }]);
  await tablet.until("it has grown", ({ metamers }) => metamers > 0);
  const card = page.getByRole("dialog");
  const choose = (choice: string) => tablet.press(card.getByRole("radio", { name: choice, exact: true }));
  await press(tablet, "Download");
  await choose("Turntable (PNG)");

  // More than the server makes for one file is told, and not asked for.
  await choose("72");
  await choose("3840 × 2160");
  await card.getByText("Together that is 597 million pixels", { exact: false }).waitFor();
  const download = card.getByRole("button", { name: "Download file" });
  expect(await download.isDisabled()).toBe(true);
  await tablet.show(`picture-size-too-much-${name}`);

  await choose("Only one");
  await until("one picture can be", async () => !(await download.isDisabled()));
  await choose("Other…");
  const type = async (side: string, pixels: string) => {
    const field = card.getByLabel(`${side}: value`, { exact: true });
    await tablet.press(field);
    await field.fill(pixels);
    await field.blur();
  };
  // A side that is too large for the other one is cut, and the card says so.
  await type("Pixels across", "99999");
  await card.getByRole("status").filter({ hasText: "no more fits" }).waitFor();
  await tablet.show(`picture-size-cut-${name}`);
  await type("Pixels across", "320");
  await card.getByText("no more fits", { exact: false }).waitFor({ state: "detached" });
  await type("Pixels down", "200");
  expect(await misses(tablet, "the size of a picture", ".sheet", false)).toEqual([]);
  await tablet.show(`picture-size-${name}`);
  const file = await tablet.download(download);
  const png = await buffer(await file.createReadStream());
  expect([png.readUInt32BE(16), png.readUInt32BE(20)], "width and height in its head").toEqual([320, 200]);

  // It is kept for the next time.
  await press(tablet, "Download");
  await card.getByRole("radio", { name: "Other…", exact: true, checked: true }).waitFor();
  expect(await card.getByLabel("Pixels across: value", { exact: true }).inputValue()).toBe("320");
  await choose("1920 × 1080");
  await card.getByLabel("Pixels across: value", { exact: true }).waitFor({ state: "detached" });
});
