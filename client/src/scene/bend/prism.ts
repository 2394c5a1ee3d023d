/** Numbers of a prism: its centre, then its rotation's x, y, z, w. */
export const PRISM_SIZE = 7;

/** Turns a vector by the rotation of the prism at an offset. */
export function rotate(
  prisms: Float64Array,
  offset: number,
  v: ArrayLike<number>,
  from: number,
  out: { [index: number]: number },
  to: number,
): void {
  const [qx, qy, qz, qw] = [prisms[offset + 3]!, prisms[offset + 4]!, prisms[offset + 5]!, prisms[offset + 6]!];
  const [x, y, z] = [v[from]!, v[from + 1]!, v[from + 2]!];
  const keep = qw * qw - (qx * qx + qy * qy + qz * qz);
  const along = 2 * (x * qx + y * qy + z * qz);
  const across = 2 * qw;
  out[to] = x * keep + qx * along + (qy * z - qz * y) * across;
  out[to + 1] = y * keep + qy * along + (qz * x - qx * z) * across;
  out[to + 2] = z * keep + qz * along + (qx * y - qy * x) * across;
}

/** Turns the rotation of the prism at an offset by a share of a rotation vector. */
export function turnBy(
  prisms: Float64Array,
  offset: number,
  share: number,
  turn: Float64Array,
  at: number,
  out: Float64Array,
): void {
  const [tx, ty, tz] = [share * turn[at]!, share * turn[at + 1]!, share * turn[at + 2]!];
  const angle = Math.sqrt(tx * tx + ty * ty + tz * tz);
  const sine = angle < 2e-9 ? 0.5 : Math.sin(0.5 * angle) / angle;
  const [ax, ay, az, aw] = [sine * tx, sine * ty, sine * tz, Math.cos(0.5 * angle)];
  const [bx, by, bz, bw] = [prisms[offset + 3]!, prisms[offset + 4]!, prisms[offset + 5]!, prisms[offset + 6]!];
  const x = aw * bx + ax * bw + ay * bz - az * by;
  const y = aw * by - ax * bz + ay * bw + az * bx;
  const z = aw * bz + ax * by - ay * bx + az * bw;
  const w = aw * bw - ax * bx - ay * by - az * bz;
  const length = Math.sqrt(x * x + y * y + z * z + w * w);
  out[offset + 3] = x / length;
  out[offset + 4] = y / length;
  out[offset + 5] = z / length;
  out[offset + 6] = w / length;
}
