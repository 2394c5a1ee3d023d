import { signal } from "@preact/signals";
import { type ChangeTree, MAX_NAME_CHARACTERS, type SavedTree, type Species } from "../../wire/generated";
import type { SectionName } from "../page/layout";
import type { ToastAction } from "../page/toasts";
import { sentence } from "../problems/plain-words";
import { Transfer } from "../requests/transfer";
import { say } from "../words/say";
import type * as api from "./library-api";
import { Pages } from "./pages";
import type { Said } from "./save-tree";
import { asked, type Wanted } from "./wanted";

/** What each section lists. */
const LISTED = {
  trees: { template: false },
  templates: { template: true },
  deleted: { deleted: true },
} as const satisfies Record<SectionName, api.Which>;

export interface SectionOptions {
  readonly name: SectionName;
  readonly api: Pick<
    typeof api,
    "listTrees" | "changeTree" | "copyTree" | "deleteTree" | "deleteTreeForGood" | "undeleteTree" | "setFavourite"
  >;
  readonly wanted: () => Wanted;
  /** Those that the server is known to have. */
  readonly species: () => readonly Species[];
  readonly said: () => Said;
  readonly show: (text: string, action?: ToastAction) => void;
}

/** A part of the library, and what is done with its trees, one or several at a time. */
export class LibrarySection {
  readonly name: SectionName;
  readonly pages: Pages<SavedTree>;
  /** The trees that something is to be done with, by their ids; null while none are being chosen. */
  readonly chosen = signal<ReadonlySet<string> | null>(null);
  /** Work on several trees: its progress counts trees. */
  readonly work = new Transfer();
  #options: SectionOptions;

  constructor(options: SectionOptions) {
    this.name = options.name;
    this.#options = options;
    this.pages = new Pages(
      (limit, after) =>
        options.api.listTrees(limit, after, {
          ...asked(options.wanted(), options.species()),
          ...LISTED[options.name],
        }),
      ({ id }) => id,
    );
  }

  /** The chosen trees, in the order of the section. */
  get chosenTrees(): readonly SavedTree[] {
    return (this.pages.items.value ?? []).filter(({ id }) => this.chosen.value?.has(id));
  }

  /** Chooses a tree, or no longer. */
  toggle(id: string): void {
    const chosen = new Set(this.chosen.peek() ?? []);
    if (!chosen.delete(id)) {
      chosen.add(id);
    }
    this.chosen.value = chosen;
  }

  /** Changes a tree's name, note or tags. */
  async change(tree: SavedTree, change: Pick<ChangeTree, "name" | "note" | "tags">): Promise<void> {
    await this.#each([tree], async ({ id }) => this.pages.replace(id, await this.#options.api.changeTree(id, change)));
  }

