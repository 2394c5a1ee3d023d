import type { GrammarEditing } from "../../../document/grammar/grammar-editing";
import { titleOf } from "../../../document/grammar/typed";
import { fileName } from "../../../library/file-name";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { ENDINGS } from "./grammar-endings";
import { tab } from "./tab";

/** What a file field takes; many devices know none of these endings, so that plain text is offered as well. */
export const ACCEPTED = [...ENDINGS, ".txt", "text/plain"].join(",");
/** Bytes of a grammar at most. */
const MOST_BYTES = 128 * 1024;

/** Opens a grammar from a file of the device. */
export async function openGrammar(studio: Studio, editing: GrammarEditing, file: File | undefined): Promise<void> {
  if (!file) {
    return;
  }
  const explain = (key: "grammars.too-long" | "grammars.no-text") => studio.toasts.show(say(key, { file: file.name }));
  if (file.size > MOST_BYTES) {
    explain("grammars.too-long");
    return;
  }
  try {
    const text = new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
    openText(studio, editing, text.replace(/\r\n?/g, "\n"));
  } catch {
    explain("grammars.no-text");
  }
}

/** Opens a grammar's text in the editor; what stood there can be brought back. */
export function openText(studio: Studio, editing: GrammarEditing, text: string): void {
  replaceText(studio, editing, text);
  tab.value = "text";
}

/** Opens a text that was put aside; what stood in the editor can be brought back. */
export function takeUp(studio: Studio, editing: GrammarEditing, text: string): void {
  editing.takeUp(text);
  tab.value = "text";
  offerAside(studio, editing);
}

/** Puts a text in the place of the one that stands in the editor, and says so where that is lost to the tree. */
export function replaceText(studio: Studio, editing: GrammarEditing, text: string): void {
  editing.open(text);
  offerAside(studio, editing);
}

/** Says that a text was put aside, if one was, with a way back to it. */
export function offerAside(studio: Studio, editing: GrammarEditing): void {
  const before = editing.setAside.peek();
  if (before !== null) {
    studio.toasts.show(say("grammars.taken"), {
      label: say("grammars.bring-back"),
      act: () => takeUp(studio, editing, before.text),
    });
  }
}

/** Saves a grammar as a file. */
export function saveGrammar(text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type: "text/plain;charset=utf-8" }));
  const link = document.createElement("a");
  link.href = address;
  link.download = fileName(titleOf(text) ?? "grammar", "lsys");
  link.click();
  URL.revokeObjectURL(address);
}
