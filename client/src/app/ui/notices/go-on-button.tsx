import { useState } from "preact/hooks";
import { goOn } from "../../document/growth/go-on";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** Has that tried again which the server did not outlive. */
export function GoOn({ studio, look = "chip-stop", then }: { studio: Studio; look?: string; then?: () => void }) {
  const [asking, setAsking] = useState(false);
  const act = async () => {
    const session = studio.link.session.value;
    if (session === null) {
      return;
    }
    setAsking(true);
    try {
      await goOn(session);
      then?.();
    } catch (error) {
      studio.toasts.show(await explained(error));
    } finally {
      setAsking(false);
    }
  };
  return (
    <button type="button" class={look} disabled={asking} onClick={() => void act()}>
      {say("notices.go-on")}
    </button>
  );
}
