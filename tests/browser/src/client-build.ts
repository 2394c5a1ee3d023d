import { existsSync } from "node:fs";
import { join } from "node:path";
import type { BrowserContext, Route } from "playwright-core";

/** A folder with another build of the client than the one that is part of the program; for work on the client alone. */
const client = process.env.ESPALIER_CLIENT;

/** Has the pages of a context take that build, if there is one. */
export async function withClient(context: BrowserContext): Promise<void> {
  if (client) await context.route("**/*", (route) => substitute(route, client));
}

/** Answers with the file of the folder that stands in for the one asked for, if there is one. */
async function substitute(route: Route, folder: string): Promise<void> {
  const { pathname } = new URL(route.request().url());
  const path = join(folder, pathname.startsWith("/s/") || pathname === "/" ? "index.html" : pathname);
  await (existsSync(path) ? route.fulfill({ path }) : route.continue());
}
