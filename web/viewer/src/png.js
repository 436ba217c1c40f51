// Reads the unchanged numbers of a PNG: a canvas would reduce 16 bits to 8, replace palette indices by colours, and
// manage colours.
import { Sentence } from './sentence.js';

const CHANNELS = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 };
const WHOLE = [[0, 0, 1, 1]];
const INTERLACED = [
  [0, 0, 8, 8],
  [4, 0, 8, 8],
  [0, 4, 4, 8],
  [2, 0, 4, 4],
  [0, 2, 2, 4],
  [1, 0, 2, 2],
  [0, 1, 1, 2],
];

function* chunksOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at);
    if (at + 12 + length > bytes.length) return;
    yield [String.fromCharCode(...bytes.subarray(at + 4, at + 8)), bytes.subarray(at + 8, at + 8 + length)];
    at += 12 + length;
  }
}

/** Unpacks at most `size` bytes. */
async function inflate(parts, size) {
  const out = new Uint8Array(size);
  const reader = new Blob(parts).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
  let filled = 0;
  while (filled < size) {
    const { done, value } = await reader.read();
    if (done) return null;
    out.set(value.subarray(0, size - filled), filled);
    filled += value.length;
  }
  reader.cancel().catch(() => {});
  return out;
}

/** Reverses the filter of one row: differences from its neighbours. */
function undoFilter(kind, row, above, pixel) {
  for (let k = 0; k < row.length; ++k) {
    const left = k < pixel ? 0 : row[k - pixel];
    const up = above ? above[k] : 0;
    const corner = above && k >= pixel ? above[k - pixel] : 0;
    if (kind === 1) row[k] += left;
    else if (kind === 2) row[k] += up;
    else if (kind === 3) row[k] += (left + up) >> 1;
    else {
      const a = Math.abs(up - corner);
      const b = Math.abs(left - corner);
      const c = Math.abs(left + up - 2 * corner);
      row[k] += a <= b && a <= c ? left : b <= c ? up : corner;
    }
  }
}

/** The nodata values; null: none. */
function findMissing(color, transparency) {
  if (!transparency) return null;
  if (color !== 3)
    return color === 0 || color === 2
      ? Array.from({ length: CHANNELS[color] }, (_, k) => (transparency[2 * k] << 8) | transparency[2 * k + 1])
      : null;
  const clear = transparency.indexOf(0);
  return clear >= 0 && transparency.every((alpha, k) => alpha === 255 || k === clear) ? [clear] : null;
}

/** {width, height, depth, channels, isPalette, values, missing}. Throws a Sentence. */
export async function readPng(name, bytes, mostPixels) {
  const damaged = () => new Sentence(`${name} is damaged or cut off: its pixels cannot be read.`);
  if (bytes.length < 8 || [0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10].some((byte, k) => bytes[k] !== byte))
    throw new Sentence(`${name} is no PNG image.`);
  const packed = [];
  let header, transparency;
  for (const [kind, data] of chunksOf(bytes)) {
    if (kind === 'IHDR' && data.length === 13) header = data;
    else if (kind === 'tRNS') transparency = data;
    else if (kind === 'IDAT') packed.push(data);
  }
  if (!header) throw damaged();
  const view = new DataView(header.buffer, header.byteOffset);
  const [width, height] = [view.getUint32(0), view.getUint32(4)];
  const [depth, color, , , interlace] = header.subarray(8);
  const channels = CHANNELS[color];
  const bits = channels * depth;
  const pixel = Math.max(1, bits >> 3);
  if (!channels || ![1, 2, 4, 8, 16].includes(depth) || !width || !height || interlace > 1) throw damaged();
  if (width * height > mostPixels) throw new Sentence(`${name} has ${width} x ${height} pixels, too many for a page.`);
  const passes = (interlace ? INTERLACED : WHOLE)
    .map(([x, y, dx, dy]) => ({ x, y, dx, dy, cols: Math.ceil((width - x) / dx), rows: Math.ceil((height - y) / dy) }))
    .filter(pass => pass.cols > 0 && pass.rows > 0);
  const rowBytes = pass => Math.ceil((pass.cols * bits) / 8);
  const raw = await inflate(
    packed,
    passes.reduce((sum, pass) => sum + pass.rows * (1 + rowBytes(pass)), 0),
  ).catch(() => null);
  if (!raw) throw damaged();
  const values = new (depth === 16 ? Uint16Array : Uint8Array)(width * height * channels);
  const mask = (1 << Math.min(depth, 8)) - 1;
  let at = 0;
  for (const pass of passes) {
    for (let r = 0, above = null; r < pass.rows; ++r) {
      const kind = raw[at];
      const row = raw.subarray(at + 1, (at += 1 + rowBytes(pass)));
      if (kind > 4) throw damaged();
      if (kind > 0) undoFilter(kind, row, above, pixel);
      above = row;
      for (let k = 0; k < pass.cols * channels; ++k) {
        const to =
          ((pass.y + r * pass.dy) * width + pass.x + Math.floor(k / channels) * pass.dx) * channels + (k % channels);
        values[to] =
          depth === 16
            ? (row[2 * k] << 8) | row[2 * k + 1]
            : depth === 8
              ? row[k]
              : (row[(k * depth) >> 3] >> (8 - depth - ((k * depth) & 7))) & mask;
      }
    }
  }
  return { width, height, depth, channels, isPalette: color === 3, values, missing: findMissing(color, transparency) };
}
