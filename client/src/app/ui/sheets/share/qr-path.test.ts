import { encodeQR } from "qr";
import { decodeQR } from "qr/decode.js";
import { expect, it } from "vitest";
import { qrPath } from "./qr-path";

/** A side of a square of the code, in pixels. */
const SIDE = 6;

/** Paints a path as a page does, dark on light. */
function painted(path: string, squares: number) {
  const side = squares * SIDE;
  const data = new Uint8ClampedArray(4 * side * side).fill(255);
  for (const [, x, y, length] of path.matchAll(/M(\d+) (\d+)h(\d+)v1H\d+z/g)) {
    for (let row = 0; row < SIDE; row += 1) {
      const from = (Number(y) * SIDE + row) * side + Number(x) * SIDE;
      for (let at = from; at < from + Number(length) * SIDE; at += 1) data.set([0, 0, 0, 255], 4 * at);
    }
  }
  return { width: side, height: side, data };
}

it("a code that is drawn is read as the link", () => {
  for (const link of ["http://192.168.1.7:7700/pair#Zk3_x-9Qm1rT7uVw0aBcDe", "https://trees.example/pair#a"]) {
    const rows = encodeQR(link, "raw", { border: 4 });
    expect(decodeQR(painted(qrPath(rows), rows.length))).toBe(link);
  }
});

it("squares beside each other are one piece", () => {
  expect(
    qrPath([
      [true, true, false, true],
      [false, false, false, false],
      [false, true, true, true],
    ]),
  ).toBe("M0 0h2v1H0zM3 0h1v1H3zM1 2h3v1H1z");
});
