import { ByteReader } from "./bytes";
import { openFrame } from "./envelope";
import { FrameError } from "./frame-error";
import { FrameKind } from "./generated";

/** Where a bend stands; without motions it is over (BE5). Mirrors `proto/src/bend.rs`. */
export interface BendFrame {
  epoch: number;
  sequence: number;
  /** The server's own number for the bend. */
  bend: number;
  /** One for each internode of the path, from the base upwards. */
  motions: RowMotion[];
}

/** x goes to rotation · (x − from) + to, where from is the row's position in the table. */
export interface RowMotion {
  row: number;
  /** The quaternion x, y, z, w. */
  rotation: [number, number, number, number];
  /** Where the metamer ends now, in internodes. */
  to: [number, number, number];
}

/** Reads the frame of a bend; any bytes at all give one of finite numbers or a `FrameError`. */
export async function decodeBend(bytes: ArrayBuffer): Promise<BendFrame> {
  const { epoch, sequence, body } = await openFrame(bytes, FrameKind.Bend);
  const reader = new ByteReader(body);
  const bend = reader.varint();
  const count = reader.varint();
  const motions: RowMotion[] = [];
  for (let i = 0; i < count; i += 1) motions.push(readMotion(reader));
  if (!reader.done) throw new FrameError("Something follows the last motion.");
  return { epoch, sequence, bend, motions };
}

function readMotion(reader: ByteReader): RowMotion {
  const row = reader.varint();
  const next = () => {
    const value = reader.float();
    if (!Number.isFinite(value)) throw new FrameError("A motion is not finite.");
    return value;
  };
  return { row, rotation: [next(), next(), next(), next()], to: [next(), next(), next()] };
}
