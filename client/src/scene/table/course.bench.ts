import { bench, describe } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { Course } from "./course";

/** Trees of about ten and a hundred thousand rows. */
const TREES = [
  { seed: 3, height: 62, orders: 3 },
  { seed: 3, height: 96, orders: 4 },
];

for (const options of TREES) {
  const delta = sampleTree(options);
  const table = new PlainTable(() => 0);
  table.apply(delta);
  const nothing = () => {};
  /** A course of rows none of which has been drawn. */
  const whole = () => {
    const course = new Course();
    course.reserve(table.rows);
    for (let row = 0; row < table.rows; row += 1) course.touch(row);
    course.derive(table, nothing);
    return course;
  };
  const course = whole();
  const tips = Array.from({ length: 500 }, (_, n) => table.rows - 1 - n);

  describe(`${table.rows} rows`, () => {
    bench("all rows of a tree that is opened", () => {
      new PlainTable(() => 0).apply(delta);
    });
    bench("of that the course", () => {
      whole();
    });
    bench("the course of 500 rows that have come last", () => {
      for (const row of tips) course.touch(row);
      course.derive(table, nothing);
    });
  });
}
