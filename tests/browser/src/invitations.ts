import { execFileSync } from "node:child_process";
import { program, type Server } from "./server";
import type { Tablet } from "./tablet";

/** A link that lets one device into a server, as an owner who is called so. */
export function ownersLink(server: Server, name: string): string {
  return devicesLink(server, name, "owner");
}

/** The same as an editor. */
export function editorsLink(server: Server, name: string): string {
  return devicesLink(server, name, "editor");
}

function devicesLink({ database, address }: Server, name: string, role: string): string {
  const options = ["--role", role, "--name", name, "--database", database, "--url", address];
  const printed = execFileSync(program, ["invite", ...options], { encoding: "utf8" });
  const link = /http:\/\/\S+\/pair#\S+/.exec(printed)?.[0];
  if (!link) throw new Error(`there is no link in ${printed}`);
  return link;
}

/** Saves the tree on a page under a name, and gives a link by which somebody else may draw on it, or do less. */
export async function guestsLink({ page }: Tablet, tree: string, guest: string, role = "editor"): Promise<string> {
  return page.evaluate(
    async ({ tree, guest, role }) => {
      const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
      const post = async (path: string, body: object) => {
        const headers = { "content-type": "application/json" };
        return await (await fetch(path, { method: "POST", headers, body: JSON.stringify(body) })).json();
      };
      const { id } = await post("/api/v1/trees", { session, name: tree });
      return (await post(`/api/v1/trees/${id}/links`, { role, name: guest })).url as string;
    },
    { tree, guest, role },
  );
}
