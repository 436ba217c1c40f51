// Reads the meshes of a GLB file: x east, y north, z up, in double precision. Trusts no number in the file.
import { readImage, surfaceOf } from './images.js';
import { Sentence } from './sentence.js';

const COMPONENTS = {
  5120: Int8Array,
  5121: Uint8Array,
  5122: Int16Array,
  5123: Uint16Array,
  5125: Uint32Array,
  5126: Float32Array,
};
const SIZES = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const COMPRESSION = 'EXT_meshopt_compression';
const KNOWN = [COMPRESSION, 'KHR_mesh_quantization', 'MSFT_lod', 'EXT_texture_webp', 'KHR_materials_unlit'];
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function split(bytes, name) {
  const view = new DataView(bytes);
  if (bytes.byteLength < 20 || view.getUint32(0, true) !== 0x46546c67) throw new Sentence(`${name} is no GLB file.`);
  const chunks = [];
  for (let at = 12; at + 8 <= bytes.byteLength;) {
    const length = view.getUint32(at, true);
    if (at + 8 + length > bytes.byteLength)
      throw new Sentence(`${name} is cut off: a chunk of ${length} bytes is not all there.`);
    chunks.push(new Uint8Array(bytes, at + 8, length));
    at += 8 + length + ((4 - (length % 4)) % 4);
  }
  try {
    return { json: JSON.parse(new TextDecoder().decode(chunks[0])), binary: chunks[1] ?? new Uint8Array() };
  } catch {
    throw new Sentence(`${name} is damaged: its JSON cannot be read.`);
  }
}

function multiply(a, b) {
  return a.map((_, k) => [0, 1, 2, 3].reduce((sum, j) => sum + a[4 * j + (k % 4)] * b[(k & ~3) + j], 0));
}

function matrixOf(node) {
  if (node.matrix) return node.matrix;
  const [x, y, z, w] = node.rotation ?? [0, 0, 0, 1];
  const s = node.scale ?? [1, 1, 1];
  const t = node.translation ?? [0, 0, 0];
  return [
    (1 - 2 * (y * y + z * z)) * s[0],
    2 * (x * y + z * w) * s[0],
    2 * (x * z - y * w) * s[0],
    0,
    2 * (x * y - z * w) * s[1],
    (1 - 2 * (x * x + z * z)) * s[1],
    2 * (y * z + x * w) * s[1],
    0,
    2 * (x * z + y * w) * s[2],
    2 * (y * z - x * w) * s[2],
    (1 - 2 * (x * x + y * y)) * s[2],
    0,
    t[0],
    t[1],
    t[2],
    1,
  ];
}

