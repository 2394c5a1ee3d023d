import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { CheckGrammar, Command, GrammarInForce, GrammarReport } from "../../../wire/generated";
import { Drafts } from "./drafts";
import { BOUT, CHECK_AFTER, GrammarEditing, keptValues, valuesIn } from "./grammar-editing";

const CLEAN: GrammarReport = {
  diagnostics: [],
  title: null,
  about: null,
  author: null,
  depth: 5,
  sliders: [],
  sizes: [],
  ends: null,
};

const told = (text: string, values: Record<string, number> = {}): GrammarInForce => ({
  text,
  title: null,
  at: [0, 0, 0],
  seed: 1,
  sliders: [{ name: "a", from: 0, to: 90, value: 30 }],
  values: Object.entries(values).map(([name, value]) => ({ name, value })),
  within: null,
  depth: 5,
  earlier: 0,
  later: 0,
  edited: false,
  ends: null,
});

/** What a browser keeps for its pages. */
function store(): Storage {
  const all = new Map<string, string>();
  return {
    getItem: (key: string) => all.get(key) ?? null,
    setItem: (key: string, value: string) => void all.set(key, value),
  } as Storage;
}

/** An editor with a clock that is turned by hand and a server whose answers are given by hand. */
function bench(room: readonly [number, number, number] | null = null, own = store()) {
  const drafts = new Drafts(store(), own);
  const session = signal<string | null>(null);
  const [inForce, busy] = [signal<GrammarInForce | null>(null), signal(false)];
  const sent: Command[] = [];
  const asked: { check: CheckGrammar; answer: (report: Partial<GrammarReport>) => Promise<void> }[] = [];
  let now = 0;
  let timers: { at: number; run: () => void }[] = [];
  const clock = {
    now: () => now,
    after: (delay: number, run: () => void) => {
      const timer = { at: now + delay, run };
      timers.push(timer);
      return () => {
        timers = timers.filter((other) => other !== timer);
      };
    },
  };
  const pass = (time: number) => {
    now += time;
    const due = timers.filter(({ at }) => at <= now);
    timers = timers.filter(({ at }) => at > now);
    for (const { run } of due) run();
  };
  const editing = new GrammarEditing({
    inForce,
    busy,
    submit: (command) => sent.push(command),
    newGesture: () => 10 + sent.length,
    ahead: () => ({ step: 0, pending: 0 }),
    room: () => room,
    planting: () => {},
    session,
    drafts,
    check: (check) =>
      new Promise((resolve) => {
        const answer = async (report: Partial<GrammarReport>) => {
          resolve({ ...CLEAN, ...report });
          for (let i = 0; i < 6; i += 1) await Promise.resolve();
        };
        asked.push({ check, answer });
      }),
    clock,
    failed: (error) => {
      throw error;
    },
  });
  return { editing, inForce, sent, asked, pass, session, drafts };
}

const ERROR = {
  severity: "error",
  line: 1,
  column: 2,
  length: 1,
  code: "bracket",
  id: "bracket.unopened",
  values: {},
  message: "",
  hint: null,
} as const;

