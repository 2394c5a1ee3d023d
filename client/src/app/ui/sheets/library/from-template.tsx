import type { Studio } from "../../../studio";
import { say } from "../../../words/say";

/** The way to the trees that a new one can begin with. */
export function FromTemplate({ studio }: { studio: Studio }) {
  return (
    <button
      type="button"
      class="small from-template"
      onClick={() => {
        studio.layout.section.value = "templates";
        studio.layout.sheet.value = "library";
      }}
    >
      {say("sheets.from-template")}
    </button>
  );
}
