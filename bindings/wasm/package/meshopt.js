// The codec of EXT_meshopt_compression, version 0 for attributes and 1 for triangles: Arseny Kapoulkine's
// meshoptimizer, whose decoders read this encoder's output.
// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/EXT_meshopt_compression

/// A growing array of bytes.
class Bytes {
  #bytes = new Uint8Array(1 << 12);
  size = 0;
  push(byte) {
    if (this.size === this.#bytes.length) {
      const more = new Uint8Array(2 * this.size);
      more.set(this.#bytes);
      this.#bytes = more;
    }
    this.#bytes[this.size++] = byte;
  }
  done() {
    return this.#bytes.slice(0, this.size);
  }
}

const GROUP = 16;
const TAIL = 32;
const MOST = 8192;

/// Writes sixteen bytes with 0, 2, 4 or 8 bits each; bytes that do not fit follow in full.
function groupSize(group, bits) {
  if (bits === 0) return group.every(byte => byte === 0) ? 0 : Infinity;
  if (bits === 8) return GROUP;
  const sentinel = (1 << bits) - 1;
  return 2 * bits + group.reduce((sum, byte) => sum + (byte >= sentinel ? 1 : 0), 0);
}

function writeGroup(out, group, bits) {
  if (bits === 0) return;
  if (bits === 8) {
    group.forEach(byte => out.push(byte));
    return;
  }
  const sentinel = (1 << bits) - 1;
  const perByte = 8 / bits;
  for (let i = 0; i < GROUP; i += perByte) {
    let packed = 0;
    for (let k = 0; k < perByte; ++k) packed = (packed << bits) | Math.min(group[i + k], sentinel);
    out.push(packed);
  }
  group.forEach(byte => {
    if (byte >= sentinel) out.push(byte);
  });
}

/// `items`: bytes, `stride` (a multiple of 4) for each item. Each byte of an item is a separate channel, stored as
/// differences between items.
export function encodeAttributes(items, stride) {
  const count = items.length / stride;
  const blockItems = Math.min(Math.floor(MOST / stride) & ~(GROUP - 1), 256);
  const out = new Bytes();
  const last = items.slice(0, stride);
  out.push(0xa0);
  for (let first = 0; first < count; first += blockItems) {
    const size = Math.min(blockItems, count - first);
    const groups = Math.ceil(size / GROUP);
    for (let channel = 0; channel < stride; ++channel) {
      const deltas = new Uint8Array(groups * GROUP);
      for (let i = 0, before = last[channel]; i < size; ++i) {
        const byte = items[(first + i) * stride + channel];
        const delta = ((byte - before) << 24) >> 24;
        deltas[i] = (delta << 1) ^ (delta >> 7);
        before = byte;
      }
      const parts = Array.from({ length: groups }, (_, g) => deltas.subarray(g * GROUP, (g + 1) * GROUP));
      const modes = parts.map(group =>
        [0, 2, 4, 8].reduce(
          (best, bits, mode, all) => (groupSize(group, bits) < groupSize(group, all[best]) ? mode : best),
          3,
        ),
      );
      for (let g = 0; g < groups; g += 4)
        out.push(modes.slice(g, g + 4).reduce((byte, mode, k) => byte | (mode << (2 * k)), 0));
      parts.forEach((group, g) => writeGroup(out, group, [0, 2, 4, 8][modes[g]]));
    }
    last.set(items.subarray((first + size - 1) * stride, (first + size) * stride));
  }
  for (let k = stride; k < TAIL; ++k) out.push(0);
  items.subarray(0, stride).forEach(byte => out.push(byte));
  return out.done();
}

const ORDERS = [
  [0, 1, 2],
  [1, 2, 0],
  [2, 0, 1],
];
const PAIRS = [0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0, 0];

/// The last 16 values, the newest first.
class Recent {
  #items = new Array(16).fill(null);
  #at = 0;
  push(item) {
    this.#items[this.#at] = item;
    this.#at = (this.#at + 1) & 15;
  }
  find(fits) {
    for (let i = 0; i < 16; ++i) {
      const item = this.#items[(this.#at - 1 - i) & 15];
      if (item !== null && fits(item)) return i;
    }
    return -1;
  }
  clear() {
    this.#items.fill(null);
  }
}

/// Writes a whole number; numbers near 0 need fewer bytes.
function writeDelta(out, delta) {
  for (let code = ((delta << 1) ^ (delta >> 31)) >>> 0; ; code >>>= 7) {
    out.push((code & 127) | (code > 127 ? 128 : 0));
    if (code <= 127) break;
  }
}

/// Version 1: the codes of the triangles, their data, and the table of pairs.
function pack(codes, data) {
  PAIRS.forEach(pair => data.push(pair));
  const bytes = new Uint8Array(1 + codes.size + data.size);
  bytes[0] = 0xe1;
  bytes.set(codes.done(), 1);
  bytes.set(data.done(), 1 + codes.size);
  return bytes;
}

/// Encodes each triangle by an edge of a recent triangle, and its third corner by recent vertices.
export function encodeTriangles(corners) {
  const codes = new Bytes();
  const data = new Bytes();
  const edges = new Recent();
  const vertices = new Recent();
  let next = 0;
  let last = 0;
  const placeOf = v => vertices.find(other => other === v);
  const isNext = v => v === next && (++next, true);
  const codeOf = (v, place = placeOf(v)) => (place >= 0 && place < 14 ? place + 1 : isNext(v) ? 0 : 15);
  const writeIndex = v => {
    writeDelta(data, (v - last) | 0);
    last = v;
  };
  for (let t = 0; t < corners.length; t += 3) {
    const given = [corners[t], corners[t + 1], corners[t + 2]];
    let turn = -1;
    const edge = edges.find(
      ([from, to]) => (turn = ORDERS.findIndex(([a, b]) => given[a] === from && given[b] === to)) >= 0,
    );
    if (edge >= 0 && edge < 15) {
      const [a, b, c] = ORDERS[turn].map(k => given[k]);
      const place = placeOf(c);
      let code = place >= 1 && place < 13 ? place : isNext(c) ? 0 : 15;
      if (code === 15 && Math.abs(c - last) === 1) {
        code = c < last ? 13 : 14;
        last = c;
      }
      codes.push((edge << 4) | code);
      if (code === 15) writeIndex(c);
      if (code === 0 || code >= 13) vertices.push(c);
      edges.push([c, b]);
      edges.push([a, c]);
      continue;
    }
    const [a, b, c] = ORDERS[given[1] === next ? 1 : given[2] === next ? 2 : 0].map(k => given[k]);
    const isReset = a === 0 && b === 1 && c === 2 && next > 0;
    if (isReset) {
      next = 0;
      vertices.clear();
    }
    const codeA = isNext(a) ? 0 : 15;
    const codeB = codeOf(b);
    const codeC = codeOf(c);
    const pair = PAIRS.indexOf((codeB << 4) | codeC);
    if (codeA === 0 && pair >= 0 && pair < 14 && !isReset) codes.push(0xf0 | pair);
    else {
      codes.push(0xf0 | 14 | codeA);
      data.push((codeB << 4) | codeC);
    }
    [codeA, codeB, codeC].forEach((code, k) => {
      const v = [a, b, c][k];
      if (code === 15) writeIndex(v);
      if (code === 0 || code === 15) vertices.push(v);
    });
    edges.push([b, a]);
    edges.push([c, b]);
    edges.push([a, c]);
  }
  return pack(codes, data);
}

/// Orders triangles from neighbour to neighbour, the nearest edges first, and vertices by first use, which needs few
/// bytes.
export function orderForCodec(corners, vertexCount) {
  const count = corners.length / 3;
  const across = new Int32Array(corners.length).fill(-1);
  const edges = new Map();
  for (let k = 0; k < corners.length; ++k) {
    const a = corners[k];
    const b = corners[k % 3 === 2 ? k - 2 : k + 1];
    const twin = edges.get(b * vertexCount + a);
    if (twin === undefined) edges.set(a * vertexCount + b, k);
    else [across[k], across[twin]] = [twin, k];
  }
  const isDone = new Uint8Array(count);
  const ordered = [];
  const ids = new Int32Array(vertexCount).fill(-1);
  const from = [];
  const open = [];
  for (let start = 0; start < count; ++start) {
    for (open.push(3 * start); open.length > 0;) {
      const first = open.pop();
      const t = Math.floor(first / 3);
      if (isDone[t]) continue;
      isDone[t] = 1;
      const turned = [0, 1, 2].map(k => 3 * t + ((first + k) % 3));
      for (const k of turned) {
        const v = corners[k];
        if (ids[v] < 0) ids[v] = from.push(v) - 1;
        ordered.push(ids[v]);
      }
      // Continue through the edge before the entry edge: then the next triangle forms a fan or a strip.
      for (const k of [turned[0], turned[1], turned[2]]) if (across[k] >= 0) open.push(across[k]);
    }
  }
  return { corners: ordered, from };
}
