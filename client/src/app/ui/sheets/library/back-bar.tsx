import type { Studio } from "../../../studio";
import { say } from "../../../words/say";

interface BackBarProps {
  readonly studio: Studio;
  /** What the sheet is about. */
  readonly title: string;
  /** Where it was opened. */
  readonly to?: "library" | "share" | "people";
}

const WORDS = { library: "library.to-library", share: "gifts.back", people: "gifts.back.people" } as const;

/** The way back to the library, or to what else it was opened from, from a sheet about one thing of it. */
export function BackBar({ studio, title, to = "library" }: BackBarProps) {
  return (
    <div class="library-bar">
      <button
        type="button"
        class="small"
        onClick={() => {
          studio.layout.sheet.value = to;
        }}
      >
        {say(WORDS[to])}
      </button>
      <strong class="library-title">{title}</strong>
    </div>
  );
}
