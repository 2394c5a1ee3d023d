import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { speak } from "../words/later-words";
import { followChoices } from "./language-and-theme";
import { loadSettings } from "./settings";

vi.mock("../words/later-words", () => ({ speak: vi.fn(async () => {}) }));

beforeEach(() => {
  vi.stubGlobal("document", { documentElement: { dataset: {} }, querySelector: () => null });
  vi.stubGlobal("matchMedia", () => ({ matches: false, addEventListener: () => {}, removeEventListener: () => {} }));
});
afterEach(() => vi.unstubAllGlobals());

it("a language that could not be loaded can be chosen again", async () => {
  const settings = loadSettings({ getItem: () => null, setItem: () => {} } as unknown as Storage);
  settings.language.value = "en";
  let failures = 0;
  const stop = followChoices(settings, () => failures++);
  await vi.waitFor(() => expect(speak).toHaveBeenCalledTimes(1));
  vi.mocked(speak).mockRejectedValueOnce(new Error("offline"));
  settings.language.value = "de";
  await vi.waitFor(() => expect(failures).toBe(1));
  expect(settings.language.value, "the page goes on in English, and says so").toBe("en");
  vi.mocked(speak).mockClear();
  settings.language.value = "de";
  await vi.waitFor(() => expect(speak).toHaveBeenCalledWith("de"));
  await Promise.resolve();
  expect([settings.language.value, failures]).toEqual(["de", 1]);
  stop();
});
