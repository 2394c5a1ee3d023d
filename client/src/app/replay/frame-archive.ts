import { Zip, ZipPassThrough } from "fflate";

/** Takes the pictures of a recording one after the other, and gives the file they make. */
export interface FrameSink {
  add(picture: Blob): Promise<void>;
  finish(): Promise<Blob>;
  /** The recording was given up. */
  cancel(): Promise<void>;
}

/** The digits of a picture's number in its name, so that all are in order by name. */
const DIGITS = 5;

/** Pictures as numbered PNG files in a ZIP file. PNG is compressed already, so they are stored as they are. */
export function frameArchive(): FrameSink {
  const parts: BlobPart[] = [];
  let failure: Error | null = null;
  const zip = new Zip((error, part) => {
    failure ??= error;
    parts.push(new Blob([part as Uint8Array<ArrayBuffer>]));
  });
  let number = 0;
  return {
    async add(picture) {
      number += 1;
      const file = new ZipPassThrough(`frame-${String(number).padStart(DIGITS, "0")}.png`);
      zip.add(file);
      file.push(new Uint8Array(await picture.arrayBuffer()), true);
    },
    async finish() {
      zip.end();
      if (failure !== null) {
        throw failure;
      }
      return new Blob(parts, { type: "application/zip" });
    },
    async cancel() {
      zip.terminate();
    },
  };
}
