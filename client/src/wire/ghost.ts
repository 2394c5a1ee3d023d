import { openFrame } from "./envelope";
import { type ChunkChange, readChanges } from "./frame";
import { FrameKind } from "./generated";

/** A prediction as a table of its own; without changes there is none any more (PD2). Mirrors `proto/src/ghost.rs`. */
export interface GhostFrame {
  epoch: number;
  sequence: number;
  /** All chunks of the ghost's table, in order. */
  changes: ChunkChange[];
}

/** Reads a ghost; any bytes at all give one or a `FrameError`. */
export async function decodeGhost(bytes: ArrayBuffer): Promise<GhostFrame> {
  const { epoch, sequence, body } = await openFrame(bytes, FrameKind.Ghost);
  return { epoch, sequence, changes: readChanges(body, sequence) };
}
