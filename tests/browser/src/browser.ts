import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdir, readFile, rename, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { delimiter, dirname, join } from "node:path";
import { brotliDecompressSync } from "node:zlib";
import { type Browser, type BrowserServer, chromium, type LaunchOptions } from "playwright-core";

/** WebGL2 without a graphics card: ANGLE over SwiftShader. */
const flags = [
  "--no-sandbox",
  "--ignore-gpu-blocklist",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  // Each page compiles the same shaders: they are kept for the next one, and none before something is drawn with it.
  "--enable-angle-features=preferGlobalPipelineCache",
  "--disable-angle-features=warmUpPipelineCacheAtLink",
  "--hide-scrollbars",
  "--touch-events=enabled",
];

/** The page around the canvas is put together without the emulated card: that takes the processor two fifths of the time. */
const PLAIN = "--disable-gpu-compositing";

interface Program {
  path: string;
  env: Record<string, string>;
}

/**
 * Starts the browser: the one named by CHROMIUM, else the one that comes with the npm packages. `asOnTablets` has it put
 * pages together as a tablet does: then the page never waits for what the canvas shows.
 */
export async function launchBrowser({ asOnTablets = false } = {}): Promise<Browser> {
  return chromium.launch(await options(asOnTablets ? flags : [...flags, PLAIN]));
}

/** Starts one that several processes can use at a time, by its address. */
export async function serveBrowser(): Promise<BrowserServer> {
  return chromium.launchServer(await options([...flags, PLAIN]));
}

async function options(args: string[]): Promise<LaunchOptions> {
  const program = process.env.CHROMIUM ? { path: process.env.CHROMIUM, env: {} } : await packagedChromium();
  return {
    executablePath: program.path,
    headless: true,
    args,
    env: { ...(process.env as Record<string, string>), ...program.env },
  };
}

/**
 * Unpacks the browser of `@sparticuz/chromium`, with its libraries and a font, beside the packages.
 * Neither root nor anything installed on the machine is needed.
 */
async function packagedChromium(): Promise<Program> {
  const entry = createRequire(import.meta.url).resolve("@sparticuz/chromium");
  const root = entry.slice(0, entry.lastIndexOf(join("@sparticuz", "chromium")));
  const bin = join(root, "@sparticuz", "chromium", "bin");
  const home = join(root, ".cache", "espalier-chromium");
  if (!existsSync(home)) {
    // Under another name first: an unpacking that was cut short must not look like a finished one.
    const fresh = `${home}.${process.pid}`;
    await mkdir(fresh, { recursive: true });
    await writeFile(join(fresh, "chromium"), brotliDecompressSync(await readFile(join(bin, "chromium.br"))), {
      mode: 0o755,
    });
    for (const archive of ["swiftshader", "al2023", "fonts"]) {
      const tar = brotliDecompressSync(await readFile(join(bin, `${archive}.tar.br`)));
      const { status, stderr } = spawnSync("tar", ["-x", "--no-same-owner", "-C", fresh], { input: tar });
      if (status !== 0) throw new Error(`could not unpack ${archive}: ${stderr}`);
    }
    await writeFile(join(fresh, "fonts.conf"), fontConfiguration(home));
    await rename(fresh, home).catch(() => rm(fresh, { recursive: true }));
  }
  const libraries = [join(home, "lib"), process.env.LD_LIBRARY_PATH].filter(Boolean).join(delimiter);
  const env = { LD_LIBRARY_PATH: libraries, FONTCONFIG_FILE: join(home, "fonts.conf") };
  return { path: join(home, "chromium"), env };
}

function fontConfiguration(home: string): string {
  return `<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <dir>${join(home, "fonts")}</dir>
  <dir>/usr/share/fonts</dir>
  <cachedir>${join(home, "fonts-cache")}</cachedir>
</fontconfig>
`;
}

/** The folder screenshots go to; people look at them. */
export const screenshots = join(dirname(new URL(import.meta.url).pathname), "..", "screenshots");
