import { signal } from "@preact/signals";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { Hindrance } from "../page/hindrance";
import { PictureLoss } from "./picture-loss";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function losing(before: Hindrance | null = null) {
  const hindrance = signal(before);
  return { hindrance, loss: new PictureLoss(hindrance) };
}

it("a picture that stays away is spoken of until it is back", () => {
  const { hindrance, loss } = losing();
  loss.tell(true);
  expect(hindrance.value).toBeNull();
  vi.advanceTimersByTime(5000);
  expect(hindrance.value).toBe("no-picture");
  loss.tell(false);
  expect(hindrance.value).toBeNull();
});

it("one that is soon back is not spoken of", () => {
  const { hindrance, loss } = losing();
  loss.tell(true);
  vi.advanceTimersByTime(500);
  loss.tell(false);
  vi.advanceTimersByTime(60_000);
  expect(hindrance.value).toBeNull();
});

it("another tree that is opened does not bring it back", () => {
  const { hindrance, loss } = losing();
  loss.tell(true);
  vi.advanceTimersByTime(5000);
  hindrance.value = null;
  expect(hindrance.value).toBe("no-picture");
  loss.tell(false);
  expect(hindrance.value).toBeNull();
});

it("it is spoken of once nothing else is in the way", () => {
  const { hindrance, loss } = losing("no-server");
  loss.tell(true);
  vi.advanceTimersByTime(5000);
  expect(hindrance.value).toBe("no-server");
  hindrance.value = null;
  expect(hindrance.value).toBe("no-picture");
});

it("nothing is said of it once the page has let go", () => {
  const { hindrance, loss } = losing();
  loss.tell(true);
  vi.advanceTimersByTime(5000);
  loss.stop();
  hindrance.value = null;
  expect(hindrance.value).toBeNull();
});

it("its loss and its return leave other hindrances as they are", () => {
  const { hindrance, loss } = losing("no-server");
  loss.tell(true);
  vi.advanceTimersByTime(5000);
  expect(hindrance.value).toBe("no-server");
  loss.tell(false);
  expect(hindrance.value).toBe("no-server");
});
