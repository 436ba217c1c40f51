// GLB: glTF 2.0 in one file, y up. A JSON chunk describes one binary chunk of vertex attributes and indices.
import { ScarpError } from './error.js';
import { checkFloat32 } from './heights.js';
import { checkMesh } from './mesh.js';
import { kindOf, takeOptions } from './options.js';
import { encodeAttributes, encodeTriangles, orderForCodec } from './meshopt.js';

const MESHOPT = 'EXT_meshopt_compression';
const BYTE_KINDS = { Int16Array: 5122, Uint16Array: 5123, Uint32Array: 5125, Float32Array: 5126 };
const ARRAY_BUFFER = 34962;
const INDEX_BUFFER = 34963;
const pad4 = size => Math.ceil(size / 4) * 4;

/// (x, y, z) becomes (x, z, -y): a rotation, which keeps the winding.
function yUp(array) {
  const turned = new Float32Array(array.length);
  for (let k = 0; k < array.length; k += 3) {
    turned[k] = array[k];
    turned[k + 1] = array[k + 2];
    turned[k + 2] = 0 - array[k + 1];
  }
  return turned;
}

function bounds(positions) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < positions.length; ++k) {
    min[k % 3] = Math.min(min[k % 3], positions[k]);
    max[k % 3] = Math.max(max[k % 3], positions[k]);
  }
  return { min, max };
}

class Builder {
  pieces = [];
  size = 0;
  unpacked = 0;
  accessors = [];
  bufferViews = [];

