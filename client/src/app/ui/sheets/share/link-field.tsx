import { useRef } from "preact/hooks";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { copyText } from "./copy-text";

interface LinkFieldProps {
  readonly studio: Studio;
  /** What it leads to. */
  readonly label: string;
  readonly link: string;
}

/** A link to be copied, or handed to another app where the device can do that. */
export function LinkField({ studio, label, link }: LinkFieldProps) {
  const field = useRef<HTMLInputElement>(null);
  const mark = async () => {
    studio.toasts.show(say((await copyText(link, field.current)) ? "sheets.share.copied" : "sheets.share.marked"));
  };
  const send = async () => {
    try {
      await navigator.share({ url: link });
    } catch (error) {
      // Who thinks better of it need not be told.
      if (!(error instanceof DOMException && error.name === "AbortError")) {
        await mark();
      }
    }
  };
  return (
    <div class="link">
      <input
        ref={field}
        type="text"
        readOnly
        aria-label={label}
        value={link}
        onFocus={(event) => event.currentTarget.select()}
      />
      <div class="actions">
        {maySend(link) && (
          <button type="button" class="small" onClick={() => void send()}>
            {say("sheets.share.send")}
          </button>
        )}
        <button type="button" class="primary" onClick={() => void mark()}>
          {say("sheets.share.copy")}
        </button>
      </div>
    </div>
  );
}

/** Browsers share links on https only, and not all of them. */
function maySend(link: string): boolean {
  return typeof navigator.share === "function" && (navigator.canShare?.({ url: link }) ?? true);
}
