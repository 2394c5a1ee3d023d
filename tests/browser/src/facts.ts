import type { Page } from "playwright-core";

/** What the page tells about itself on `<html>`. */
export interface Facts {
  readonly connection: string;
  readonly metamers: number;
  readonly rows: number;
  readonly sent: number;
  readonly acknowledged: number;
  readonly pending: number;
  readonly step: number;
  /** The tool at hand, by the page's name for it. */
  readonly tool: string;
  /** The row of the branch that alone grows; empty if all do. */
  readonly bud: string;
  readonly obstacles: number;
  /** The present step of the line of time, and its last. */
  readonly present: number;
  readonly lastStep: number;
  /** What was done on it, in order, and how much of it is in force. */
  readonly operations: string;
  readonly done: number;
  readonly futures: number;
  /** The row that the branch begins with that is held; empty if none is. */
  readonly branch: string;
  /** How many steps the prediction beside the tree has grown; empty if there is none. */
  readonly ghost: string;
}

/** Reads them. */
export async function factsOf(page: Page): Promise<Facts> {
  return page.evaluate(() => {
    const facts = document.documentElement.dataset;
    const number = (name: string) => Number(facts[name] ?? -1);
    return {
      connection: facts.connection ?? "",
      metamers: number("metamers"),
      rows: number("rows"),
      sent: number("sent"),
      acknowledged: number("acknowledged"),
      pending: number("pending"),
      step: number("step"),
      tool: facts.tool ?? "",
      bud: facts.bud ?? "",
      obstacles: number("obstacles"),
      present: number("present"),
      lastStep: number("lastStep"),
      operations: facts.operations ?? "",
      done: number("done"),
      futures: number("futures"),
      branch: facts.branch ?? "",
      ghost: facts.ghost ?? "",
    };
  });
}
