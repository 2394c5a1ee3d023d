import type { DesignEditing } from "../../../document/design/design-editing";
import type { DesignModel } from "../../../document/design/design-model";
import { say } from "../../../words/say";

/** Reads a design from the file that was picked. */
export async function openGraph(
  input: HTMLInputElement,
  editing: DesignEditing,
  explain: (text: string) => void,
): Promise<void> {
  const file = input.files?.[0];
  input.value = "";
  if (!file) {
    return;
  }
  try {
    editing.open(JSON.parse(await file.text()));
  } catch {
    explain(say("structure.no-json", { file: file.name }));
  }
}

/** Saves a design as a file. */
export function downloadGraph(model: DesignModel): void {
  const address = URL.createObjectURL(
    new Blob([`${JSON.stringify(model.graph, null, 2)}\n`], { type: "application/json" }),
  );
  const link = document.createElement("a");
  link.href = address;
  link.download = "design.json";
  link.click();
  URL.revokeObjectURL(address);
}
