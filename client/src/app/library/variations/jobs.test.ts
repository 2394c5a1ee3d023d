import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import { Virtual } from "../../../../test/virtual-clock";
import { RequestFailed } from "../../requests/request";
import type { Job } from "./job-api";
import { Jobs, type Ordered } from "./jobs";
import { FIRST_WISH, orderOf } from "./order";

const settled = () => new Promise((resolve) => setTimeout(resolve));
const refused = (status: number) => new RequestFailed(status, { code: "refused", message: "No." });
const ORDER = orderOf({ template: "oak" }, { ...FIRST_WISH, trees: 3 }, "glb", new Map());

/** A server that grows on request, as far as the test has it. */
function server(ordered: readonly Ordered[] = []) {
  const there = new Map<string, Job>();
  const keys = new Map<string, string>();
  const asked: string[] = [];
  const lost = { answers: 0, status: 0 };
  const clock = new Virtual();
  let made = 0;
  const answer = <Value>(value: Value): Value => {
    if (lost.answers > 0) {
      lost.answers -= 1;
      throw refused(lost.status);
    }
    return value;
  };
  const open = (kept: readonly Ordered[]) =>
    new Jobs({
      ordered: signal(kept),
      clock,
      newKey: () => `key-${made++}`,
      api: {
        orderTrees: async (_, key) => {
          asked.push(key);
          const id = keys.get(key) ?? `job-${there.size}`;
          // What is refused for good begins nothing.
          if (lost.answers === 0 || lost.status === 0) {
            keys.set(key, id);
            there.set(id, { id, state: "waiting", ahead: 0, done: 0, all: 3, results: [], failed: [] });
          }
          return answer(there.get(id)!);
        },
        findJob: async (id) => {
          asked.push(id);
          return answer(there.get(id) ?? null);
        },
        giveUpJob: async (id) => {
          answer(null);
          there.delete(id);
        },
        listJobs: async () => {
          asked.push("list");
          return answer([...there.values()]);
        },
      },
    });
  const set = (id: string, change: Partial<Job>) => there.set(id, { ...there.get(id)!, ...change });
  return { jobs: open(ordered), open, there, asked, lost, clock, set };
}

describe("jobs", () => {
  it("JB2: are followed until they end, and who follows is told", async () => {
    const { jobs, asked, clock, set } = server();
    const ended: string[] = [];
    const stop = jobs.follow(({ id, state }) => ended.push(`${id} ${state}`));
    await settled();
    await jobs.order(ORDER, "Oak");
    expect(jobs.orderOf("job-0")).toEqual({ id: "job-0", name: "Oak", ending: "glb" });
    set("job-0", { state: "growing", done: 1 });
    clock.pass(1000);
    await settled();
    expect([jobs.list.value?.[0]?.done, ended]).toEqual([1, []]);
    set("job-0", { state: "done", done: 3 });
    clock.pass(1000);
    await settled();
    expect([jobs.active.value, ended]).toEqual([[], ["job-0 done"]]);
    const before = asked.length;
    clock.pass(60_000);
    await settled();
    expect(asked.length, "nothing is asked for that does not change").toBe(before);
    await jobs.order(ORDER, "Oak");
    stop();
    clock.pass(60_000);
    await settled();
    expect(asked.length, "nobody follows").toBe(before + 1);
  });

  it("IK1: an order whose answer was lost is done once when it is sent again", async () => {
    const { jobs, there, asked, lost } = server();
    lost.answers = 1;
    await expect(jobs.order(ORDER, "Oak")).rejects.toThrow("No.");
    expect(jobs.ordering.value).toBe(false);
    await jobs.order(ORDER, "Oak");
    expect([[...there.keys()], asked]).toEqual([["job-0"], ["key-0", "key-0"]]);
    await jobs.order(ORDER, "Oak");
    expect(there.size, "the same once more on purpose").toBe(2);
    Object.assign(lost, { answers: 1, status: 400 });
    await expect(jobs.order(ORDER, "Oak")).rejects.toThrow("No.");
    await jobs.order(ORDER, "Oak");
    expect(asked.slice(-2), "what was refused would be refused again").toEqual(["key-2", "key-3"]);
  });

  it("are found again by the next page, and those that are gone are forgotten", async () => {
    const { jobs, open, there } = server();
    await jobs.order(ORDER, "Oak");
    await jobs.order(ORDER, "Ash");
    const next = open([...jobs.ordered.value, { id: "of-yesterday", name: "Elm", ending: "png" }]);
    await next.look();
    expect(next.list.value?.map(({ id }) => next.orderOf(id)?.name)).toEqual(["Ash", "Oak"]);
    expect(next.ordered.value.map(({ name }) => name)).toEqual(["Ash", "Oak"]);
    await next.giveUp("job-0");
    expect([next.list.value?.length, next.ordered.value.length, there.size]).toEqual([1, 1, 1]);
  });

  it("are asked for again after a while where the server is silent", async () => {
    const { jobs, lost, clock } = server();
    lost.answers = 1;
    const stop = jobs.follow();
    await settled();
    expect([jobs.list.value, jobs.failure.value]).toEqual([null, expect.any(RequestFailed)]);
    clock.pass(4000);
    await settled();
    expect(jobs.list.value).toBeNull();
    clock.pass(1000);
    await settled();
    expect([jobs.list.value, jobs.failure.value]).toEqual([[], null]);
    stop();
  });
});
