import { gzipSync } from "node:zlib";
import type { Plugin, Rollup } from "vite";

const PAGE = "index.html";
/** Bytes that a page may load before its first picture: page, scripts and styles, each compressed with gzip. */
export const FIRST_PICTURE_BYTES = 200_000;

/** Fails the build where a page would load more than that before its first picture. */
export function firstPictureBudget(): Plugin {
  return {
    name: "espalier-first-picture-budget",
    apply: "build",
    enforce: "post",
    writeBundle(_options, bundle) {
      const names = firstPictureFiles(bundle);
      const sizes = names.map((name) => [sizeOf(bundle[name]!), name] as const);
      const bytes = sizes.reduce((sum, [size]) => sum + size, 0);
      const said = `The first picture needs ${bytes} of at most ${FIRST_PICTURE_BYTES} bytes, compressed`;
      if (bytes > FIRST_PICTURE_BYTES) {
        const most = sizes.sort(([a], [b]) => b - a).map(([size, name]) => `${name} ${size}`);
        this.error(`${said}: ${most.join(", ")}. Load what it does without later, as client/src/app/ui/parts.ts does.`);
      }
      this.info(`${said}.`);
    },
  };
}

/** The tablet's page, and all scripts and styles that are loaded with it: not those that a script asks for later. */
export function firstPictureFiles(bundle: Rollup.OutputBundle): string[] {
  const found = new Set<string>();
  const add = (name: string) => {
    const output = bundle[name];
    if (output === undefined || found.has(name)) {
      return;
    }
    found.add(name);
    if (output.type === "chunk") {
      output.imports.forEach(add);
      output.viteMetadata?.importedCss.forEach(add);
    }
  };
  const page = bundle[PAGE];
  const text = page?.type === "asset" ? String(page.source) : "";
  for (const name of [PAGE, ...Object.keys(bundle).filter((name) => text.includes(`"/${name}"`))]) {
    add(name);
  }
  return [...found];
}

function sizeOf(output: Rollup.OutputAsset | Rollup.OutputChunk): number {
  return gzipSync(output.type === "chunk" ? output.code : output.source, { level: 9 }).length;
}
