import type { Studio } from "../../../studio";
import { say } from "../../../words/say";

interface BackBarProps {
  readonly studio: Studio;
  /** What the sheet is about. */
  readonly title: string;
}

/** The way back to the library from a sheet about one thing of it. */
export function BackBar({ studio, title }: BackBarProps) {
  return (
    <div class="library-bar">
      <button
        type="button"
        class="small"
        onClick={() => {
          studio.layout.sheet.value = "library";
        }}
      >
        {say("library.to-library")}
      </button>
      <strong class="library-title">{title}</strong>
    </div>
  );
}
