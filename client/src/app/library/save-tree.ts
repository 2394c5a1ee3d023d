import type { Stage } from "../view/stage";
import { saveTree } from "./library-api";
import type { Trees } from "./trees";
import type { UnsavedTrees } from "./unsaved-trees";

/** A picture larger than this would be refused; the limit is 192 KiB. */
const MAX_PICTURE = 190 * 1024;

/** The parts of a page that saving concerns. */
export interface SavedFrom {
  readonly stage: Pick<Stage, "thumbnail">;
  readonly unsaved: Pick<UnsavedTrees, "saved">;
  readonly trees: Pick<Trees, "call">;
}

/** Saves the tree of a session in the library, with its picture. */
export async function saveWithPicture(page: SavedFrom, session: string, name: string): Promise<void> {
  const thumbnail = await picture(page.stage);
  await saveTree({ session, name, ...(thumbnail === undefined ? {} : { thumbnail }) });
  page.unsaved.saved();
  page.trees.call(name);
}

/** The largest picture that fits; a tree can be saved without one. */
async function picture(stage: Pick<Stage, "thumbnail">): Promise<string | undefined> {
  for (const size of [512, 384, 256]) {
    const url = await stage.thumbnail(size).catch(() => undefined);
    if (url === undefined || url.length <= MAX_PICTURE) {
      return url;
    }
  }
  return undefined;
}
