import type { TriangleMesh } from "../../../scene/obstacle-meshes";
import { MAX_MESH_TRIANGLES, MAX_MESH_VERTICES, MAX_MODEL_BYTES, type UploadedObstacle } from "../../../wire/generated";
import { askFor } from "../../requests/request";
import type { Progress } from "../../requests/transfer";
import { say } from "../../words/say";
import type { ModelFile } from "./model-file";

/** Reads a mesh as it travels (`OB4`). */
export function readMesh(bytes: ArrayBuffer): TriangleMesh {
  const view = new DataView(bytes);
  const [vertices, triangles] = bytes.byteLength < 8 ? [0, 0] : [view.getUint32(0, true), view.getUint32(4, true)];
  const whole = bytes.byteLength === 8 + 12 * vertices + 12 * triangles;
  if (!whole || vertices > MAX_MESH_VERTICES || triangles > MAX_MESH_TRIANGLES) {
    throw new Error(say("scene.mesh-short"));
  }
  const from = 8 + 12 * vertices;
  const positions = Float32Array.from({ length: 3 * vertices }, (_, i) => view.getFloat32(8 + 4 * i, true));
  const corners = Uint32Array.from({ length: 3 * triangles }, (_, i) => view.getUint32(from + 4 * i, true));
  if (corners.some((corner) => corner >= vertices)) {
    throw new Error(say("scene.mesh-corner"));
  }
  return { positions, triangles: corners };
}

/** The mesh of an obstacle (`OB5`). */
export async function fetchMesh(session: string, id: number): Promise<TriangleMesh> {
  const response = await askFor("GET", `${addressOf(session)}/${id}`);
  return readMesh(await response.arrayBuffer());
}

/** Places a model in the scene (`OB6`). */
export async function uploadModel(
  session: string,
  model: ModelFile,
  signal?: AbortSignal,
  tell?: (progress: Progress) => void,
): Promise<UploadedObstacle> {
  if (model.body.size > MAX_MODEL_BYTES) {
    throw new Error(say("scene.too-large", { limit: MAX_MODEL_BYTES / 1024 / 1024 }));
  }
  const { send } = await import("../../requests/send");
  return (await send(addressOf(session), model, signal, tell)) as UploadedObstacle;
}

function addressOf(session: string): string {
  return `/api/v1/sessions/${encodeURIComponent(session)}/obstacles`;
}
