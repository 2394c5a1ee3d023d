import { Transfer } from "../requests/transfer";
import { say } from "../words/say";
import { fileName } from "./file-name";

/** Makes a picture of so many pixels across and down as PNG, and tells what share of it is done. */
export type Photographer = (
  size: { readonly width: number; readonly height: number },
  stop: AbortSignal,
  tell: (share: number) => void,
) => Promise<Blob>;

export interface ExportsOptions {
  readonly session: () => string | null;
  readonly photograph: Photographer;
  /** What is done with the file once it is whole. */
  readonly give: (file: Blob, name: string) => void;
  readonly failed: (error: unknown) => void;
}

/** The tree as files. */
export class Exports {
  readonly transfer = new Transfer();
  /** A picture in the making; its progress counts hundredths, not bytes. */
  readonly picture = new Transfer();
  #options: ExportsOptions;
  /** The file before, for each of these: one is made after the other, as they were asked for. */
  #before = new WeakMap<Transfer, Promise<void>>();

  constructor(options: ExportsOptions) {
    this.#options = options;
  }

  /** The tree on the page, or another one of the library, as a file that the server writes, named by its ending. */
  async file(
    ending: string,
    name: string,
    options: ReadonlyMap<string, string> = new Map(),
    saved: { readonly id: string; readonly version: number } | null = null,
  ): Promise<void> {
    const session = this.#options.session();
    const place = saved
      ? `trees/${encodeURIComponent(saved.id)}/versions/${saved.version}`
      : session !== null && `sessions/${encodeURIComponent(session)}`;
    if (place) {
      await this.#give(this.transfer, name, ending, () =>
        this.transfer.run(async (stop, tell) =>
          (await import("./served-file")).servedFile(`/api/v1/${place}`, ending, options, stop, tell),
        ),
      );
    }
  }

  /** The view as a picture of so many pixels. */
  async png(name: string, size: { readonly width: number; readonly height: number }): Promise<void> {
    await this.#give(this.picture, name, "png", () =>
      this.picture.run(async (stop, tell) => {
        try {
          return await this.#options.photograph(size, stop, (share) =>
            tell({ bytes: Math.round(100 * share), total: 100 }),
          );
        } catch (cause) {
          throw new Error(say("notices.picture-failed"), { cause });
        }
      }),
    );
  }

  #give(by: Transfer, name: string, ending: string, make: () => Promise<Blob | null>): Promise<void> {
    const given = (this.#before.get(by) ?? Promise.resolve()).then(() => this.#made(name, ending, make));
    this.#before.set(by, given);
    return given;
  }

  async #made(name: string, ending: string, make: () => Promise<Blob | null>): Promise<void> {
    try {
      const file = await make();
      if (file) {
        this.#options.give(file, fileName(name, ending));
      }
    } catch (error) {
      this.#options.failed(error);
    }
  }
}

/** Saves a file through the browser, as a download link does. */
export function keepFile(file: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  // Safari reads it after the click.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
