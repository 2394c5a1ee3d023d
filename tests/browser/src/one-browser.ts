import { type Browser, chromium } from "playwright-core";
import { inject } from "vitest";
import type { TestProject } from "vitest/node";
import { serveBrowser } from "./browser";

declare module "vitest" {
  interface ProvidedContext {
    /** The address of the browser that all files use. */
    readonly browser: string;
  }
}

/** Vitest's global set-up: one browser for all files, which shares what it has compiled among their pages. */
export default async function setup(project: TestProject): Promise<() => Promise<void>> {
  const browser = await serveBrowser();
  project.provide("browser", browser.wsEndpoint());
  return () => browser.close();
}

/** That browser; closing it closes the pages that were opened here. */
export function theBrowser(): Promise<Browser> {
  return chromium.connect(inject("browser"));
}
