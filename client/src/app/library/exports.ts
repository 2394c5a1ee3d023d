import { askFor } from "../requests/request";
import { bytesOf, Transfer } from "../requests/transfer";

export interface ExportsOptions {
  readonly session: () => string | null;
  /** What is done with the file once it is whole. */
  readonly give: (file: Blob, name: string) => void;
  readonly failed: (error: unknown) => void;
}

/** The tree as files. */
export class Exports {
  readonly transfer = new Transfer();
  #options: ExportsOptions;

  constructor(options: ExportsOptions) {
    this.#options = options;
  }

  /** The tree as one binary glTF file. */
  async gltf(): Promise<void> {
    const session = this.#options.session();
    if (session === null) {
      return;
    }
    try {
      const file = await this.transfer.run(async (signal, tell) =>
        bytesOf(await askFor("GET", gltfAddress(session), undefined, signal), tell),
      );
      if (file) {
        this.#options.give(file, `${session}.glb`);
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

/** Where a session's plants can be downloaded as glTF. */
function gltfAddress(session: string): string {
  return `/api/sessions/${encodeURIComponent(session)}/tree.glb`;
}
