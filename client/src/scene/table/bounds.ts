/** What a box is measured from. */
interface Points {
  rows: number;
  position: Float32Array;
  parent: Int32Array;
  radiusCode: Uint16Array;
}

/** The box around a tree; measured again only when something was taken away or moved. */
export class Bounds {
  readonly min: [number, number, number] = [0, 0, 0];
  readonly max: [number, number, number] = [0, 0, 0];
  private measured = 0;

  /** Makes the next `refresh` measure every row. */
  invalidate(): void {
    this.measured = 0;
  }

  /** Takes in the rows added since the last call. */
  refresh(points: Points): void {
    if (this.measured === 0) {
      this.min.fill(Number.POSITIVE_INFINITY);
      this.max.fill(Number.NEGATIVE_INFINITY);
    }
    for (let row = this.measured; row < points.rows; row += 1) {
      if (points.radiusCode[row] === 0 && points.parent[row]! >= 0) continue;
      for (let axis = 0; axis < 3; axis += 1) {
        const value = points.position[3 * row + axis]!;
        if (value < this.min[axis]!) this.min[axis] = value;
        if (value > this.max[axis]!) this.max[axis] = value;
      }
    }
    this.measured = points.rows;
    if (this.min[0] > this.max[0]) {
      this.min.fill(0);
      this.max.fill(0);
    }
  }
}
