import type { Signal } from "@preact/signals";
import { MAX_THUMBNAIL_BYTES } from "../../wire/generated";
import type { Stage } from "../view/stage";
import { type Belonging, type Saving, saveNext } from "./belonging";
import { saveTree } from "./library-api";
import type { Trees } from "./trees";
import type { UnsavedTrees } from "./unsaved-trees";

/** Characters of the largest picture that is not refused, as base64. */
const MAX_PICTURE = Math.ceil(MAX_THUMBNAIL_BYTES / 3) * 4;

/** The parts of a page that saving concerns. */
export interface SavedFrom {
  readonly stage: Pick<Stage, "thumbnail">;
  readonly unsaved: Pick<UnsavedTrees, "saved">;
  readonly trees: Pick<Trees, "call">;
  readonly settings: { readonly author: Signal<string> };
}

/** What is said of a version, and by whom; empty if nothing is. */
export interface Said {
  readonly note?: string;
  readonly author?: string;
}

/** Saves the tree of a session in the library as a new one, with its picture. */
export async function saveAsNew(page: SavedFrom, session: string, name: string, note = ""): Promise<void> {
  await saveTree({ session, name, ...said(page, note), ...(await picture(page.stage)) });
  saved(page, name);
}

/** Saves it as the next version of the tree that it belongs to. */
export async function saveAsNext(page: SavedFrom, session: string, of: Belonging, note = ""): Promise<Saving> {
  const saving = await saveNext(of, { session, ...said(page, note), ...(await picture(page.stage)) });
  if ("version" in saving) {
    saved(page, of.tree.name);
  }
  return saving;
}

/** What whoever is at the page says of what they save. */
export function said({ settings }: Pick<SavedFrom, "settings">, note = ""): Said {
  const [words, author] = [note.trim(), settings.author.peek().trim()];
  return { ...(words === "" ? {} : { note: words }), ...(author === "" ? {} : { author }) };
}

function saved(page: SavedFrom, name: string): void {
  page.unsaved.saved();
  page.trees.call(name);
}

/** The largest picture that fits; a tree can be saved without one. */
async function picture(stage: Pick<Stage, "thumbnail">): Promise<{ thumbnail?: string }> {
  for (const size of [512, 384, 256]) {
    const thumbnail = await stage.thumbnail(size).catch(() => undefined);
    if (thumbnail === undefined) {
      return {};
    }
    if (thumbnail.length - thumbnail.indexOf(",") - 1 <= MAX_PICTURE) {
      return { thumbnail };
    }
  }
  return {};
}
