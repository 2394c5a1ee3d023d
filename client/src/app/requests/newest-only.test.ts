import { describe, expect, it } from "vitest";
import { NewestOnly } from "./newest-only";

function setUp() {
  const asked: number[] = [];
  const answers: string[] = [];
  const failures: unknown[] = [];
  const open: { resolve: (answer: string) => void; reject: (error: unknown) => void }[] = [];
  const work = new NewestOnly<number, string>(
    (question) => {
      asked.push(question);
      return new Promise((resolve, reject) => open.push({ resolve, reject }));
    },
    (answer) => answers.push(answer),
    (error) => failures.push(error),
  );
  const settle = () => new Promise((resolve) => setTimeout(resolve));
  return { work, asked, answers, failures, open, settle };
}

describe("newest only", () => {
  it("asks at once, and one question at a time", () => {
    const { work, asked } = setUp();
    work.ask(1);
    work.ask(2);
    work.ask(3);
    expect(asked).toEqual([1]);
  });

  it("asks the newest of what waits, and nothing in between", async () => {
    const { work, asked, answers, open, settle } = setUp();
    for (const question of [1, 2, 3, 4]) {
      work.ask(question);
    }
    open[0]!.resolve("one");
    await settle();
    expect([asked, answers]).toEqual([[1, 4], ["one"]]);
    open[1]!.resolve("four");
    await settle();
    expect([asked, answers]).toEqual([
      [1, 4],
      ["one", "four"],
    ]);
    work.ask(5);
    expect(asked).toEqual([1, 4, 5]);
  });

  it("goes on after a question that failed", async () => {
    const { work, asked, answers, failures, open, settle } = setUp();
    work.ask(1);
    work.ask(2);
    open[0]!.reject("no network");
    await settle();
    open[1]!.resolve("two");
    await settle();
    expect([asked, answers, failures]).toEqual([[1, 2], ["two"], ["no network"]]);
  });

  it("minds no answer once it is stopped", async () => {
    const { work, asked, answers, open, settle } = setUp();
    work.ask(1);
    work.ask(2);
    work.stop();
    open[0]!.resolve("one");
    await settle();
    expect([asked, answers]).toEqual([[1], []]);
  });
});
