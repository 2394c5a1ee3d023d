import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { ShowIcon } from "../icons";

/** The one thing left when everything is hidden: what brings it back. */
export function ShowAll({ studio }: { studio: Studio }) {
  return (
    <button
      type="button"
      class="tool show-all"
      aria-label={say("bars.show")}
      title={say("bars.show")}
      onClick={() => {
        studio.layout.bare.value = false;
      }}
    >
      <ShowIcon />
    </button>
  );
}
