// What tests in a browser ask of it: how the graphics card moves rows, and where the page's own formulas have them.
import { type Object3D, WebGLRenderer } from "three";
import { Connection } from "../src/app/connection/connection";
import { rowStore } from "../src/app/connection/row-store";
import { browserClock } from "../src/app/page/clock";
import { Air, type AirStage } from "../src/scene/motion/air";
import { type AirSettings, CALM } from "../src/scene/motion/air-settings";
import { PHASE, PIVOT, ROW_NUMBERS } from "../src/scene/motion/moving";
import { NODE, nodeOn } from "../src/scene/motion/pose";
import { JOINT } from "../src/scene/motion/rides";
import type { Riding } from "../src/scene/motion/riding";
import type { SharedClock } from "../src/scene/motion/shared-clock";
import { NodeTexture } from "../src/scene/table/node-texture";
import { TreeTable } from "../src/scene/table/tree-table";
import type { Vec3 } from "../src/scene/vector";
import { CHUNK_ROWS, type ServerMessage } from "../src/wire/generated";
import { decodeServerFrame } from "../src/wire/server-frame";

/** One row as it is drawn and as the page has it for fingers; lengths are in internodes. */
export interface DrawnRow {
  readonly row: number;
  readonly rest: Vec3;
  /** How far its node is from where it grew, and how it has turned, in the texture that shaders read. */
  readonly drawn: { readonly shift: Vec3; readonly turn: readonly number[] };
  /** The same by the formulas with which fingers meet it. */
  readonly met: { readonly shift: Vec3; readonly turn: readonly number[] };
  /** How far from the place about which it shivers with its twig; null where it does not. */
  readonly shivers: number | null;
  readonly isTip: boolean;
  readonly isFork: boolean;
  /** Rows from it down to the seed. */
  readonly depth: number;
}

/** A plant of a session, so many seconds after a wind was set. */
export async function drawnSway(session: string, air: Partial<AirSettings>, seconds: number): Promise<DrawnRow[]> {
  const table = await tableOf(session);
  const renderer = new WebGLRenderer({ canvas: document.createElement("canvas") });
  const nodes = new NodeTexture();
  nodes.reserve(table.rows);
  for (let row = 0; row < table.rows; row += 1) nodes.write(table, row);
  nodes.upload();
  const uniforms: Record<string, { value: unknown }> = { uNodes: nodes.uniform };
  const nothing = { traverse: () => {} } as unknown as Object3D;
  const overlays = { placeOf: (of: TreeTable, row: number) => placeOf(of, row) };
  const world = {
    uniforms,
    table,
    tree: { group: nothing, casters: nothing, overlays },
    sun: { margin: 0 },
    obstacles: { shown: [] },
    ghost: { group: { visible: false } },
    shadow: { stale: false },
  };
  const stage = { renderer, world, control: { moved: () => {} }, invalidate: () => {} } as unknown as AirStage;
  let now = 0;
  const wind = new Air(stage, { read: () => ({ time: now / 1000, jumped: false }) } as unknown as SharedClock);
  wind.set({ ...CALM, ...air }, { internodeLength: 0.1, leafSize: 1 }, 1, 0);
  while (!wind.blowing) {
    wind.step(now);
    await new Promise((resolve) => setTimeout(resolve, 10));
  }
  for (const end = 1000 * seconds; now < end; now = Math.min(end, now + 100)) wind.step(now);
  wind.step(now);
  const texels = read(renderer, uniforms.uMoved!.value as object, table.rows);
  // Where no test could ask the picture itself.
  const { shown } = wind as unknown as { shown: { stands: Float64Array; riding: Riding } };
  const children = new Int32Array(table.rows);
  for (let row = 0; row < table.rows; row += 1) if (table.parent[row]! >= 0) children[table.parent[row]!]! += 1;
  const depths = new Int32Array(table.rows);
  return Array.from({ length: table.rows }, (_, row) => {
    const parent = table.parent[row]!;
    depths[row] = parent < 0 ? 0 : depths[parent]! + 1;
    const rest = placeOf(table, row);
    const seen = wind.seenAt(row, overlays as never);
    const numbers = shown.riding.rows.subarray(ROW_NUMBERS * row, ROW_NUMBERS * (row + 1));
    const aside = [0, 1, 2].map((a) => rest[a]! - numbers[PIVOT + a]!);
    return {
      row,
      rest,
      drawn: unpacked(texels, 4 * row),
      met: {
        shift: [seen[0] - rest[0], seen[1] - rest[1], seen[2] - rest[2]],
        turn: turnOf(shown.stands, numbers, rest),
      },
      shivers: numbers[PHASE]! >= 0 ? Math.hypot(...aside) : null,
      isTip: children[row] === 0,
      isFork: children[row]! > 1,
      depth: depths[row]!,
    };
  });
}

