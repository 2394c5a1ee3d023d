import type { BrowserContext } from "playwright-core";

/**
 * How long whatever takes longest in a test may take, in milliseconds, on a machine that is slow or has much else to do. It
 * only guards against hanging.
 */
export const PATIENCE = 150_000;

/** Has whatever the pages of a context are asked for take so long. */
export function bePatient(context: BrowserContext): void {
  context.setDefaultTimeout(PATIENCE);
}
