import { signal } from "@preact/signals";
import { expect, it } from "vitest";
import type { SheetName } from "../page/layout";
import { Trees } from "./trees";

function page() {
  const session = signal<string | null>("oak");
  const names = signal<Readonly<Record<string, string>>>({});
  const sheet = signal<SheetName | null>(null);
  const here = { isUnsaved: false, answers: true, gone: false, isSaved: true };
  const done: string[] = [];
  const open = (next: string) => {
    done.push(`open ${next}`);
    if (here.answers) {
      session.value = next;
    }
    return here.answers;
  };
  const trees = new Trees({
    link: {
      session,
      change: async ({ tree, template } = {}) => {
        const session = tree === undefined ? "empty" : `${template ? "begun as" : "with"} ${tree}`;
        return open(session)
          ? { session, ...(tree && !template ? { tree: { id: tree, version: 1, saved: here.isSaved } } : {}) }
          : null;
      },
      reopen: async (other) => (here.gone ? "gone" : open(other) ? "opened" : "failed"),
    },
    unsaved: {
      get isUnsaved() {
        return here.isUnsaved;
      },
      keep: async () => {
        done.push("keep");
        return here.isUnsaved;
      },
      opened: (opened) => done.push(`opened ${opened}`),
      forget: (other) => done.push(`forget ${other}`),
    },
    names,
    sheet,
    say: (text) => done.push(text),
  });
  return { trees, session, names, sheet, here, done };
}

it("a tree that is not saved is left only after the user was asked", async () => {
  const { trees, sheet, here, done } = page();
  here.isUnsaved = true;
  trees.begin();
  expect([sheet.value, done]).toEqual(["leave", []]);
  await trees.leave(undefined, false);
  expect([sheet.value, done]).toEqual([null, ["open empty"]]);
});

it("a tree of the library comes with its name, and the one before is kept", async () => {
  const { trees, here, done } = page();
  here.isUnsaved = true;
  await trees.leave({ tree: { id: "t1", name: "Old oak" } });
  expect(done).toEqual(["keep", "open with t1", "notices.kept-unsaved", "opened with t1"]);
  expect(trees.name.value).toBe("Old oak");
});

it("a tree that others work on is not saved as it is", async () => {
  const { trees, here, done } = page();
  here.isSaved = false;
  await trees.leave({ tree: { id: "t1", name: "Old oak" } });
  expect(done).toEqual(["keep", "open with t1"]);
});

it("what is begun with a template has no name of its own yet", async () => {
  const { trees, done } = page();
  await trees.leave({ tree: { id: "t1", name: "Old oak" }, template: true });
  expect([trees.name.value, done]).toEqual([null, ["keep", "open begun as t1", "opened begun as t1"]]);
});

it("where no other session is to be had, the sheet stays and nothing is called anything", async () => {
  const { trees, sheet, here, names } = page();
  sheet.value = "library";
  here.answers = false;
  await trees.leave({ tree: { id: "t1", name: "Old oak" } });
  expect([sheet.value, names.value]).toEqual(["library", {}]);
});

it("an unsaved tree that the server no longer has is forgotten, with a word", async () => {
  const { trees, session, here, done } = page();
  here.gone = true;
  await trees.goOnWith("elm");
  expect([session.value, done]).toEqual(["oak", ["keep", "forget elm", "notices.unsaved-gone"]]);
});

it("the names of the last trees are remembered", () => {
  const { trees, session, names } = page();
  for (let n = 0; n < 60; n++) {
    session.value = `s${n}`;
    trees.call(`Tree ${n}`);
  }
  expect([Object.keys(names.value).length, names.value.s9, names.value.s10]).toEqual([50, undefined, "Tree 10"]);
});
