import { useRef } from "preact/hooks";
import type { Studio } from "../studio";
import { Sheet } from "./sheet";

/** Gives the link under which others see and draw the same tree. */
export function ShareSheet({ studio }: { studio: Studio }) {
  const field = useRef<HTMLInputElement>(null);
  const link = `${location.origin}/s/${encodeURIComponent(studio.session.value ?? "")}`;
  const onlyHere = /^(localhost|127\.|\[::1\])/.test(location.host);

  const copy = async () => {
    studio.toasts.show((await copyText(link, field.current)) ? "Link copied" : "Copy the marked link");
  };

  return (
    <Sheet studio={studio} title="Draw together">
      <div class="stack">
        <p>Whoever opens this link sees the same tree grow, and may draw on it.</p>
        <div class="link">
          <input
            ref={field}
            type="text"
            readOnly
            aria-label="Link to this tree"
            value={link}
            onFocus={(event) => event.currentTarget.select()}
          />
          <button type="button" class="primary" onClick={copy}>
            Copy link
          </button>
        </div>
        {onlyHere && (
          <p class="quiet">
            This link works on this machine only. For a tablet, open the network address the server printed when it
            started, and share from there.
          </p>
        )}
      </div>
    </Sheet>
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
