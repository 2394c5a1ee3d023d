import { computed, type ReadonlySignal, type Signal } from "@preact/signals";
import type { NewSession, SavedTree, SessionCreated } from "../../wire/generated";
import type { SheetName } from "../page/layout";
import type { Key } from "../words/say";
import type { UnsavedTrees } from "./unsaved-trees";

/** The device remembers the names of so many trees. */
const KEPT_NAMES = 50;

/** What a tree of the library is opened as. */
export interface Start {
  readonly tree: Pick<SavedTree, "id" | "name">;
  /** The version to begin with; the newest one, or where others work, if absent. */
  readonly version?: number;
  /** Whether it is only what a tree of its own begins with. */
  readonly template?: boolean;
}

export interface TreesOptions {
  readonly link: {
    readonly session: ReadonlySignal<string | null>;
    change(request?: NewSession): Promise<SessionCreated | null>;
    reopen(session: string): Promise<"opened" | "gone" | "failed">;
  };
  readonly unsaved: Pick<UnsavedTrees, "isUnsaved" | "keep" | "opened" | "forget">;
  /** What the trees of this device are called, by their sessions. */
  readonly names: Signal<Readonly<Record<string, string>>>;
  readonly sheet: Signal<SheetName | null>;
  readonly say: (text: Key) => void;
}

/** The tree on the page: what it is called, and the ways from it to another one. */
export class Trees {
  /** What the tree was saved or opened as on this device; null if it was not. */
  readonly name: ReadonlySignal<string | null>;
  #options: TreesOptions;

  constructor(options: TreesOptions) {
    this.#options = options;
    this.name = computed(() => options.names.value[options.link.session.value ?? ""] ?? null);
  }

  /** What the tree is called from now on. */
  call(name: string): void {
    const { link, names } = this.#options;
    const session = link.session.peek();
    if (session !== null) {
      const others = Object.entries(names.peek()).slice(1 - KEPT_NAMES);
      names.value = { ...Object.fromEntries(others), [session]: name };
    }
  }

  /** Begins a new tree; where the one on the page is not saved, the user is first asked where it stays. */
  begin(): void {
    if (this.#options.unsaved.isUnsaved) {
      this.#options.sheet.value = "leave";
    } else {
      void this.leave();
    }
  }

  /**
   * Leaves this tree for a new one, empty or from the library; true once it is there. What is not saved is kept under
   * Unsaved, unless the user would not have it.
   */
  async leave(start?: Start, keeps = true): Promise<boolean> {
    const { link, unsaved } = this.#options;
    const created = await this.#leave(keeps, () => link.change(start && requestOf(start)));
    if (created !== null && start !== undefined) {
      // Where others work on it, it may not be saved as it is.
      if (created.tree?.saved !== false) {
        unsaved.opened(created.session);
      }
      if (start.template !== true) {
        this.call(start.tree.name);
      }
    }
    return created !== null;
  }

  /** Goes on with a tree that was left. */
  async goOnWith(session: string): Promise<void> {
    const { link, unsaved, say } = this.#options;
    await this.#leave(true, async () => {
      const came = await link.reopen(session);
      if (came === "gone") {
        unsaved.forget(session);
        say("notices.unsaved-gone");
      }
      return came === "opened" || null;
    });
  }

  /** Leaves this session for another one; null if there is none to be had. */
  async #leave<Opened>(keeps: boolean, open: () => Promise<Opened | null>): Promise<Opened | null> {
    const { unsaved, sheet, say } = this.#options;
    const from = sheet.peek();
    const kept = keeps && (await unsaved.keep());
    const opened = await open();
    if (opened === null) {
      return null;
    }
    // The user may have closed the sheet meanwhile and opened another one.
    if (sheet.peek() === from) {
      sheet.value = null;
    }
    if (kept) {
      say("notices.kept-unsaved");
    }
    return opened;
  }
}

function requestOf({ tree, version, template }: Start): NewSession {
  return {
    tree: tree.id,
    ...(version === undefined ? {} : { version }),
    ...(template === undefined ? {} : { template }),
  };
}
