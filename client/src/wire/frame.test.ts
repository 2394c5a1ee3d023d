import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { randoms } from "../../test/randoms";
import { decodeBend } from "./bend-frame";
import { decodeFrame, FrameError } from "./frame";
import { FrameKind } from "./generated";
import { decodeServerFrame } from "./server-frame";

function varint(value: number): number[] {
  return value < 128 ? [value] : [(value % 128) + 128, ...varint(Math.floor(value / 128))];
}

function headed(body: number[], header: { codec?: number; flags?: number; length?: number } = {}): ArrayBuffer {
  const start = [4, 1, header.codec ?? 0, header.flags ?? 0, 0, 0, 0, 0, 0];
  return new Uint8Array([...start, ...varint(header.length ?? body.length), ...body]).buffer;
}

async function refused(bytes: ArrayBuffer, sentence: RegExp) {
  await expect(decodeFrame(bytes)).rejects.toThrow(FrameError);
  await expect(decodeFrame(bytes)).rejects.toThrow(sentence);
}

async function deflated(body: Uint8Array<ArrayBuffer>): Promise<number[]> {
  const stream = new Blob([body]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return [...new Uint8Array(await new Response(stream).arrayBuffer())];
}

describe("a bendFrame", () => {
  const bendFrame = (body: number[]) => {
    const bytes = new Uint8Array(headed(body));
    bytes[1] = 2;
    return bytes.buffer;
  };
  const zeros = Array.from({ length: 28 }, () => 0);

  it("FR1: holds finite numbers and nothing after them", async () => {
    expect((await decodeBend(bendFrame([1, 1, 7, ...zeros]))).motions[0]?.row).toBe(7);
    await expect(decodeBend(bendFrame([1, 1, 7, ...zeros, 0]))).rejects.toThrow(/follows/);
    const infinite = [...zeros.slice(4), 0, 0, 0x80, 0x7f];
    await expect(decodeBend(bendFrame([1, 1, 7, ...infinite]))).rejects.toThrow(/finite/);
  });

  it("is distinguished from a mesh delta by its kind", async () => {
    expect((await decodeServerFrame(bendFrame([1, 0]))).kind).toBe(2);
    await expect(decodeServerFrame(headed([1, 0, 0]))).rejects.toThrow(FrameError);
  });
});

describe("a frame", () => {
  it("FR1: refuses what is reserved or unknown", async () => {
    const with_ = (at: number, value: number) => {
      const bytes = new Uint8Array(headed([]));
      bytes[at] = value;
      return bytes.buffer;
    };
    await refused(with_(0, 2), /version 2 is not 4/);
    await refused(with_(1, 7), /kind 7/);
    await refused(with_(2, 3), /Codec 3/);
    await refused(headed([1, 0], { codec: 2, length: 3 }), /length/);
    await refused(with_(3, 2), /flags 0x2/);
    await refused(headed([5, 0]), /Change 5 is unknown/);
    await refused(headed([4, 0, 0, 9, 1, 0, 0]), /Column 9/);
  });

  it("FR2: has exactly the stated length", async () => {
    await refused(headed([1, 0], { length: 3 }), /length/);
    await refused(headed([1, 0], { length: 1 }), /length/);
    await refused(headed([], { length: 64 * 1024 * 1024 + 1 }), /64 MiB/);
    await refused(headed([]).slice(0, 8), /cut short/);
  });

  it("FR2: unpacks to exactly the stated length", async () => {
    const body = new Uint8Array(200).map((_, i) => (i % 2 === 0 ? 1 : 0));
    const packed = await deflated(body);
    expect((await decodeFrame(headed(packed, { codec: 1, length: 200 }))).changes).toHaveLength(100);
    await refused(headed(packed, { codec: 1, length: 199 }), /more than the header says/);
    await refused(headed(packed, { codec: 1, length: 201 }), /less than the header says/);
    await refused(headed([255, 255, 255], { codec: 1, length: 3 }), /not raw deflate/);
  });

  it("FR3: takes varints of at most 32 bits", async () => {
    const frame = await decodeFrame(headed([1, 255, 255, 255, 255, 15]));
    expect(frame.changes).toEqual([{ change: "truncate", rows: 0xffffffff }]);
    await refused(headed([1, 255, 255, 255, 255, 31]), /32 bits/);
    await refused(headed([1, 255, 255, 255, 255, 255, 0]), /32 bits/);
  });

  it("refuses counts and rows outside a chunk", async () => {
    await refused(headed([2, 0, 1, 0]), /count of 0/);
    await refused(headed([2, 0, 1, 129, 2]), /count of 257/);
    await refused(headed([3, 0, 1, 255, 1, 2, ...new Array(16).fill(0)]), /past the end/);
    await refused(headed([4, 0, 1, 4, 2, 255, 1, 0, 7, 7]), /past the end/);
    const rows = (radius: number[]) => [2, 0, 1, 1, 0, 0, 0, 0, ...radius, 0, 0, 0];
    await refused(headed(rows([128, 128, 8])), /16 bits/);
    await refused(headed(rows([1])), /16 bits/);
  });

  it("FR11: reads by how much radii change", async () => {
    const frame = await decodeFrame(headed([4, 0, 0, 2, 3, 0, 0, 0, 144, 6, 0, 3]));
    expect(frame.changes[0]).toMatchObject({ column: "radius", values: Int32Array.of(392, 0, -2) });
  });

  it("reads births as differences", async () => {
    const frame = await decodeFrame(headed([4, 0, 1, 5, 3, 0, 0, 0, 130, 1, 0, 4]));
    expect(frame.changes[0]).toMatchObject({ column: "born", values: Uint32Array.of(130, 130, 134) });
  });

  it("FR9: ends where its last change says, if it is packed", async () => {
    const golden = readFileSync(new URL("../../../proto/golden/packed.bin", import.meta.url));
    const packed = new Uint8Array(golden);
    expect(packed[2]).toBe(2);
    expect((await decodeFrame(packed.buffer)).changes).toHaveLength(1);
    // The header's length is one byte here.
    const body = [...packed.slice(10)];
    await refused(headed([...body, 0, 0, 0, 0, 1], { codec: 2 }), /follows the end/);
    // Zeros without end mean something, but are not there.
    await refused(headed([0xff], { codec: 2 }), /cut short|32 bits|unknown|count/);
    packed[1] = FrameKind.Ghost;
    await expect(decodeServerFrame(packed.buffer)).rejects.toThrow(/Codec 2/);
  });

  it("is a frame or a FrameError, whatever the bytes", async () => {
    const random = randoms(20260);
    let frames = 0;
    for (let round = 0; round < 4000; round += 1) {
      const body = Array.from({ length: Math.floor(random() * 40) }, () =>
        Math.floor(random() * (round % 2 ? 256 : 6)),
      );
      const codec = random() < 0.1 ? 1 + Math.round(random()) : 0;
      try {
        await decodeFrame(headed(body, { codec, flags: Math.floor(random() * 2.1) }));
        if (codec === 0) frames += 1;
      } catch (error) {
        expect(error).toBeInstanceOf(FrameError);
      }
    }
    // The generator is good enough to reach past the first check.
    expect(frames).toBeGreaterThan(50);
  });
});