describe("typing a grammar", () => {
  it("is looked at a while after the last key, and planted where it is clean", async () => {
    const { editing, sent, asked, pass } = bench();
    editing.type("axiom: F");
    pass(CHECK_AFTER - 1);
    editing.type("axiom: FA");
    pass(CHECK_AFTER - 1);
    expect(asked.length).toBe(0);
    pass(1);
    expect(asked.map(({ check }) => check)).toEqual([{ text: "axiom: FA" }]);
    await asked[0]?.answer({});
    expect(sent).toEqual([{ kind: "set_grammar", text: "axiom: FA", depth: 4, gesture: 10 }]);
    expect(asked[1]?.check).toEqual({ text: "axiom: FA", sizes: true });
  });

  it("is planted when it is opened whole, also where the editor then looks at it", async () => {
    const { editing, sent, asked } = bench();
    editing.open("axiom: F");
    editing.look();
    expect(asked.length).toBe(1);
    await asked[0]?.answer({});
    expect(sent).toMatchObject([{ kind: "set_grammar", text: "axiom: F" }]);
  });

  it("is planted beside what stands there, once", async () => {
    const { editing, inForce, sent, asked, pass } = bench([40, 0, 0]);
    editing.type("axiom: F");
    pass(CHECK_AFTER);
    await asked[0]?.answer({});
    expect(sent).toMatchObject([{ kind: "set_grammar", position: [40, 0, 0] }]);
    await asked[1]?.answer({});
    inForce.value = told("axiom: F");
    editing.type("axiom: FF");
    pass(CHECK_AFTER);
    await asked[2]?.answer({});
    expect(sent[1]).not.toHaveProperty("position");
  });

  it("plants nothing that is wrong, and says where", async () => {
    const { editing, sent, asked, pass } = bench();
    editing.type("axiom: F]");
    pass(CHECK_AFTER);
    await asked[0]?.answer({ diagnostics: [ERROR] });
    expect([sent, editing.hasErrors.value, editing.problems.value]).toEqual([[], true, [ERROR]]);
    editing.type("axiom: F]]");
    expect(editing.problems.value, "they stand elsewhere by now").toEqual([]);
  });

  it("is one deed as long as the bout lasts, and another one after it", async () => {
    const { editing, inForce, sent, asked, pass } = bench();
    const write = async (text: string) => {
      editing.type(text);
      pass(CHECK_AFTER);
      const first = asked.findLast(({ check }) => check.text === text && !check.sizes);
      await first?.answer({});
      inForce.value = told(text);
      await asked.findLast(({ check }) => check.text === text && check.sizes)?.answer({});
    };
    await write("a");
    await write("ab");
    editing.endBout();
    await write("abc");
    pass(BOUT);
    await write("abcd");
    expect(sent.map(({ kind, gesture }) => [kind, gesture])).toEqual([
      ["set_grammar", 10],
      ["set_grammar", 10],
      ["set_grammar", 12],
      ["set_grammar", 13],
    ]);
    expect(sent[1]).toMatchObject({ text: "ab" });
  });

  it("waits for a button where it is not live", async () => {
    const { editing, sent, asked, pass } = bench();
    editing.live.value = false;
    editing.type("axiom: F");
    pass(CHECK_AFTER);
    await asked[0]?.answer({});
    expect(sent).toEqual([]);
    editing.plant();
    expect(sent).toMatchObject([{ kind: "set_grammar", text: "axiom: F" }]);
  });

  it("leaves a depth that somebody has chosen until the text asks for another", async () => {
    const { editing, inForce, sent, asked, pass } = bench();
    const write = async (text: string, depth: number) => {
      editing.type(text);
      pass(CHECK_AFTER);
      for (const sizes of [undefined, true]) {
        await asked.findLast(({ check }) => check.text === text && check.sizes === sizes)?.answer({ depth });
      }
      inForce.value = told(text);
    };
    await write("depth: 5\naxiom: F", 5);
    await write("depth: 5\naxiom: FA", 5);
    editing.steer();
    await write("depth: 5\naxiom: FAB", 5);
    await write("depth: 7\naxiom: FAB", 7);
    expect(sent.map((command) => (command.kind === "set_grammar" ? command.depth : 0))).toEqual([5, 5, undefined, 7]);
  });

  it("sends nothing while somebody else's text waits for a decision", async () => {
    const { editing, inForce, sent, asked, pass } = bench();
    inForce.value = told("ours");
    editing.type("mine");
    inForce.value = told("theirs");
    expect(editing.theirs.value).toBe("theirs");
    pass(CHECK_AFTER);
    await asked[0]?.answer({});
    expect([sent, editing.text.value]).toEqual([[], "mine"]);
    editing.takeTheirs();
    expect([editing.text.value, editing.setAside.value]).toEqual(["theirs", { text: "mine" }]);
  });
});

