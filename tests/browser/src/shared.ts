import { type Browser, chromium } from "playwright-core";
import { inject } from "vitest";
import type { TestProject } from "vitest/node";
import { serveBrowser } from "./browser";
import { Server, ServerAt } from "./server";

declare module "vitest" {
  interface ProvidedContext {
    /** The address of the browser that all files use. */
    readonly browser: string;
    /** That of the server which all files use that neither stop it nor want its library for themselves. */
    readonly server: string;
  }
}

/**
 * Vitest's global set-up: one browser, which shares what it has compiled among all pages, and one server, which draws the
 * pictures of species once.
 */
export default async function setup(project: TestProject): Promise<() => Promise<void>> {
  const [browser, server] = [await serveBrowser(), new Server()];
  await server.start();
  project.provide("browser", browser.wsEndpoint());
  project.provide("server", server.address);
  return async () => {
    await browser.close();
    await server.stop();
  };
}

/** The browser; closing it closes the pages that were opened here. */
export function theBrowser(): Promise<Browser> {
  return chromium.connect(inject("browser"));
}

export function theServer(): ServerAt {
  return new ServerAt(inject("server"));
}
