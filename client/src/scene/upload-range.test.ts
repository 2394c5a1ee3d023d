import { InstancedBufferAttribute } from "three";
import { expect, it } from "vitest";
import { uploadRange } from "./upload-range";

function buffer() {
  return new InstancedBufferAttribute(new Float32Array(4000), 4);
}

/** Whether what is to be uploaded of a buffer holds a number's place. */
function holds({ updateRanges }: InstancedBufferAttribute, place: number): boolean {
  return updateRanges.some(({ start, count }) => start <= place && place < start + count);
}

it("what was not yet uploaded still is after something else was written", () => {
  const hidden = buffer();
  uploadRange(hidden, 400, 8);
  uploadRange(hidden, 12, 4);
  expect([12, 15, 400, 407].every((place) => holds(hidden, place))).toBe(true);
  expect(holds(hidden, 100)).toBe(false);
  expect(hidden.version).toBe(2);
});

it("a buffer that stays hidden for long has few stretches, none of them lost", () => {
  const hidden = buffer();
  const places = Array.from({ length: 300 }, (_, i) => (i * 733) % 3990);
  for (const place of places) uploadRange(hidden, place, 5);
  expect(hidden.updateRanges.length).toBeLessThan(10);
  for (const place of places) expect(holds(hidden, place) && holds(hidden, place + 4)).toBe(true);
});
