/** The hash of rule LF3, in 32-bit wrapping arithmetic. */
export function leafHash(input: number): number {
  const x = (Math.imul(input, 747796405) + 2891336453) >>> 0;
  const y = Math.imul((x >>> ((x >>> 28) + 4)) ^ x, 277803737) >>> 0;
  return ((y >>> 22) ^ y) >>> 0;
}
