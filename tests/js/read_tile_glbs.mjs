// Decodes the GLBs of a folder of 3D Tiles terrain with meshoptimizer's own decoder: read_tile_glbs.mjs FOLDER
//
// Fails if two neighbours of a level differ in a position or normal on their shared edge, or if CESIUM_tile_edges does
// not list a tile's edges clockwise, as CesiumJS expects. Prints tiles and edges.
import fs from 'node:fs';
import { MeshoptDecoder } from 'meshoptimizer/decoder';

await MeshoptDecoder.ready;
const kinds = {
  5120: Int8Array,
  5121: Uint8Array,
  5122: Int16Array,
  5123: Uint16Array,
  5125: Uint32Array,
  5126: Float32Array,
};
const widths = { SCALAR: 1, VEC3: 3 };

const clockwise = ['left', 'top', 'right', 'bottom'];

function read(file) {
  const bytes = fs.readFileSync(file);
  const jsonSize = bytes.readUInt32LE(12);
  const gltf = JSON.parse(bytes.subarray(20, 20 + jsonSize));
  const binary = new Uint8Array(bytes.subarray(28 + jsonSize));
  const view = number => {
    const { byteOffset = 0, byteLength, extensions } = gltf.bufferViews[number];
    const packed = extensions?.EXT_meshopt_compression;
    if (!packed) return binary.subarray(byteOffset, byteOffset + byteLength);
    const { count, byteStride, mode, filter } = packed;
    const target = new Uint8Array(count * byteStride);
    const from = binary.subarray(packed.byteOffset ?? 0, (packed.byteOffset ?? 0) + packed.byteLength);
    MeshoptDecoder.decodeGltfBuffer(target, count, byteStride, from, mode, filter);
    return target;
  };
  /// An accessor as a list of tuples.
  const list = number => {
    const { bufferView, byteOffset = 0, componentType, count, type } = gltf.accessors[number];
    const Kind = kinds[componentType];
    const width = widths[type];
    const data = view(bufferView);
    const stride = gltf.bufferViews[bufferView].byteStride ?? width * Kind.BYTES_PER_ELEMENT;
    return Array.from({ length: count }, (_, k) => {
      const at = byteOffset + k * stride;
      return Array.from(new Kind(data.slice(at, at + width * Kind.BYTES_PER_ELEMENT).buffer));
    });
  };
  const [primitive] = gltf.meshes[0].primitives;
  const { matrix } = gltf.nodes[0];
  const positions = list(primitive.attributes.POSITION);
  const scale = gltf.accessors[primitive.attributes.POSITION].normalized ? 1 / 65535 : 1;
  const normals = list(primitive.attributes.NORMAL);
  const places = positions.map(([x, y, z]) =>
    [0, 1, 2].map(row => (matrix[row] * x + matrix[row + 4] * y + matrix[row + 8] * z) * scale + matrix[row + 12]),
  );
  const edge = name =>
    list(primitive.extensions.CESIUM_tile_edges[name]).map(([k]) => ({ place: places[k], normal: normals[k] }));
  return Object.fromEntries(clockwise.map(name => [name, edge(name)]));
}

const [folder] = process.argv.slice(2);
const tiles = new Map();
for (const name of fs.readdirSync(folder, { recursive: true })) {
  const found = /^([01])\/(\d+)\/(\d+)\/(\d+)\.glb$/.exec(name);
  if (!found) continue;
  const [root, z, x, y] = found.slice(1).map(Number);
  tiles.set([z, root * 2 ** z + x, y].join(), read(`${folder}/${name}`));
}
let edges = 0;
const same = (a, b) => a.place.every((value, part) => value === b.place[part]);
for (const [key, tile] of tiles) {
  clockwise.forEach((name, k) => {
    if (!same(tile[name].at(-1), tile[clockwise[(k + 1) % 4]][0]))
      throw new Error(`${key}: "${name}" does not end where the next list begins`);
  });
  const [z, x, y] = key.split(',').map(Number);
  for (const [other, mine, theirs] of [
    [[z, (x + 1) % 2 ** (z + 1), y], 'right', 'left'],
    [[z, x, y + 1], 'top', 'bottom'],
  ]) {
    const neighbour = tiles.get(other.join());
    if (!neighbour) continue;
    ++edges;
    const [a, b] = [tile[mine], neighbour[theirs].toReversed()];
    if (a.length !== b.length) throw new Error(`${key} and ${other}: ${a.length} and ${b.length} vertices on the edge`);
    a.forEach((vertex, k) => {
      // The decoder's division by 65535 has a rounding error.
      const apart = Math.hypot(...vertex.place.map((value, part) => value - b[k].place[part]));
      if (apart > 1e-9 * Math.hypot(...vertex.place))
        throw new Error(`${key} and ${other}: vertex ${k} of the edge is ${apart} m apart`);
      if (vertex.normal.some((value, part) => value !== b[k].normal[part])) {
        throw new Error(`${key} and ${other}: normals ${vertex.normal} and ${b[k].normal} at vertex ${k} of the edge`);
      }
    });
  }
}
console.log(tiles.size, edges);
