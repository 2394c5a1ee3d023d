import { mayReload } from "../connection/reload-guard";

/** Whether the server has another build of the page than the one that runs; false where it does not answer. */
export async function isReplaced(ownScript: string | null = scriptOf(document), page = fetchPage): Promise<boolean> {
  try {
    const source = await page();
    return ownScript !== null && !source.includes(ownScript);
  } catch {
    return false;
  }
}

/** Whether the server sends its page. */
export function serverAnswers(): Promise<boolean> {
  return fetchPage().then(
    () => true,
    () => false,
  );
}

/** Loads the page again. */
export function reload(): void {
  location.reload();
}

/** The same, unless that was done a moment ago and has not helped. */
export function reloadOnce(): void {
  if (mayReload(sessionStorage, Date.now())) {
    reload();
  }
}

/** The address of the page's own script, whose name has a hash of its content. */
function scriptOf(page: Document): string | null {
  return page.querySelector('script[type="module"][src]')?.getAttribute("src") ?? null;
}

async function fetchPage(): Promise<string> {
  const answer = await fetch(location.pathname, { cache: "no-store", headers: { accept: "text/html" } });
  if (!answer.ok) {
    throw new Error(`The page was answered with status ${answer.status}.`);
  }
  return answer.text();
}
