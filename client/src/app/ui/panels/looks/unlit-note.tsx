import type { Studio } from "../../../studio";
import { say } from "../../../words/say";

/** Says why what is set here cannot be seen, where the tree is drawn in false colours, and leads back. */
export function UnlitNote({ studio }: { studio: Studio }) {
  const mode = studio.drawMode.value;
  if (mode === "lit") {
    return null;
  }
  return (
    <div class="unlit-note" role="status">
      <p>{say("drawmode.unseen", { mode: say(`drawmode.${mode}`) })}</p>
      <button
        type="button"
        class="small"
        onClick={() => {
          studio.drawMode.value = "lit";
        }}
      >
        {say("drawmode.back")}
      </button>
    </div>
  );
}