  /** Makes a tree a favourite, or no longer; it stays where it is until the list is asked for anew. */
  async star(tree: SavedTree): Promise<void> {
    const favourite = !tree.favourite;
    await this.#each([tree], async ({ id }) => {
      await this.#options.api.setFavourite(id, favourite);
      this.pages.replace(id, { ...tree, favourite });
    });
  }

  /** Has trees lie in a collection, or in none. */
  async move(trees: readonly SavedTree[], to: { readonly id: string; readonly name: string } | null): Promise<void> {
    const { show } = this.#options;
    const moved = trees.filter(({ collection }) => (collection ?? "") !== (to?.id ?? ""));
    if (moved.length === 0) {
      show(say(to === null ? "library.move.lies-in-none" : "library.move.lies-there", { collection: to?.name ?? "" }));
      return;
    }
    const done = await this.#each(moved, (tree) => this.#lay(tree, to?.id));
    if (done.length > 0) {
      show(
        to === null ? outcome("moved-out", done) : outcome("moved", done, { collection: to.name }),
        undo(async () => void (await this.#each(done, (tree) => this.#lay(tree, tree.collection)))),
      );
    }
  }

  async mark(trees: readonly SavedTree[], template: boolean): Promise<void> {
    const { api, show } = this.#options;
    const done = await this.#each(trees, async ({ id }) => {
      await api.changeTree(id, { template });
      this.pages.replace(id, null);
    });
    if (done.length > 0) {
      show(
        outcome(template ? "template" : "no-template", done),
        undo(() => this.#unmark(done, !template)),
      );
    }
  }

  async duplicate(trees: readonly SavedTree[]): Promise<void> {
    const { api, said, show } = this.#options;
    const done = await this.#each(trees, async ({ id, name }) => {
      const copy = say("library.copy-of", { name });
      const made = await api.copyTree(id, { name: copy.length > MAX_NAME_CHARACTERS ? name : copy, ...said() });
      if (this.name === "trees") {
        this.pages.begin(made);
      }
    });
    if (done.length > 0) {
      show(outcome("duplicated", done));
    }
  }

  /** Deletes trees; they can be taken back. */
  async remove(trees: readonly SavedTree[]): Promise<void> {
    const { api, show } = this.#options;
    const done = await this.#each(trees, async ({ id }) => {
      await api.deleteTree(id);
      this.pages.replace(id, null);
    });
    if (done.length > 0) {
      show(
        outcome("deleted", done),
        undo(() => this.takeBack(done)),
      );
    }
  }

  /** Deletes one that was deleted, so that it cannot be taken back. */
  async removeForGood(tree: SavedTree): Promise<void> {
    const { api, show } = this.#options;
    const done = await this.#each([tree], async ({ id }) => {
      await api.deleteTreeForGood(id);
      this.pages.replace(id, null);
    });
    if (done.length > 0) {
      show(outcome("gone", done));
    }
  }

  /** Takes deleted trees back. */
  async takeBack(trees: readonly SavedTree[]): Promise<void> {
    const done = await this.#each(trees, async ({ id }) => this.#returned(await this.#options.api.undeleteTree(id)));
    if (done.length > 0) {
      this.#options.show(outcome("back", done));
    }
  }

  async #lay({ id }: SavedTree, collection = ""): Promise<void> {
    const tree = await this.#options.api.changeTree(id, { collection });
    const listed = this.#options.wanted().collection;
    if (listed !== null && listed !== collection) {
      this.pages.replace(id, null);
    } else if (this.pages.items.peek()?.some((other) => other.id === id)) {
      this.pages.replace(id, tree);
    } else {
      this.pages.begin(tree);
    }
  }

  async #unmark(trees: readonly SavedTree[], template: boolean): Promise<void> {
    await this.#each(trees, async ({ id }) => this.#returned(await this.#options.api.changeTree(id, { template })));
  }

  /** A tree is where it was before: on this section, unless this is that of deleted ones. */
  #returned(tree: SavedTree): void {
    if (this.name === "deleted") {
      this.pages.replace(tree.id, null);
    } else {
      this.pages.begin(tree);
    }
  }

  /** Does something with each of some trees, until it is stopped or fails; gives those with which it was done. */
  async #each(trees: readonly SavedTree[], act: (tree: SavedTree) => Promise<void>): Promise<readonly SavedTree[]> {
    const { show } = this.#options;
    const done: SavedTree[] = [];
    if (this.work.progress.peek() !== null) {
      show(say("library.busy"));
      return done;
    }
    try {
      await this.work.run(async (stop, tell) => {
        for (const tree of trees) {
          stop.throwIfAborted();
          tell({ bytes: done.length, total: trees.length });
          await act(tree);
          done.push(tree);
        }
      });
    } catch (error) {
      show(sentence(error));
    }
    this.chosen.value = null;
    return done;
  }
}

const undo = (act: () => Promise<void>): ToastAction => ({ label: say("library.undo"), act: () => void act() });

function outcome(
  what: "template" | "no-template" | "duplicated" | "deleted" | "gone" | "back" | "moved" | "moved-out",
  trees: readonly SavedTree[],
  values: Readonly<Record<string, string>> = {},
): string {
  const [only] = trees;
  return trees.length === 1 && only
    ? say(`library.${what}.one`, { ...values, name: only.name })
    : say(`library.${what}.some`, { ...values, count: trees.length });
}