async function tableOf(session: string): Promise<TreeTable> {
  const table = new TreeTable(() => 0);
  const address = `${location.origin.replace("http", "ws")}/api/v1/sessions/${session}/socket`;
  const rows = new Promise<void>((resolve, reject) => {
    const ignore = () => {};
    let expected = Number.POSITIVE_INFINITY;
    const look = () => {
      // Beside its metamers it has its seed.
      if (table.rows <= expected) return;
      connection.close();
      resolve();
    };
    const connection = new Connection({
      openSocket: () => {
        const socket = new WebSocket(address);
        socket.addEventListener("message", ({ data }) => {
          const message = typeof data === "string" ? (JSON.parse(data) as ServerMessage) : null;
          if (message?.type === "welcome") expected = message.state.metamers;
        });
        return socket;
      },
      clock: browserClock,
      rows: rowStore(table),
      decode: decodeServerFrame,
      newKey: () => crypto.randomUUID(),
      events: {
        phase: ignore,
        commands: ignore,
        heldUp: ignore,
        message: ignore,
        aside: ignore,
        cannotOpen: (sentence) => reject(new Error(sentence)),
        refused: ignore,
        rows: () => look(),
        rekeyed: ignore,
        renumbered: ignore,
        reload: ignore,
      },
    });
  });
  await rows;
  return table;
}

/** Reads back what was drawn into a texture of whole numbers. */
function read(renderer: WebGLRenderer, texture: object, rows: number): Uint32Array {
  const gl = renderer.getContext() as WebGL2RenderingContext;
  const { __webglTexture } = renderer.properties.get(texture) as { __webglTexture: WebGLTexture };
  const lines = Math.ceil(rows / CHUNK_ROWS);
  const texels = new Uint32Array(4 * CHUNK_ROWS * lines);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, __webglTexture, 0);
  gl.readPixels(0, 0, CHUNK_ROWS, lines, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
  const error = gl.getError();
  if (error !== gl.NO_ERROR) throw new Error(`The texture cannot be read: ${error}.`);
  return texels;
}

/** As shaders read a texel: 20 bits of displacement in steps of 1/2048 internode, and 12 of a turn in steps of 1/2047. */
function unpacked(texels: Uint32Array, at: number): DrawnRow["drawn"] {
  const words = [0, 1, 2].map((a) => texels[at + a]! | 0);
  const [x, y, z] = words.map((word) => (word >> 12) / 2048);
  const turn = words.map((word) => ((word << 20) >> 20) / 2047);
  return { shift: [x!, y!, z!], turn };
}

/** The turn of a node, as its three numbers where the fourth is not below 0. */
function turnOf(stands: Float64Array, numbers: Float32Array, rest: Vec3): number[] {
  if (numbers[JOINT]! < 0) return [0, 0, 0];
  const node = new Float64Array(NODE);
  nodeOn(stands, numbers[JOINT]!, rest, 0, numbers, 0, node);
  return [3, 4, 5].map((a) => (node[6]! < 0 ? -node[a]! : node[a]!));
}

function placeOf({ course: { placed } }: TreeTable, row: number): Vec3 {
  return [placed[3 * row]!, placed[3 * row + 1]!, placed[3 * row + 2]!];
}
