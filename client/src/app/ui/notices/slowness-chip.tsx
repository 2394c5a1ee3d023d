import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { SLOWNESS } from "../../words/slowness";
import { CloseIcon } from "../icons";

/** Why the picture is coarse, until it has been read. */
export function SlownessChip({ studio }: { studio: Studio }) {
  const slowness = studio.slowness.value;
  if (slowness === null || studio.settings.slownessRead.value) {
    return null;
  }
  return (
    <p class="chip" data-slowness={slowness}>
      {say(SLOWNESS[slowness])}
      <button
        type="button"
        aria-label={say(SLOWNESS.close)}
        title={say(SLOWNESS.close)}
        onClick={() => {
          studio.settings.slownessRead.value = true;
        }}
      >
        <CloseIcon />
      </button>
    </p>
  );
}
