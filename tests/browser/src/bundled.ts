import { build } from "vite";
import { leanShaders } from "../../../client/shader-plugin";

/** A module of the client as one script, with shaders as the client's build has them: what it exports is in `bundled`. */
export async function bundled(entry: string, root: string): Promise<string> {
  const made = await build({
    root,
    configFile: false,
    logLevel: "error",
    plugins: [leanShaders()],
    build: { write: false, minify: false, lib: { entry, formats: ["iife"], name: "bundled" } },
  });
  const [first] = Array.isArray(made) ? made : [made];
  if (!first || !("output" in first)) throw new Error(`${entry} was not built.`);
  const script = first.output.find((file) => file.type === "chunk" && file.isEntry);
  if (script?.type !== "chunk") throw new Error(`${entry} is no script.`);
  return script.code;
}
