import { describe, expect, it } from "vitest";
import { Virtual } from "../../../../test/virtual-clock";
import type { Species } from "../../../wire/generated";
import { SpeciesSource } from "./species-source";

const oak = { slug: "oak" } as Species;

/** A server that does not answer the first attempts. */
function setUp(silences: number) {
  const clock = new Virtual();
  const asked: number[] = [];
  const failures: unknown[] = [];
  const source = new SpeciesSource({
    clock,
    list: async () => {
      asked.push(clock.now());
      if (asked.length <= silences) throw new Error("silence");
      return [oak];
    },
  });
  const ask = () => source.ask((error) => failures.push(error));
  const pass = async (seconds: number) => {
    for (let i = 0; i < seconds; i += 1) {
      await new Promise((resolve) => setTimeout(resolve));
      clock.pass(1000);
    }
    await new Promise((resolve) => setTimeout(resolve));
  };
  return { source, asked, failures, ask, pass };
}

describe("species of the server", () => {
  it("are asked for once, however many want them", async () => {
    const { source, asked, ask, pass } = setUp(0);
    ask();
    ask();
    await pass(60);
    ask();
    expect([asked.length, source.known.value]).toEqual([1, [oak]]);
  });

  it("are asked for again until the server answers", async () => {
    const { source, asked, ask, pass } = setUp(3);
    ask();
    await pass(2);
    expect(source.known.value).toBeNull();
    await pass(30);
    expect(source.known.value).toEqual([oak]);
    const waits = asked.slice(1).map((at, i) => at - asked[i]!);
    expect(waits.every((wait, i) => i === 0 || wait > waits[i - 1]!)).toBe(true);
  });

  it("a server that stays silent is reported once", async () => {
    const { asked, failures, ask, pass } = setUp(1000);
    ask();
    await pass(20);
    ask();
    await pass(200);
    expect(asked.length).toBeGreaterThan(8);
    expect(asked.length).toBeLessThan(16);
    expect(failures.length).toBe(1);
  });
});
