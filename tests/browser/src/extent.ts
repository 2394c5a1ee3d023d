/** The box around the wood of all plants, in metres. */
export interface Extent {
  readonly min: readonly [x: number, y: number, z: number];
  readonly max: readonly [x: number, y: number, z: number];
}

interface Node {
  readonly name: string;
  readonly mesh?: number;
  readonly children?: readonly number[];
  readonly translation?: readonly [number, number, number];
}

interface Gltf {
  readonly nodes?: readonly Node[];
  readonly meshes?: readonly {
    readonly primitives: readonly { readonly attributes: { readonly POSITION: number } }[];
  }[];
  readonly accessors?: readonly Extent[];
}

/** How far the wood of a session's plants reaches, as its glTF file says: exact, where pictures are not. */
export async function extentOf(address: string): Promise<Extent> {
  const answer = await fetch(`${address.replace("/s/", "/api/v1/sessions/")}/tree.glb`);
  const bytes = Buffer.from(await answer.arrayBuffer());
  // A header of 12 bytes, then the length and the kind of the first chunk, which is the JSON.
  const gltf = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString()) as Gltf;
  const boxes = (gltf.nodes ?? []).flatMap((plant) => {
    const wood = plant.children?.map((child) => gltf.nodes?.[child]).find((node) => node?.name === "Wood");
    const place = wood?.mesh === undefined ? undefined : gltf.meshes?.[wood.mesh]?.primitives[0]?.attributes.POSITION;
    const accessor = place === undefined ? undefined : gltf.accessors?.[place];
    return accessor ? [moved(accessor, plant.translation ?? [0, 0, 0])] : [];
  });
  const [first, ...others] = boxes;
  if (!first) throw new Error(`the file of ${address} has no mesh`);
  return others.reduce(around, first);
}

function moved({ min, max }: Extent, [x, y, z]: readonly [number, number, number]): Extent {
  return { min: [min[0] + x, min[1] + y, min[2] + z], max: [max[0] + x, max[1] + y, max[2] + z] };
}

function around(one: Extent, other: Extent): Extent {
  const least = (i: 0 | 1 | 2) => Math.min(one.min[i], other.min[i]);
  const most = (i: 0 | 1 | 2) => Math.max(one.max[i], other.max[i]);
  return { min: [least(0), least(1), least(2)], max: [most(0), most(1), most(2)] };
}
