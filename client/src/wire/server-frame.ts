import type { BendFrame } from "./bend-frame";
import { kindOf, type OpenedFrame, openFrame } from "./envelope";
import { decodeFrame, type Frame } from "./frame";
import { FrameKind } from "./generated";
import { decodeGhost, type GhostFrame } from "./ghost";

/** Any binary message. `received` answers each with its sequence and, unless it is 1, its kind (FL1). */
export type ServerFrame =
  | { readonly kind: typeof FrameKind.MeshDelta; readonly frame: Frame }
  | { readonly kind: typeof FrameKind.Bend; readonly frame: BendFrame }
  | { readonly kind: typeof FrameKind.Ghost; readonly frame: GhostFrame }
  /** Its body is read by the code that shows others (`presence-frame.ts`). */
  | { readonly kind: typeof FrameKind.Presence; readonly frame: OpenedFrame };

/** A frame that does not change the table of rows. */
export type AsideServerFrame = Exclude<ServerFrame, { readonly kind: typeof FrameKind.MeshDelta }>;

/** Reads whatever kind of frame this is; any bytes at all give one or a `FrameError`. */
export async function decodeServerFrame(bytes: ArrayBuffer): Promise<ServerFrame> {
  const kind = kindOf(bytes);
  if (kind === FrameKind.Bend) {
    // The first picture has none.
    const { decodeBend } = await import("./bend-frame");
    return { kind, frame: await decodeBend(bytes) };
  }
  if (kind === FrameKind.Ghost) return { kind, frame: await decodeGhost(bytes) };
  if (kind === FrameKind.Presence) return { kind, frame: await openFrame(bytes, kind) };
  return { kind: FrameKind.MeshDelta, frame: await decodeFrame(bytes) };
}
