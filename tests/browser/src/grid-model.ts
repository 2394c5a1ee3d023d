/** A sheet of so many squares a side as a glTF binary: a model as large as a test wants it. */
export function gridModel(side: number): Buffer {
  const points = (side + 1) ** 2;
  const binary = Buffer.alloc(points * 12 + side * side * 24);
  for (let i = 0; i < points; i++) {
    binary.writeFloatLE((i % (side + 1)) / side, i * 12);
    binary.writeFloatLE(Math.floor(i / (side + 1)) / side, i * 12 + 4);
  }
  for (let square = 0; square < side * side; square++) {
    const corner = square + Math.floor(square / side);
    const corners = [corner, corner + 1, corner + side + 1, corner + 1, corner + side + 2, corner + side + 1];
    corners.forEach((point, i) => {
      binary.writeUInt32LE(point, points * 12 + square * 24 + i * 4);
    });
  }
  const json = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: points, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0] },
      { bufferView: 1, componentType: 5125, count: side * side * 6, type: "SCALAR" },
    ],
    bufferViews: [
      { buffer: 0, byteLength: points * 12 },
      { buffer: 0, byteOffset: points * 12, byteLength: side * side * 24 },
    ],
    buffers: [{ byteLength: binary.length }],
  };
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, " ")]);
  const words = (...numbers: number[]) => {
    const bytes = Buffer.alloc(numbers.length * 4);
    numbers.forEach((number, i) => {
      bytes.writeUInt32LE(number, i * 4);
    });
    return bytes;
  };
  const length = 12 + 8 + padded.length + 8 + binary.length;
  return Buffer.concat([
    words(0x46546c67, 2, length, padded.length, 0x4e4f534a),
    padded,
    words(binary.length, 0x004e4942),
    binary,
  ]);
}
