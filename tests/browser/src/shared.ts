import { type Browser, chromium } from "playwright-core";
import { inject } from "vitest";
import type { TestProject } from "vitest/node";
import { serveBrowser } from "./browser";
import { watchDrawing } from "./drawing-faults";
import { bePatient } from "./patience";
import { Server, ServerAt, until } from "./server";

declare module "vitest" {
  interface ProvidedContext {
    /** The address of the browser that all files use. */
    readonly browser: string;
    /** That of the server which all files use that neither stop it nor want its library for themselves. */
    readonly server: string;
  }
}

/** Vitest's global set-up: one browser, which shares what it has compiled among all pages, and one server. */
export default async function setup(project: TestProject): Promise<() => Promise<void>> {
  const [browser, server] = [await serveBrowser(), new Server()];
  await server.start();
  await drawSpecies(server);
  project.provide("browser", browser.wsEndpoint());
  project.provide("server", server.address);
  return async () => {
    await browser.close();
    await server.stop();
  };
}

/**
 * Has the server draw the pictures of all species, which takes seconds of all its processors, once: a test that opens the
 * picker would else have its other questions wait for that.
 */
async function drawSpecies({ address }: Server): Promise<void> {
  const species = (await (await fetch(`${address}/api/v1/species`)).json()) as { slug: string }[];
  for (const { slug } of species) {
    await until(
      `the picture of ${slug} is drawn`,
      async () => (await fetch(`${address}/api/v1/species/${slug}/picture`)).ok,
    );
  }
}

/** The browser; closing it closes the pages that were opened here. A fault in what they draw has the test fail. */
export async function theBrowser(): Promise<Browser> {
  const browser = await chromium.connect(inject("browser"));
  return watchDrawing(browser.on("context", bePatient));
}

export function theServer(): ServerAt {
  return new ServerAt(inject("server"));
}
