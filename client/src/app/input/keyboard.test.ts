import { afterEach, describe, expect, it, vi } from "vitest";
import { type KeyActions, listenToKeys } from "./keyboard";

class Field {
  readonly localName: string = "div";
  readonly #role: string | null;
  constructor(role: string | null = null) {
    this.#role = role;
  }
  getAttribute(name: string) {
    return name === "role" ? this.#role : null;
  }
}

class Input extends Field {
  override readonly localName = "input";
  readonly type: string;
  constructor(type: string) {
    super();
    this.type = type;
  }
}

class Area extends Field {}
class Plain extends Field {
  override readonly localName: string;
  constructor(localName: string) {
    super();
    this.localName = localName;
  }
}

afterEach(() => vi.unstubAllGlobals());

function setUp() {
  const page = new EventTarget();
  vi.stubGlobal("addEventListener", page.addEventListener.bind(page));
  vi.stubGlobal("HTMLElement", Field);
  vi.stubGlobal("HTMLInputElement", Input);
  vi.stubGlobal("HTMLTextAreaElement", Area);
  const done: unknown[][] = [];
  const actions = new Proxy({} as KeyActions, {
    get:
      (_, name) =>
      (...given: unknown[]) => {
        if (name !== "busy") {
          done.push([name, ...given]);
        }
        return name === "turn";
      },
  });
  listenToKeys(actions);
  const press = (key: string, more: Partial<KeyboardEvent> = {}, target: unknown = null) => {
    const event = Object.assign(new Event("keydown", { cancelable: true }), { key, code: "", ...more });
    Object.defineProperty(event, "target", { value: target });
    page.dispatchEvent(event);
    return event;
  };
  return { done, press };
}

describe("arrow keys", () => {
  it("turn what is held, with Shift about itself", () => {
    const { done, press } = setUp();
    expect(press("ArrowLeft", {}, new Plain("button")).defaultPrevented).toBe(true);
    press("ArrowUp", {}, new Input("checkbox"));
    press("ArrowRight", { shiftKey: true });
    expect(done).toEqual([
      ["turn", -1, 0, 0],
      ["turn", 0, 1, 0],
      ["turn", 0, 0, 1],
    ]);
  });

  it("belong to a slider that has the focus", () => {
    const { done, press } = setUp();
    for (const target of [new Input("range"), new Input("radio"), new Field("slider")]) {
      expect(press("ArrowLeft", {}, target).defaultPrevented).toBe(false);
    }
    expect(done).toEqual([]);
  });
});

describe("travelling by keys", () => {
  it("goes by steps, with Shift or Alt by operations", () => {
    const { done, press } = setUp();
    press(",", { code: "Comma" });
    press(".", { code: "Period" });
    press("<", { code: "Comma", shiftKey: true });
    press(".", { code: "Period", altKey: true });
    expect(done).toEqual([
      ["travel", -1, false],
      ["travel", 1, false],
      ["travel", -1, true],
      ["travel", 1, true],
    ]);
  });

  it("knows the keys by their place where Shift makes other signs of them", () => {
    const { done, press } = setUp();
    // A German keyboard, and Alt on a Mac.
    press(";", { code: "Comma", shiftKey: true });
    press(":", { code: "Period", shiftKey: true });
    press("≥", { code: "Period", altKey: true });
    expect(done).toEqual([
      ["travel", -1, true],
      ["travel", 1, true],
      ["travel", 1, true],
    ]);
  });

  it("goes by what is typed where the keys lie elsewhere", () => {
    const { done, press } = setUp();
    // A French keyboard, and a Hungarian one.
    press(",", { code: "KeyM" });
    press(".", { code: "Comma", shiftKey: true });
    press("?", { code: "Comma", shiftKey: true });
    press(";", { code: "Comma" });
    expect(done).toEqual([["travel", -1, false], ["travel", 1, false], ["help"]]);
  });
});

describe("letters", () => {
  it("D draws in the next way, with Shift in the one before", () => {
    const { done, press } = setUp();
    press("d");
    press("D", { shiftKey: true });
    expect(done).toEqual([
      ["drawMode", 1],
      ["drawMode", -1],
    ]);
  });

  it("digits switch parts of the picture, 0 all of them back", () => {
    const { done, press } = setUp();
    press("1");
    press("7");
    press("0");
    press("1", { repeat: true });
    press("1", { altKey: true });
    press("1", {}, new Input("number"));
    press("8");
    expect(done).toEqual([
      ["shown", "light"],
      ["shown", "skeleton"],
      ["shown", null],
    ]);
  });

  it("H hides everything, or brings it back", () => {
    const { done, press } = setUp();
    press("h");
    press("H", {}, new Input("search"));
    press("h", {}, new Input("range"));
    expect(done).toEqual([["bare"], ["bare"]]);
  });
});

describe("the space bar", () => {
  it("moves the picture, but not where it means something already", () => {
    const { press } = setUp();
    for (const target of [null, new Plain("div"), new Input("range")]) {
      expect(press(" ", {}, target).defaultPrevented).toBe(true);
    }
    for (const target of [new Plain("button"), new Plain("summary"), new Input("radio"), new Input("checkbox")]) {
      expect(press(" ", {}, target).defaultPrevented).toBe(false);
    }
  });
});
