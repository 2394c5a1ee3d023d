import { useRef } from "preact/hooks";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { copyText } from "../share/copy-text";

interface SecretFieldProps {
  readonly studio: Studio;
  readonly label: string;
  readonly text: string;
}

/** A text that is to be passed on, with a way to copy it. */
export function SecretField({ studio, label, text }: SecretFieldProps) {
  const field = useRef<HTMLInputElement>(null);
  const copy = async () => {
    studio.toasts.show(say((await copyText(text, field.current)) ? "accounts.copied" : "accounts.marked"));
  };
  return (
    <div class="secret">
      <label class="field">
        <span>{label}</span>
        <input ref={field} type="text" readOnly value={text} onFocus={(event) => event.currentTarget.select()} />
      </label>
      <button type="button" class="small" aria-label={`${say("accounts.copy")}: ${label}`} onClick={() => void copy()}>
        {say("accounts.copy")}
      </button>
    </div>
  );
}
