import { type ShownName, switched, USUAL } from "../../../scene/mode/shown";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** Switches a part of how the picture is drawn, or all of them back to what is usual, and says so. */
export function switchShown({ settings, toasts }: Pick<Studio, "settings" | "toasts">, name: ShownName | null): void {
  const { shown } = settings;
  if (name === null) {
    shown.value = USUAL;
    toasts.show(say("shown.usual"));
    return;
  }
  shown.value = switched(shown.peek(), name);
  toasts.show(say(shown.peek()[name] ? "shown.on" : "shown.off", { what: say(`shown.${name}`) }));
}
