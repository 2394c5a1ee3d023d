import { statSync } from "node:fs";
import { join } from "node:path";
import type { BrowserContext, Route } from "playwright-core";

/** A folder with another build of the client than the one that is part of the program; for work on the client alone. */
const client = process.env.ESPALIER_CLIENT;

/** Pages by their addresses. */
const PAGES: Readonly<Record<string, string>> = { "/": "index.html", "/pair": "index.html", "/api": "api.html" };

/** Has the pages of a context take that build, if there is one. */
export async function withClient(context: BrowserContext): Promise<void> {
  if (client) await context.route("**/*", (route) => substitute(route, client));
}

/** Answers with the file of the folder that stands in for the one asked for, if there is one. */
async function substitute(route: Route, folder: string): Promise<void> {
  const { pathname } = new URL(route.request().url());
  const path = join(folder, pathname.startsWith("/s/") ? "index.html" : (PAGES[pathname] ?? pathname));
  await (statSync(path, { throwIfNoEntry: false })?.isFile() ? route.fulfill({ path }) : route.continue());
}
