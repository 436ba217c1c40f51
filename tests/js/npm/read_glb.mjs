// A GLB of one node with float32 positions, turned back to z up.
export function readGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const size = view.getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + size)));
  const start = 28 + size;
  const kinds = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
  const widths = { SCALAR: 1, VEC2: 2, VEC3: 3 };
  const list = number => {
    const { bufferView, byteOffset = 0, componentType, count, type } = gltf.accessors[number];
    const Kind = kinds[componentType];
    const at = start + (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    const length = count * widths[type];
    return new Kind(bytes.slice(at, at + length * Kind.BYTES_PER_ELEMENT).buffer);
  };
  const positions = [];
  const indices = [];
  for (const { attributes, indices: corners } of gltf.meshes[0].primitives) {
    const first = positions.length / 3;
    const given = list(attributes.POSITION);
    for (let k = 0; k < given.length; k += 3) positions.push(given[k], 0 - given[k + 2], given[k + 1]);
    for (const corner of list(corners)) indices.push(first + corner);
  }
  const [x, z, south] = gltf.nodes[0].translation ?? [0, 0, 0];
  return { positions, indices, origin: [x, 0 - south, z], gltf };
}
