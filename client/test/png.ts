import { crc32, deflateSync, inflateSync } from "node:zlib";

const SIGNATURE = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
/** Eight bits each of red, green, blue and coverage; not interlaced. */
const FORM = [8, 6, 0, 0, 0];
/** Each byte of a line is kept as its difference to the one four before it. */
const DIFFERENCES = 1;

/** A PNG file of texels with four bytes each, line upon line from the top. */
export function pngOf(width: number, texels: Uint8Array): Buffer {
  const line = 4 * width;
  const height = texels.length / line;
  const lines = Buffer.alloc((line + 1) * height);
  for (let y = 0; y < height; y += 1) {
    lines[y * (line + 1)] = DIFFERENCES;
    for (let i = 0; i < line; i += 1) {
      const at = y * line + i;
      lines[y * (line + 1) + 1 + i] = texels[at]! - (i < 4 ? 0 : texels[at - 4]!);
    }
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set(FORM, 8);
  return Buffer.concat([
    SIGNATURE,
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(lines, { level: 9 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** The texels of such a file. */
export function texelsOf(png: Buffer): Uint8Array {
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  const lines = inflateSync(png.subarray(41, 41 + png.readUInt32BE(33)));
  const line = 4 * width;
  const texels = new Uint8Array(line * height);
  for (let at = 0; at < texels.length; at += 1) {
    const i = at % line;
    texels[at] = lines[Math.floor(at / line) * (line + 1) + 1 + i]! + (i < 4 ? 0 : texels[at - 4]!);
  }
  return texels;
}

function chunk(name: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
  const ends = [Buffer.alloc(4), Buffer.alloc(4)] as const;
  ends[0].writeUInt32BE(data.length);
  ends[1].writeUInt32BE(crc32(body));
  return Buffer.concat([ends[0], body, ends[1]]);
}
