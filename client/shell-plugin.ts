import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";

/** The page of the API is of no use without the server, and nobody reads licences there. */
const LEFT_OUT = /^(api[.-]|licences\.txt$)/;

/** Writes `sw.js` beside the built client: the service worker with what it keeps, under a version made of all of it. */
export function shellWorker(): Plugin {
  return {
    name: "espalier-shell-worker",
    apply: "build",
    writeBundle({ dir }) {
      if (dir === undefined) {
        throw new Error("The client has no folder to be built into.");
      }
      const files = (readdirSync(dir, { recursive: true, withFileTypes: true }) as import("node:fs").Dirent[])
        .filter((entry) => entry.isFile() && entry.name !== "sw.js" && !LEFT_OUT.test(entry.name))
        .map((entry) => join(entry.parentPath, entry.name))
        .sort();
      const hash = createHash("sha256");
      for (const file of files) {
        hash.update(file.slice(dir.length)).update(readFileSync(file));
      }
      const paths = files.map((file) => file.slice(dir.length).replaceAll("\\", "/"));
      const shell = paths.map((path) => (path === "/index.html" ? "/" : path));
      const source = readFileSync(join(import.meta.dirname, "src/service-worker.js"), "utf8");
      writeFileSync(
        join(dir, "sw.js"),
        source
          .replace('"VERSION"', JSON.stringify(hash.digest("hex").slice(0, 12)))
          .replace('["SHELL"]', JSON.stringify(shell)),
      );
    },
  };
}
