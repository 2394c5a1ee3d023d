import { ByteReader } from "./bytes";
import { FrameError } from "./frame-error";
import { FrameKind, HEADER_BYTES, MAX_BODY_BYTES } from "./generated";
import { inflateRaw } from "./inflate";

type Kind = (typeof FrameKind)[keyof typeof FrameKind];

/** What all frames have in common; mirrors `proto/src/envelope.rs`. */
export interface OpenedFrame {
  readonly epoch: number;
  readonly sequence: number;
  readonly flags: number;
  readonly body: Uint8Array;
  /** Whether the body is still packed by models (FR9). */
  readonly isPacked: boolean;
}

const VERSION = 4;
/** The codec of bodies that are packed by models: in mesh deltas alone. */
const PACKED = 2;
/** The only flag, and only mesh deltas have it. */
const CATCH_UP = 1;

/** The kind a frame's header states, if there is such a kind; whether the rest is valid is not looked at. */
export function kindOf(bytes: ArrayBuffer): Kind | undefined {
  const code = bytes.byteLength < 2 ? 0 : new DataView(bytes).getUint8(1);
  return Object.values(FrameKind).find((kind) => kind === code);
}

/** The header and the unpacked body of a frame of one kind (FR1, FR2). */
export async function openFrame(bytes: ArrayBuffer, wanted: Kind): Promise<OpenedFrame> {
  if (bytes.byteLength < HEADER_BYTES) throw new FrameError("The frame is cut short.");
  const header = new DataView(bytes, 0, HEADER_BYTES);
  const rest = new ByteReader(new Uint8Array(bytes, HEADER_BYTES));
  const [version, kind, codec, flags] = [0, 1, 2, 3].map((at) => header.getUint8(at)) as [
    number,
    number,
    number,
    number,
  ];
  if (version !== VERSION) throw new FrameError(`Frame version ${version} is not ${VERSION}.`);
  if (kind !== wanted) throw new FrameError(`Frame kind ${kind} is not ${wanted}.`);
  const known = wanted === FrameKind.MeshDelta ? CATCH_UP : 0;
  if ((flags & ~known) !== 0) throw new FrameError(`Reserved flags 0x${flags.toString(16)} are set.`);
  const opened = { epoch: header.getUint32(4, true), sequence: rest.varint(), flags };
  const payload = () => new Uint8Array(bytes, bytes.byteLength - rest.left);
  const length = rest.varint();
  if (codec === PACKED && wanted === FrameKind.MeshDelta) {
    return { ...opened, body: await unpack(0, payload(), length), isPacked: true };
  }
  if (length > MAX_BODY_BYTES) throw new FrameError("The body is larger than 64 MiB.");
  return { ...opened, body: await unpack(codec, payload(), length), isPacked: false };
}

async function unpack(codec: number, payload: Uint8Array<ArrayBuffer>, length: number): Promise<Uint8Array> {
  if (codec === 0) {
    if (payload.length !== length) throw new FrameError("The body's length differs from the header's.");
    return payload;
  }
  if (codec === 1) return inflateRaw(payload, length);
  throw new FrameError(`Codec ${codec} is neither 0, raw, nor 1, deflate, nor 2 in a mesh delta.`);
}
