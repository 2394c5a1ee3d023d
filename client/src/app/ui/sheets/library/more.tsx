import { useEffect, useRef } from "preact/hooks";
import type { Pages } from "../../../library/pages";
import { sentence } from "../../../problems/plain-words";
import { say } from "../../../words/say";

/** The end of a long list: what lies behind it comes when it is scrolled to, or asked for; or why it does not come. */
export function More<Item>({ pages }: { readonly pages: Pages<Item> }) {
  const [items, failure] = [pages.items.value, pages.failure.value];
  return (
    <>
      {items === null && failure === null && <p class="quiet empty">{say("notices.looking")}</p>}
      {failure !== null && (
        <p class="quiet empty" role="status">
          {sentence(failure)}
        </p>
      )}
      {(failure !== null || (items !== null && pages.more.value)) && <End pages={pages} />}
    </>
  );
}

function End<Item>({ pages }: { readonly pages: Pages<Item> }) {
  const end = useRef<HTMLButtonElement>(null);
  const [items, asking] = [pages.items.value, pages.asking.value];
  useEffect(() => {
    // After a failure only who asks is answered, or a server that is away would be asked all the time.
    if (!end.current || pages.failure.peek() !== null) {
      return undefined;
    }
    const watcher = new IntersectionObserver(
      ([seen]) => {
        if (seen?.isIntersecting) {
          void pages.next();
        }
      },
      { rootMargin: "300px" },
    );
    watcher.observe(end.current);
    return () => watcher.disconnect();
  }, [pages, items]);
  return (
    <button type="button" class="small library-more" ref={end} disabled={asking} onClick={() => void pages.next()}>
      {say(asking ? "notices.looking" : pages.failure.value === null ? "sheets.library.more" : "sheets.library.again")}
    </button>
  );
}