describe("a text that is not planted", () => {
  it("is put aside when another takes its place, and forgotten once it is planted", () => {
    const { editing, inForce } = bench();
    inForce.value = told("ours");
    editing.type("axiom: F[");
    editing.open("shipped");
    expect(editing.aside).toEqual(["axiom: F["]);
    editing.open("axiom: F[");
    expect(editing.aside, "that which stands here is not offered again").toEqual(["shipped"]);
    inForce.value = told("shipped");
    editing.discard("axiom: F[");
    editing.takeTheirs();
    expect(editing.aside).toEqual(["axiom: F["]);
  });

  it("stays when the server refuses it, with a depth at which it may do", async () => {
    const { editing, inForce, sent, asked, pass } = bench();
    inForce.value = told("small");
    editing.type("depth: 20\naxiom: F\nF --> FFF");
    pass(CHECK_AFTER);
    await asked[0]?.answer({ depth: 20 });
    expect(sent).toMatchObject([{ text: "depth: 20\naxiom: F\nF --> FFF" }]);
    inForce.value = { ...told("small"), ends: { id: "ends.modules", values: {}, message: "" } };
    expect(editing.text.value).toBe("depth: 20\naxiom: F\nF --> FFF");
    editing.refuseLast();
    expect([editing.refused.value, editing.possibleDepth]).toEqual([
      { of: "depth: 20\naxiom: F\nF --> FFF", depth: 20 },
      null,
    ]);
    const sizes = [1, 8, 64, 512].map((internodes) => ({ internodes, modules: internodes }));
    await asked[1]?.answer({ depth: 20, sizes: sizes as never });
    expect(editing.possibleDepth).toBe(3);
    editing.plant(3);
    expect(sent.at(-1)).toMatchObject({ text: "depth: 20\naxiom: F\nF --> FFF", depth: 3 });
    editing.refuse({ text: "depth: 20\naxiom: F\nF --> FFF", depth: 3 });
    expect(editing.possibleDepth, "what was refused is not offered again").toBe(2);
    editing.plant(2);
    inForce.value = told("depth: 20\naxiom: F\nF --> FFF");
    expect([editing.refused.value, editing.isPlanted.value]).toEqual([null, true]);
  });

  it("stands in the editor again after the page is loaded again", () => {
    const own = store();
    const before = bench(null, own);
    before.session.value = "s1";
    before.inForce.value = told("ours");
    before.editing.type("axiom: F[");
    const after = bench(null, own);
    after.session.value = "s1";
    after.inForce.value = told("ours");
    expect([after.editing.text.value, after.editing.theirs.value, after.editing.isPlanted.value]).toEqual([
      "axiom: F[",
      null,
      false,
    ]);
    const elsewhere = bench(null, own);
    elsewhere.session.value = "s2";
    elsewhere.inForce.value = told("another");
    expect([elsewhere.editing.text.value, elsewhere.editing.aside]).toEqual(["another", ["axiom: F["]]);
  });

  it("stands here and nowhere else once it is taken up again", () => {
    const { editing, inForce, drafts } = bench();
    inForce.value = told("ours");
    editing.keep("axiom: F[");
    editing.takeUp("axiom: F[");
    editing.type("axiom: F[]");
    expect([editing.text.value, editing.aside, drafts.aside.value]).toEqual(["axiom: F[]", [], []]);
  });

  it("is kept when the page is left", () => {
    const { editing, inForce, drafts } = bench();
    inForce.value = told("ours");
    editing.leave();
    expect(drafts.aside.value).toEqual([]);
    editing.type("axiom: F[");
    editing.leave();
    expect(drafts.aside.value).toEqual(["axiom: F["]);
  });
});

describe("sliders of a grammar", () => {
  it("keep what was set where the text changes elsewhere", () => {
    const slider = { name: "a", from: 0, to: 90, value: 30 };
    expect(keptValues(told("x", { a: 60 }), [slider])).toEqual([{ name: "a", value: 60 }]);
    expect(keptValues(told("x", { a: 60 }), [{ ...slider, value: 31 }])).toEqual([]);
    expect(keptValues(told("x", { a: 60 }), [{ ...slider, to: 50 }])).toEqual([]);
    expect(keptValues(told("x", { a: 60 }), [])).toEqual([]);
  });

  it("have the values of the text until they are set", () => {
    expect(valuesIn(told("x"))).toEqual({ a: 30 });
    expect(valuesIn(told("x", { a: 44 }))).toEqual({ a: 44 });
  });

  it("send the newest of a drag with one gesture, and no more than the server keeps up with", () => {
    const { editing, inForce, sent, pass } = bench();
    inForce.value = told("x");
    for (let value = 31; value <= 40; value += 1) {
      editing.values.drag({ a: value });
      pass(50);
    }
    expect(sent.length, "two are on their way").toBe(2);
    expect(editing.values.value.value).toEqual({ a: 40 });
    editing.values.settle(2);
    pass(100);
    editing.values.commit({ a: 41 });
    expect(sent.at(-1)).toMatchObject({ kind: "set_grammar_values", values: [{ name: "a", value: 41 }] });
    expect(new Set(sent.map(({ gesture }) => gesture)).size).toBe(1);
  });
});