/** Normals transformed by a matrix, z up. */
function turnNormals(m, normals) {
  const column = k => [m[4 * k], m[4 * k + 1], m[4 * k + 2]];
  const cross = (a, b) => [0, 1, 2].map(k => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
  const [a, b, c] = [
    [1, 2],
    [2, 0],
    [0, 1],
  ].map(([j, k]) => cross(column(j), column(k)));
  const out = new Float64Array(normals.length);
  for (let at = 0; at < out.length; at += 3) {
    const [x, y, z] = normals.subarray(at, at + 3);
    const along = k => a[k] * x + b[k] * y + c[k] * z;
    out.set([along(0), -along(2), along(1)], at);
  }
  return out;
}

class Reader {
  constructor(json, binary, name) {
    Object.assign(this, { json, binary, name, views: new Map(), images: {}, notes: new Set() });
  }

  damaged(what) {
    return new Sentence(`${this.name} is damaged: ${what}.`);
  }

  async open() {
    const unknown = (this.json.extensionsRequired ?? []).find(extension => !KNOWN.includes(extension));
    if (unknown) throw new Sentence(`${this.name} needs the glTF extension ${unknown}, which this page does not know.`);
    if (!(this.json.bufferViews ?? []).some(view => view.extensions?.[COMPRESSION])) return;
    const { MeshoptDecoder } = await import('three/addons/libs/meshopt_decoder.module.js');
    try {
      if (!MeshoptDecoder.supported) throw new Error();
      await MeshoptDecoder.ready;
    } catch {
      throw new Sentence(
        `${this.name} is compressed, and this browser refuses WebAssembly, which unpacks it: ` +
          'write it without --compress.',
      );
    }
    this.decoder = MeshoptDecoder;
  }

  view(index) {
    const view = this.json.bufferViews?.[index];
    if (!view) throw this.damaged(`there is no buffer view ${index}`);
    if (!this.views.has(index)) {
      const packed = view.extensions?.[COMPRESSION];
      const { byteOffset = 0, byteLength } = packed ?? view;
      if (!(byteOffset >= 0 && byteLength >= 0 && byteOffset + byteLength <= this.binary.length))
        throw this.damaged(`buffer view ${index} lies outside the file`);
      let bytes = this.binary.subarray(byteOffset, byteOffset + byteLength);
      if (packed) {
        const unpacked = packed.count * packed.byteStride;
        if (!(unpacked < 2 ** 31)) throw this.damaged(`buffer view ${index} is too large`);
        const target = new Uint8Array(unpacked);
        try {
          this.decoder.decodeGltfBuffer(target, packed.count, packed.byteStride, bytes, packed.mode, packed.filter);
        } catch {
          throw this.damaged(`buffer view ${index} cannot be unpacked`);
        }
        bytes = target;
      }
      this.views.set(index, bytes);
    }
    return { bytes: this.views.get(index), stride: view.byteStride };
  }

  /** The numbers of an accessor; normalized ones are fractions. */
  numbers(index, size) {
    const accessor = this.json.accessors?.[index];
    const Type = COMPONENTS[accessor?.componentType];
    if (!Type || SIZES[accessor.type] !== size) throw this.damaged(`accessor ${index} is not what its mesh needs`);
    const { bytes, stride = Type.BYTES_PER_ELEMENT * size } = this.view(accessor.bufferView);
    const offset = accessor.byteOffset ?? 0;
    const { count } = accessor;
    const width = Type.BYTES_PER_ELEMENT;
    if (!(count > 0) || offset + (count - 1) * stride + width * size > bytes.length)
      throw this.damaged(`accessor ${index} lies outside its buffer`);
    const out = size === 1 ? new Uint32Array(count) : new Float64Array(count * size);
    const scale =
      accessor.normalized && Type !== Float32Array ? 1 / (2 ** (8 * width - (Type.name[0] === 'I' ? 1 : 0)) - 1) : 1;
    const packed = new Uint8Array(count * width * size); // aligned for the array's type
    if (stride === width * size) packed.set(bytes.subarray(offset, offset + packed.length));
    else
      for (let k = 0; k < count; ++k)
        for (let c = 0; c < width * size; ++c) packed[k * width * size + c] = bytes[offset + k * stride + c];
    const items = new Type(packed.buffer);
    for (let k = 0; k < items.length; ++k) out[k] = items[k] * scale;
    return out;
  }

  /** Adds the triangles of a node and of its descendants. */
  collect(index, above, level, depth = 0) {
    const node = this.json.nodes?.[index];
    if (!node || depth > 64) throw this.damaged('its nodes form no tree');
    const matrix = multiply(above, matrixOf(node));
    for (const primitive of this.json.meshes?.[node.mesh]?.primitives ?? []) {
      if (primitive.extras?.scarp?.skirt) continue; // skirts below a tile's edges are no part of its surface
      if ((primitive.mode ?? 4) !== 4) {
        this.notes.add(`Of ${this.name} only triangles are shown: it has primitives of mode ${primitive.mode}, too.`);
        continue;
      }
      const local = this.numbers(primitive.attributes?.POSITION, 3);
      const vertices = local.length / 3;
      const positions = new Float64Array(local.length);
      const m = matrix;
      for (let v = 0; v < vertices; ++v) {
        const x = local[3 * v];
        const y = local[3 * v + 1];
        const z = local[3 * v + 2];
        positions[3 * v] = m[0] * x + m[4] * y + m[8] * z + m[12];
        positions[3 * v + 1] = -(m[2] * x + m[6] * y + m[10] * z + m[14]);
        positions[3 * v + 2] = m[1] * x + m[5] * y + m[9] * z + m[13];
        if (!Number.isFinite(positions[3 * v] + positions[3 * v + 1] + positions[3 * v + 2]))
          throw new Sentence(`Vertex ${v} of ${this.name} has no place: one of its coordinates is no number.`);
      }
      const indices =
        primitive.indices === undefined
          ? Uint32Array.from({ length: vertices }, (_, k) => k)
          : this.numbers(primitive.indices, 1);
      for (const v of indices) if (v >= vertices) throw this.damaged(`a triangle names vertex ${v} of ${vertices}`);
      level.push({ positions, indices, ...this.surface(primitive, vertices, matrix) });
    }
    for (const child of node.children ?? []) this.collect(child, matrix, level, depth + 1);
  }

  /** Normals and positions in an image, if the primitive has them. With a normal map, all vertex normals point up. */
  surface(primitive, vertices, matrix) {
    const { texture, places, ground, hasNormalMap, isMoved } = surfaceOf(this.json, primitive);
    const { attributes } = primitive;
    const ofVertices = (name, size) => {
      const numbers = this.numbers(attributes[name], size);
      if (numbers.length !== size * vertices) throw this.damaged(`${name} is not there for each vertex`);
      return numbers;
    };
    return {
      texture,
      ground,
      isMoved,
      uvs: texture === null ? null : ofVertices(places, 2),
      normals: attributes.NORMAL === undefined || hasNormalMap ? null : turnNormals(matrix, ofVertices('NORMAL', 3)),
    };
  }

  /** The image of a part, if any can be displayed. */
  async image({ texture, isMoved }) {
    if (texture === null) return null;
    const { image = null, why } = isMoved
      ? { why: 'KHR_texture_transform moves it' }
      : await (this.images[texture] ??= readImage(this.json, texture, index => this.view(index).bytes));
    if (why) this.notes.add(`The image of ${this.name} is not shown: ${why}.`);
    return image;
  }

  async join(parts) {
    const count = key => parts.reduce((sum, part) => sum + part[key].length, 0);
    const positions = new Float64Array(count('positions'));
    const indices = new Uint32Array(count('indices') - (count('indices') % 3));
    const images = await Promise.all(parts.map(part => this.image(part)));
    const sheets = [];
    const uvs = images.some(image => image) ? new Float32Array((positions.length / 3) * 2) : null;
    const normals = parts.every(part => part.normals) ? new Float64Array(positions.length) : null;
    let p = 0;
    let i = 0;
    for (const [k, part] of parts.entries()) {
      const image = images[k];
      const ground = uvs && part.ground;
      const last = sheets.at(-1);
      if (last?.image === image && String(last.ground) === String(ground)) last.count += part.indices.length;
      else sheets.push({ image, ground, start: i, count: part.indices.length });
      for (let k = 0; k < part.indices.length; ++k) indices[i + k] = part.indices[k] + p / 3;
      positions.set(part.positions, p);
      normals?.set(part.normals, p);
      if (part.uvs) uvs?.set(part.uvs, (p / 3) * 2);
      p += part.positions.length;
      i += part.indices.length;
    }
    if (indices.length === 0) throw new Sentence(`${this.name} holds no triangles.`);
    return { positions, indices, normals, uvs, sheets };
  }

  /** Level 0 is the scene; level k replaces it by MSFT_lod. */
  levels() {
    const scene = this.json.scenes?.[this.json.scene ?? 0]?.nodes ?? (this.json.nodes ?? []).map((_, k) => k);
    const deepest = Math.max(0, ...scene.map(k => this.json.nodes?.[k]?.extensions?.MSFT_lod?.ids?.length ?? 0));
    return Promise.all(
      Array.from({ length: deepest + 1 }, (_, level) => {
        const parts = [];
        for (const root of scene)
          this.collect(
            level === 0 ? root : (this.json.nodes[root]?.extensions?.MSFT_lod?.ids?.[level - 1] ?? root),
            IDENTITY,
            parts,
          );
        return this.join(parts);
      }),
    );
  }
}

/** {levels: [{positions, indices, normals, uvs, sheets}], extras, notes}: normals and uvs may be null, sheets are runs
 * of indices with their image, or the colour of the ground without images; the file's metadata are in `extras`. Throws
 * a Sentence. */
export async function readGlb(bytes, name) {
  const { json, binary } = split(bytes, name);
  const reader = new Reader(json, binary, name);
  await reader.open();
  return { levels: await reader.levels(), extras: json.asset?.extras ?? {}, notes: [...reader.notes] };
}
