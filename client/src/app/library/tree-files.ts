import { signal } from "@preact/signals";
import { IMPORT_ENDINGS, MAX_NAME_CHARACTERS, MAX_WOOD_BYTES, type SavedTree } from "../../wire/generated";
import type { ToastAction } from "../page/toasts";
import { sentence } from "../problems/plain-words";
import { send } from "../requests/send";
import { type Progress, Transfer } from "../requests/transfer";
import { say } from "../words/say";
import { fieldsOf, isScan, METRES, type ScanUnits } from "./scan-units";

const MEGABYTE = 1024 * 1024;

/** What a file of the device is, of which no more is read before it is sent. */
export type TreeFile = Pick<File, "name" | "size" | "arrayBuffer">;

export interface Taking {
  readonly show: (text: string, action?: ToastAction) => void;
  readonly open: (tree: SavedTree) => void;
}

/** Posts a file and gives what became of it. */
export type Post = typeof send;

/** Files of this device that become trees of the library, one after another. */
export class TreeFiles {
  readonly transfer = new Transfer();
  /** The last tree that came of one. */
  readonly added = signal<SavedTree | null>(null);
  /** The units in which scans are taken. */
  readonly units = signal<ScanUnits>(METRES);
  /** The species that scans are taken as, by its short name; empty for what they say themselves. */
  readonly species = signal("");
  /** The last file that was taken so, which can be taken again otherwise. */
  readonly scan = signal<TreeFile | null>(null);
  #post: Post;

  constructor(post: Post = send) {
    this.#post = post;
  }

  /** Sends files to the library; shows why one of them is no tree, and goes on with the others. */
  async take(files: readonly TreeFile[], { show, open }: Taking): Promise<void> {
    if (this.transfer.progress.peek() !== null) {
      show(say("library.busy-file"));
      return;
    }
    await this.transfer.run(async (stop, tell) => {
      for (const file of files) {
        stop.throwIfAborted();
        try {
          const tree = await this.#send(file, stop, tell);
          this.added.value = tree;
          const notes = tree.import_notes?.map(({ note, found = "" }) => say(`library.note.${note}`, { found })) ?? [];
          show([say("library.added", { name: tree.name }), ...notes].join(". "), {
            label: say("library.open"),
            act: () => open(tree),
          });
        } catch (error) {
          stop.throwIfAborted();
          show(say("library.not-added", { file: file.name, reason: sentence(error) }));
        }
      }
    });
  }

  async #send(file: TreeFile, stop: AbortSignal, tell: (progress: Progress) => void): Promise<SavedTree> {
    const format = endingOf(file.name);
    if (!IMPORT_ENDINGS.some((ending) => ending === format)) {
      throw new Error(say("library.file.kind", { endings: accepted().replaceAll(",", ", ") }));
    }
    if (file.size > MAX_WOOD_BYTES) {
      throw new Error(say("library.file.too-large", { limit: MAX_WOOD_BYTES / MEGABYTE }));
    }
    let taken: Readonly<Record<string, string>> = {};
    if (isScan(format)) {
      if (this.scan.peek()?.name !== file.name) {
        // What was chosen for another scan says nothing of this one.
        this.species.value = "";
      }
      this.scan.value = file;
      const species = this.species.peek();
      taken = { ...fieldsOf(this.units.peek()), ...(species === "" ? {} : { species }) };
    }
    const path = `/api/v1/trees/import?${new URLSearchParams({ name: nameOf(file.name), format, ...taken })}`;
    const body = new Uint8Array(await file.arrayBuffer());
    return (await this.#post(path, { type: "application/octet-stream", body }, stop, tell)) as SavedTree;
  }
}

/** The files of this page. */
export const treeFiles = new TreeFiles();

/** How the names of files end that become trees, as a field for files takes it. */
export function accepted(): string {
  return IMPORT_ENDINGS.map((ending) => `.${ending}`).join(",");
}

function endingOf(name: string): string {
  return name.slice(name.lastIndexOf(".") + 1).toLowerCase();
}

/** What a tree of a file is called. */
function nameOf(file: string): string {
  const plain = file.slice(0, Math.max(0, file.lastIndexOf("."))).trim();
  return [...(plain || file)].slice(0, MAX_NAME_CHARACTERS).join("");
}
