import type { Browser, BrowserContext } from "playwright-core";

/** What the console says where WebGL or three.js finds a fault; the picture may look whole all the same. */
const FAULT = /webgl|GL_|THREE\./i;
/**
 * What is no fault: that pixels which are read are waited for, that the emulated card has not all extensions, and that what
 * a lost context took along is let go of once there is another.
 */
const ADVICE =
  /GL Driver Message \([^)]*Performance|extension not supported|delete: object does not belong to this context/;

const found: string[] = [];

/** Has each test fail during which a page of this browser reports a fault of WebGL or of a shader. */
export function watchDrawing(browser: Browser): Browser {
  for (const context of browser.contexts()) watch(context);
  return browser.on("context", watch);
}

/** The faults since they were last taken: a test that causes one takes it. */
export function takeDrawingFaults(): string[] {
  return found.splice(0);
}

function watch(context: BrowserContext): void {
  context.on("console", (message) => {
    const text = message.text();
    const isFault = ["error", "warning"].includes(message.type()) && FAULT.test(text) && !ADVICE.test(text);
    if (isFault) found.push(`${message.page()?.url() ?? ""}: ${text}`);
  });
}
