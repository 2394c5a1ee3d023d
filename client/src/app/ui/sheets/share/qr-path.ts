/** The dark squares of a code as the path of a drawing, a unit each; those beside each other are one piece. */
export function qrPath(rows: readonly (readonly boolean[])[]): string {
  const pieces: string[] = [];
  for (const [y, row] of rows.entries()) {
    for (let x = 0; x < row.length; x += 1) {
      let end = x;
      while (row[end]) {
        end += 1;
      }
      if (end > x) {
        pieces.push(`M${x} ${y}h${end - x}v1H${x}z`);
        x = end;
      }
    }
  }
  return pieces.join("");
}
