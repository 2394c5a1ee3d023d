/** The box around the bark of all plants, in metres. */
export interface Extent {
  readonly min: readonly [x: number, y: number, z: number];
  readonly max: readonly [x: number, y: number, z: number];
}

interface Gltf {
  readonly meshes?: readonly {
    readonly primitives: readonly { readonly attributes: { readonly POSITION: number } }[];
  }[];
  readonly accessors?: readonly Extent[];
}

/** How far the bark of a session's plants reaches, as its glTF file says: exact, where pictures are not. */
export async function extentOf(address: string): Promise<Extent> {
  const answer = await fetch(`${address.replace("/s/", "/api/sessions/")}/tree.glb`);
  const bytes = Buffer.from(await answer.arrayBuffer());
  // A header of 12 bytes, then the length and the kind of the first chunk, which is the JSON.
  const gltf = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString()) as Gltf;
  const bark = gltf.meshes?.[0]?.primitives[0]?.attributes.POSITION;
  const accessor = bark === undefined ? undefined : gltf.accessors?.[bark];
  if (!accessor) throw new Error(`the file of ${address} has no mesh`);
  return { min: accessor.min, max: accessor.max };
}
