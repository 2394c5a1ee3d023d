import type { InstancedBufferAttribute, InstancedInterleavedBuffer } from "three";

/** More stretches than this are uploaded as one that covers them all. */
const MOST = 8;

/**
 * Has three.js upload a stretch of a buffer, counted in numbers, besides what still waits. It uploads only what is in
 * a picture and forgets the stretches itself then: clearing them here would lose those of whatever was hidden.
 */
export function uploadRange(
  buffer: InstancedBufferAttribute | InstancedInterleavedBuffer,
  start: number,
  count: number,
): void {
  buffer.addUpdateRange(start, count);
  buffer.needsUpdate = true;
  const { updateRanges } = buffer;
  if (updateRanges.length <= MOST) return;
  const first = Math.min(...updateRanges.map((range) => range.start));
  const end = Math.max(...updateRanges.map((range) => range.start + range.count));
  buffer.clearUpdateRanges();
  buffer.addUpdateRange(first, end - first);
}
