type Point2 = readonly [number, number];

/** The union of discs along a way and of what they sweep over between, as the path of an SVG. */
export function sweptPath(points: readonly Point2[], radiusOf: (i: number) => number): string {
  let path = "";
  points.forEach(([x, y], i) => {
    const r = radiusOf(i);
    path += `M${text(x - r)} ${text(y)}a${text(r)} ${text(r)} 0 1 1 ${text(2 * r)} 0a${text(r)} ${text(r)} 0 1 1 ${text(-2 * r)} 0Z`;
    const before = points[i - 1];
    const way = before ? Math.hypot(x - before[0], y - before[1]) : 0;
    if (!before || way === 0) {
      return;
    }
    // Across the way; discs and what lies between are drawn in the same sense, so that they never cancel.
    const [nx, ny] = [(before[1] - y) / way, (x - before[0]) / way];
    const s = radiusOf(i - 1);
    const [a, b] = [at(before, nx, ny, -s), at([x, y], nx, ny, -r)];
    const [c, d] = [at([x, y], nx, ny, r), at(before, nx, ny, s)];
    path += `M${a}L${b}L${c}L${d}Z`;
  });
  return path;
}

function at([x, y]: Point2, nx: number, ny: number, by: number): string {
  return `${text(x + by * nx)} ${text(y + by * ny)}`;
}

function text(value: number): string {
  return value.toFixed(1);
}
