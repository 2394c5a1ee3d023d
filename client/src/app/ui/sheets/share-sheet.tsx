import { useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** Gives the link under which others see and draw the same tree. */
export function ShareSheet({ studio }: { studio: Studio }) {
  const field = useRef<HTMLInputElement>(null);
  const link = `${location.origin}/s/${encodeURIComponent(studio.link.session.value ?? "")}`;
  const onlyHere = /^(localhost|127\.|\[::1\])/.test(location.host);

  const copy = async () => {
    studio.toasts.show(say((await copyText(link, field.current)) ? "sheets.share.copied" : "sheets.share.marked"));
  };

  return (
    <div class="stack">
      <p>{say("sheets.share.advice")}</p>
      <div class="link">
        <input
          ref={field}
          type="text"
          readOnly
          aria-label={say("sheets.share.link")}
          value={link}
          onFocus={(event) => event.currentTarget.select()}
        />
        <button type="button" class="primary" onClick={copy}>
          {say("sheets.share.copy")}
        </button>
      </div>
      {onlyHere && <p class="quiet">{say("sheets.share.only-here")}</p>}
    </div>
  );
}

/** Copies a text; on plain http the clipboard is closed to pages, and the old way through a field still works. */
async function copyText(text: string, field: HTMLInputElement | null): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    field?.focus();
    field?.select();
    return document.execCommand("copy");
  }
}
