import { useEffect, useRef, useState } from "preact/hooks";
import { type Folder, pathOf } from "../../../library/catalogue";
import { say } from "../../../words/say";
import { Pick } from "./pick";

interface MoveFormProps {
  readonly label: string;
  readonly folders: readonly Folder[];
  /** The collection it lies in; empty for none. */
  readonly value: string;
  readonly onMove: (to: string) => void;
  readonly onEnd: () => void;
}

/** A row in which it is chosen where something shall lie. */
export function MoveForm({ label, folders, value, onMove, onEnd }: MoveFormProps) {
  const [to, setTo] = useState(value);
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.querySelector("select")?.focus(), []);
  return (
    <form
      class="card-form"
      ref={form}
      onSubmit={(event) => {
        event.preventDefault();
        if (to !== value) {
          onMove(to);
        }
        onEnd();
      }}
      onKeyDown={(event) => {
        if (event.key === "Escape") {
          event.preventDefault();
          onEnd();
        }
      }}
    >
      <Pick label={label} value={to} options={placesIn(folders)} onPick={setTo} />
      <button type="button" class="small" onClick={onEnd}>
        {say("library.cancel")}
      </button>
      <button type="submit" class="primary">
        {say("finding.move.do")}
      </button>
    </form>
  );
}

/** Where something can lie: in no collection, or in one of these. */
export function placesIn(folders: readonly Folder[]): readonly (readonly [string, string])[] {
  return [["", say("finding.nowhere")], ...folders.map((folder) => [folder.id, pathOf(folder)] as const)];
}
