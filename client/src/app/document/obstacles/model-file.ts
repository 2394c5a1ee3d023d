import { say } from "../../words/say";

/** A file as it is sent to become an obstacle. */
export interface ModelFile {
  readonly type: string;
  readonly body: Blob;
}

/** The part of a .gltf, with its name. */
interface NamedBytes {
  readonly name: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Kinds of files that are sent as they are, unread: they may be large. */
const WHOLE = [
  [".glb", "model/gltf-binary"],
  [".obj", "model/obj"],
  [".obj.zip", "application/zip"],
] as const;

interface Gltf {
  buffers?: { uri?: string; byteLength?: number }[];
  bufferViews?: { buffer: number; byteOffset?: number }[];
  images?: { uri?: string }[];
}

const MAGIC = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;

/** One file from what was chosen: a .glb or .obj as it is, or a .gltf with the buffers it names as a glTF binary. */
export async function modelFile(files: readonly File[]): Promise<ModelFile> {
  for (const [ending, type] of WHOLE) {
    const body = files.find(({ name }) => name.toLowerCase().endsWith(ending));
    if (body) {
      return { type, body };
    }
  }
  if (!files.some(isGltf)) {
    throw new Error(say("scene.no-file"));
  }
  const named = files.map(async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) }));
  return { type: "model/gltf-binary", body: new Blob([packed(await Promise.all(named))]) };
}

function isGltf({ name }: { readonly name: string }): boolean {
  return name.toLowerCase().endsWith(".gltf");
}

function packed(files: readonly NamedBytes[]): Uint8Array<ArrayBuffer> {
  const main = files.find(isGltf);
  if (!main) {
    throw new Error(say("scene.no-file"));
  }
  let gltf: Gltf;
  try {
    gltf = JSON.parse(new TextDecoder().decode(main.bytes)) as Gltf;
  } catch {
    throw new Error(say("scene.no-gltf", { name: main.name }));
  }
  const offsets: number[] = [];
  const parts: Uint8Array[] = [];
  let length = 0;
  for (const { uri, byteLength } of gltf.buffers ?? []) {
    const bytes = bufferOf(uri, files).subarray(0, byteLength);
    offsets.push(length);
    parts.push(bytes);
    length = aligned(length + bytes.length);
  }
  for (const view of gltf.bufferViews ?? []) {
    view.byteOffset = (view.byteOffset ?? 0) + (offsets[view.buffer] ?? 0);
    view.buffer = 0;
  }
  gltf.buffers = length > 0 ? [{ byteLength: length }] : [];
  // Pictures make no obstacle, and one that lies in a file of its own could not come along.
  gltf.images = (gltf.images ?? []).map((image) => (image.uri?.startsWith("data:") === false ? { uri: EMPTY } : image));
  const binary = new Uint8Array(length);
  parts.forEach((part, i) => {
    binary.set(part, offsets[i]);
  });
  return assembled(new TextEncoder().encode(JSON.stringify(gltf)), binary);
}

const EMPTY = "data:image/png;base64,";

function bufferOf(uri: string | undefined, files: readonly NamedBytes[]): Uint8Array {
  if (uri === undefined) {
    throw new Error(say("scene.no-place"));
  }
  const inline = /^data:[^,]*;base64,(.*)$/s.exec(uri)?.[1];
  if (inline !== undefined) {
    return Uint8Array.from(atob(inline), (letter) => letter.charCodeAt(0));
  }
  const name = decodeURIComponent(uri).split("/").pop();
  const file = files.find((candidate) => candidate.name === name);
  if (!file) {
    throw new Error(say("scene.file-missing", { name: name ?? "" }));
  }
  return file.bytes;
}

function assembled(json: Uint8Array, binary: Uint8Array): Uint8Array<ArrayBuffer> {
  const text = aligned(json.length);
  const total = 12 + 8 + text + (binary.length > 0 ? 8 + binary.length : 0);
  const glb = new Uint8Array(total);
  const view = new DataView(glb.buffer);
  const words = [MAGIC, 2, total, text, JSON_CHUNK];
  words.forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  // JSON is filled up with spaces, data with zeros.
  glb.fill(0x20, 20, 20 + text);
  glb.set(json, 20);
  if (binary.length > 0) {
    view.setUint32(20 + text, binary.length, true);
    view.setUint32(24 + text, BINARY_CHUNK, true);
    glb.set(binary, 28 + text);
  }
  return glb;
}

/** Chunks begin at multiples of four. */
function aligned(length: number): number {
  return Math.ceil(length / 4) * 4;
}