  #addPiece(bytes) {
    const byteOffset = pad4(this.size);
    this.pieces.push({ byteOffset, bytes });
    this.size = byteOffset + bytes.length;
    return { byteOffset, byteLength: bytes.length };
  }
  #addAccessor(array, count, width, more) {
    this.accessors.push({
      bufferView: this.bufferViews.length - 1,
      componentType: BYTE_KINDS[kindOf(array)],
      count,
      type: width === 1 ? 'SCALAR' : `VEC${width}`,
      ...more,
    });
    return this.accessors.length - 1;
  }

  add(array, width, target, more = {}) {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    this.bufferViews.push({ buffer: 0, ...this.#addPiece(bytes), target });
    return this.#addAccessor(array, array.length / width, width, more);
  }

  /// Compressed; items of attributes are padded to 4 bytes.
  addPacked(array, width, target, more = {}) {
    const count = array.length / width;
    const isIndices = target === INDEX_BUFFER;
    const size = array.BYTES_PER_ELEMENT * width;
    const byteStride = isIndices ? size : pad4(size);
    let packed;
    if (isIndices) packed = encodeTriangles(array);
    else {
      const items = new Uint8Array(count * byteStride);
      const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
      for (let v = 0; v < count; ++v) items.set(bytes.subarray(v * size, (v + 1) * size), v * byteStride);
      packed = encodeAttributes(items, byteStride);
    }
    this.bufferViews.push({
      buffer: 1,
      byteOffset: this.unpacked,
      byteLength: count * byteStride,
      ...(isIndices ? {} : { byteStride }),
      target,
      extensions: {
        [MESHOPT]: {
          buffer: 0,
          ...this.#addPiece(packed),
          byteStride,
          count,
          mode: isIndices ? 'TRIANGLES' : 'ATTRIBUTES',
        },
      },
    });
    this.unpacked = pad4(this.unpacked + count * byteStride);
    return this.#addAccessor(array, count, width, more);
  }

  assemble(json) {
    const { accessors, bufferViews, size, unpacked } = this;
    const buffers = [{ byteLength: size }];
    if (unpacked > 0) buffers.push({ byteLength: unpacked, extensions: { [MESHOPT]: { fallback: true } } });
    const text = new TextEncoder().encode(JSON.stringify({ ...json, accessors, bufferViews, buffers }));
    const padded = new Uint8Array(pad4(text.length)).fill(0x20);
    padded.set(text);
    const total = 28 + padded.length + pad4(size);
    if (total >= 2 ** 32)
      throw new ScarpError('output', `a GLB file holds less than 4 GiB, and this mesh needs ${total} bytes`);
    const file = new Uint8Array(total);
    const words = new DataView(file.buffer);
    [0x46546c67, 2, total, padded.length, 0x4e4f534a].forEach((word, k) => words.setUint32(4 * k, word, true));
    file.set(padded, 20);
    words.setUint32(20 + padded.length, pad4(size), true);
    words.setUint32(24 + padded.length, 0x004e4942, true);
    for (const { byteOffset, bytes } of this.pieces) file.set(bytes, 28 + padded.length + byteOffset);
    return file;
  }
}

/// Largest numbers of a grid: of 16 bits, and of consecutive whole numbers in float32.
const MOST_SHORT = 65535;
const MOST_WHOLE = 2 ** 24;

/// The largest step, at most `most`, of which all offsets of an axis are multiples; null without one. `slack`:
/// tolerance for rounding in double.
function findStep(values, axis, low, { unit, finest, most, slack = 0 }) {
  for (let step = unit; step >= finest; step /= 2) {
    let isOnGrid = true;
    for (let k = axis; k < values.length && isOnGrid; k += 3) {
      const number = Math.round((values[k] - low) / step);
      if (number > most) return null;
      isOnGrid = Math.abs(low + number * step - values[k]) <= slack;
    }
    if (isOnGrid) return step;
  }
  return null;
}

/// Positions, unchanged, as 16-bit numbers with y up, or, for float64 positions beyond 16 bits, as whole numbers in
/// float32. null if no grid fits.
function findGrid({ positions, cell = [0, 0], origin }) {
  const { min, max } = bounds(positions);
  const areDoubles = kindOf(positions) !== 'Float32Array';
  const most = areDoubles ? MOST_WHOLE : MOST_SHORT;
  const [x, y] = [0, 1].map(axis => {
    const unit = Math.abs(cell[axis]) || 1;
    const farthest = Math.abs(origin[axis]) + Math.max(Math.abs(min[axis]), Math.abs(max[axis]));
    return findStep(positions, axis, min[axis], {
      unit,
      finest: unit / 256,
      most,
      slack: areDoubles ? farthest * 2 ** -51 : 0,
    });
  });
  const z = findStep(positions, 2, min[2], { unit: 1024, finest: 2 ** -40, most: MOST_SHORT });
  if (!(x && y && (z || areDoubles))) return null;
  const isShort = z && (max[0] - min[0]) / x < MOST_SHORT + 0.5 && (max[1] - min[1]) / y < MOST_SHORT + 0.5;
  const numbers = new (isShort ? Uint16Array : Float32Array)(positions.length);
  for (let k = 0; k < positions.length; k += 3) {
    numbers[k] = Math.round((positions[k] - min[0]) / x);
    numbers[k + 1] = z ? Math.round((positions[k + 2] - min[2]) / z) : positions[k + 2];
    numbers[k + 2] = Math.round((max[1] - positions[k + 1]) / y);
  }
  return { numbers, shift: [min[0], z ? min[2] : 0, 0 - max[1]], scale: [x, z ?? 1, y] };
}

/// Rounded to 15 bits; a renderer divides normals by the scale of the node.
function packNormals(normals, scale) {
  const packed = new Int16Array(normals.length);
  for (let k = 0; k < normals.length; k += 3) {
    const scaled = [0, 1, 2].map(axis => normals[k + axis] * scale[axis]);
    const length = Math.hypot(...scaled);
    for (let axis = 0; axis < 3; ++axis) packed[k + axis] = Math.round((32767 * scaled[axis]) / length);
  }
  return packed;
}

/// The same array in another order of vertices.
function gather(array, width, from) {
  const moved = new array.constructor(from.length * width);
  from.forEach((v, to) => moved.set(array.subarray(v * width, (v + 1) * width), to * width));
  return moved;
}

/// The compressed attributes and indices. Positions in float32 or on a lattice keep their values; normals and texture
/// coordinates in 0 … 1 are rounded.
function addCompressed(glb, mesh) {
  const { positions, indices, normals, uvs } = mesh;
  const { corners, from } = orderForCodec(indices, positions.length / 3);
  const { numbers, shift, scale } = findGrid(mesh) ?? { numbers: yUp(positions), shift: [0, 0, 0], scale: [1, 1, 1] };
  const placed = gather(numbers, 3, from);
  const attributes = { POSITION: glb.addPacked(placed, 3, ARRAY_BUFFER, bounds(placed)) };
  if (normals)
    attributes.NORMAL = glb.addPacked(gather(packNormals(yUp(normals), scale), 3, from), 3, ARRAY_BUFFER, {
      normalized: true,
    });
  if (uvs) {
    const fit = uvs.every(value => value >= 0 && value <= 1);
    const numbers = fit ? Uint16Array.from(uvs, value => Math.round(65535 * value)) : Float32Array.from(uvs);
    attributes.TEXCOORD_0 = glb.addPacked(gather(numbers, 2, from), 2, ARRAY_BUFFER, fit ? { normalized: true } : {});
  }
  const Corner = from.length <= 65535 ? Uint16Array : Uint32Array;
  return { attributes, indices: glb.addPacked(Corner.from(corners), 1, INDEX_BUFFER), shift, scale };
}

function addPlain(glb, { positions, indices, normals, uvs }) {
  const turned = yUp(positions);
  const attributes = { POSITION: glb.add(turned, 3, ARRAY_BUFFER, bounds(turned)) };
  if (normals) attributes.NORMAL = glb.add(yUp(normals), 3, ARRAY_BUFFER);
  if (uvs) attributes.TEXCOORD_0 = glb.add(Float32Array.from(uvs), 2, ARRAY_BUFFER);
  const corners = ['Uint16Array', 'Uint32Array'].includes(kindOf(indices)) ? indices : Uint32Array.from(indices);
  return { attributes, indices: glb.add(corners, 1, INDEX_BUFFER), shift: [0, 0, 0], scale: [1, 1, 1] };
}

/// The bytes of a GLB file, whose node's translation is the mesh's origin. `compress`: meshoptimizer's codec, supported
/// by three.js, Babylon.js and CesiumJS; positions on a lattice (simplify's option) have 16 bits each.
export function encodeGlb(mesh, options = {}) {
  const { compress = false } = takeOptions(options, 'glb');
  const checked = checkMesh(mesh);
  const [x, y, z] = checked.origin;
  for (const name of ['positions', 'origin', 'normals', 'uvs'])
    if (checked[name]) checkFloat32(`the mesh's ${name}`, checked[name]);
  const glb = new Builder();
  const { shift, scale, ...primitive } = (compress ? addCompressed : addPlain)(glb, checked);
  const translation = [x + shift[0], z + shift[1], 0 - y + shift[2]];
  checkFloat32('the translation of the node', translation);
  const extensions = compress ? ['KHR_mesh_quantization', MESHOPT] : [];
  return glb.assemble({
    asset: { version: '2.0', generator: 'Scarp' },
    ...(compress ? { extensionsUsed: extensions, extensionsRequired: extensions } : {}),
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name: 'terrain', mesh: 0, translation, scale }],
    meshes: [{ name: 'terrain', primitives: [{ ...primitive, material: 0, mode: 4 }] }],
    materials: [
      {
        name: 'earth',
        pbrMetallicRoughness: { baseColorFactor: [0.47, 0.42, 0.33, 1], metallicFactor: 0, roughnessFactor: 1 },
      },
    ],
  });
}
