// The samples of a TIFF, block by block, as GDAL reads them: any byte order, missing blocks, values that LERC omits.
import { decompress } from 'fzstd';
import { getDecoder } from 'geotiff';
import Lerc from 'lerc';
import { Sentence } from './sentence.js';

const DEFLATE = 8;
const LERC = 34887;
const ZSTD = 50000;
const BY_LIBRARY = [1, 5, DEFLATE, 32946, 32773];
const UNSIGNED = 1;
const SIGNED = 2;
const FLOAT = 3;
const ARRAYS = {
  [UNSIGNED]: { 8: Uint8Array, 16: Uint16Array, 32: Uint32Array, 64: BigUint64Array },
  [SIGNED]: { 8: Int8Array, 16: Int16Array, 32: Int32Array, 64: BigInt64Array },
  [FLOAT]: { 16: Uint16Array, 32: Float32Array, 64: Float64Array },
};
const WORDS = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array, 8: BigUint64Array };

const unpackDeflate = async bytes => (await getDecoder({ Compression: DEFLATE })).decodeBlock(bytes);
const unpackZstd = bytes => decompress(new Uint8Array(bytes)).slice().buffer;

function half(bits) {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  const sign = bits & 0x8000 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (1 + fraction / 1024) * 2 ** (exponent - 15) : fraction * 2 ** -24);
}

export const damaged = name => new Sentence(`${name} is damaged or cut off: its samples cannot be read.`);

/** Most significant bit first; each row begins at a byte. */
function unpackBits(bytes, bits, inRow, rows) {
  const out = new Uint32Array(inRow * rows);
  const rowBytes = Math.ceil((inRow * bits) / 8);
  for (let k = 0; k < out.length; ++k) {
    let value = 0;
    const first = Math.floor(k / inRow) * rowBytes * 8 + (k % inRow) * bits;
    for (let at = first; at < first + bits; ++at) value = value * 2 + ((bytes[at >> 3] >> (7 - (at % 8))) & 1);
    out[k] = value;
  }
  return out;
}

/** Bytes of each row: differences, with the most significant bytes of all values first. */
function undoFloatPredictor(bytes, rowBytes, size, bands) {
  for (let start = 0; start < bytes.length; start += rowBytes) {
    const row = bytes.subarray(start, start + rowBytes);
    const count = rowBytes / size;
    for (let k = bands; k < row.length; ++k) row[k] += row[k - bands];
    const planes = row.slice();
    for (let k = 0; k < count; ++k)
      for (let b = 0; b < size; ++b) row[k * size + b] = planes[(size - 1 - b) * count + k];
  }
}

function addUp(words, inRow, bands) {
  for (let k = 0; k < words.length; ++k) if (k % inRow >= bands) words[k] += words[k - bands];
}

/** The layout of one image in a TIFF. Throws a Sentence for unsupported samples, and any error for a damaged file. */
export class TiffSamples {
  constructor(name, { fileDirectory: d, littleEndian }, buffer) {
    const unknown = what => new Sentence(`${name} ${what}: gdal_translate makes a GeoTIFF of it that this page reads.`);
    Object.assign(this, {
      name,
      buffer,
      isLittle: littleEndian,
      cols: d.ImageWidth,
      rows: d.ImageLength,
      bands: d.SamplesPerPixel ?? 1,
    });
    Object.assign(this, {
      compression: d.Compression ?? 1,
      predictor: d.Predictor ?? 1,
      lercPacked: d.LercParameters?.[1] ?? 0,
      isPlanar: d.PlanarConfiguration === 2,
    });
    this.bits = d.BitsPerSample?.[0] ?? 1;
    this.format = [UNSIGNED, SIGNED, FLOAT, 5, 6].includes(d.SampleFormat?.[0]) ? d.SampleFormat[0] : UNSIGNED;
    if (this.format > FLOAT) throw unknown('holds complex numbers, which are no heights');
    this.Kind = ARRAYS[this.format][this.bits];
    if (![LERC, ZSTD, ...BY_LIBRARY].includes(this.compression))
      throw unknown(`is packed in a way that this page does not know (compression ${this.compression})`);
    if (this.compression === LERC && !this.isLittle)
      throw unknown('holds big-endian numbers packed by LERC, which GDAL itself does not keep exactly');
    const isOdd = !this.Kind && this.format === UNSIGNED && this.bits < 32;
    if (
      !(this.Kind || isOdd) ||
      d.BitsPerSample?.some(bits => bits !== this.bits) ||
      d.SampleFormat?.some(format => format !== d.SampleFormat[0]) ||
      d.FillOrder === 2 ||
      (isOdd && this.predictor !== 1)
    )
      throw unknown(`has samples of a kind that this page does not know (${this.bits} bits, format ${this.format})`);
    if (d.PhotometricInterpretation > 4) throw unknown('is a picture in colours that are not red, green and blue');
    const isTiled = Boolean(d.TileOffsets);
    this.blockCols = isTiled ? d.TileWidth : this.cols;
    this.blockRows = isTiled ? d.TileLength : Math.min(d.RowsPerStrip ?? this.rows, this.rows);
    this.areRowsWhole = isTiled;
    this.offsets = d.TileOffsets ?? d.StripOffsets;
    this.counts = d.TileByteCounts ?? d.StripByteCounts;
    if (!(
      this.cols > 0 &&
      this.rows > 0 &&
      this.blockCols > 0 &&
      this.blockRows > 0 &&
      this.bands > 0 &&
      this.offsets &&
      this.counts
    ))
      throw damaged(this.name);
  }

  /** The least and the greatest value of a sample. */
  get range() {
    if (this.format === FLOAT) return [-Infinity, Infinity];
    return this.format === SIGNED ? [-(2 ** (this.bits - 1)), 2 ** (this.bits - 1) - 1] : [0, 2 ** this.bits - 1];
  }

  /** Unpacks a block of `rows` rows: its numbers, and the count for each pixel. */
  async unpack(bytes, rows) {
    if (this.compression === LERC) return this.unpackLerc(bytes, rows);
    const { bits } = this;
    const bands = this.isPlanar ? 1 : this.bands;
    const inRow = this.blockCols * bands;
    const rowBytes = Math.ceil((inRow * bits) / 8);
    const all = new Uint8Array(
      this.compression === ZSTD
        ? unpackZstd(bytes)
        : await (await getDecoder({ Compression: this.compression })).decodeBlock(bytes),
    );
    if (all.length < rowBytes * rows) throw damaged(this.name);
    const own = all.slice(0, rowBytes * rows);
    const size = bits / 8;
    if (this.predictor === 3) undoFloatPredictor(own, rowBytes, size, bands);
    else if (!this.isLittle && bits % 8 === 0)
      for (let k = 0; k < own.length; k += size) own.subarray(k, k + size).reverse();
    if (!this.Kind) return { values: unpackBits(own, bits, inRow, rows), pitch: bands };
    if (this.predictor === 2) addUp(new WORDS[size](own.buffer), inRow, bands);
    const values = new this.Kind(own.buffer);
    return { values: this.format === FLOAT && bits === 16 ? Float32Array.from(values, half) : values, pitch: bands };
  }

  /** LERC stores NaN, and an alpha band of 0 and 255, as a mask. */
  async unpackLerc(bytes, rows) {
    const packed =
      this.lercPacked === 1 ? await unpackDeflate(bytes) : this.lercPacked === 2 ? unpackZstd(bytes) : bytes;
    const {
      pixels: [values],
      mask,
      width,
      height,
      dimCount: pitch = 1,
    } = Lerc.decode(packed, { returnPixelInterleavedDims: true });
    if (width !== this.blockCols || height < rows) throw damaged(this.name);
    if (mask && this.format === FLOAT)
      for (let k = 0; k < values.length; ++k) if (!mask[Math.floor(k / pitch)]) values[k] = NaN;
    return { values, pitch, mask };
  }

  /** Calls visit(index, value) for every `step`th sample of every `step`th row of a band; `hole`: the value in missing
   * blocks. */
  async each(band, step, hole, visit) {
    const across = Math.ceil(this.cols / this.blockCols);
    const down = Math.ceil(this.rows / this.blockRows);
    const cols = Math.floor(this.cols / step);
    const rows = Math.floor(this.rows / step);
    for (let block = 0; block < across * down; ++block) {
      const left = (block % across) * this.blockCols;
      const top = Math.floor(block / across) * this.blockRows;
      const rowsHere = this.areRowsWhole ? this.blockRows : Math.min(this.blockRows, this.rows - top);
      const at = block + (this.isPlanar ? band * across * down : 0);
      const offset = this.offsets[at];
      const count = this.counts[at];
      if (offset === undefined || count === undefined || offset + count > this.buffer.byteLength)
        throw damaged(this.name);
      const read =
        offset === 0 || count === 0 ? null : await this.unpack(this.buffer.slice(offset, offset + count), rowsHere);
      const k = this.isPlanar ? 0 : band;
      const isAlpha = read && k >= read.pitch;
      for (let row = Math.ceil(top / step); row < rows && row * step < top + rowsHere; ++row) {
        for (let col = Math.ceil(left / step); col < cols && col * step < left + this.blockCols; ++col) {
          const pixel = (row * step - top) * this.blockCols + col * step - left;
          visit(
            row * cols + col,
            !read ? hole : isAlpha ? 255 * (read.mask?.[pixel] ?? 1) : Number(read.values[pixel * read.pitch + k]),
          );
        }
      }
    }
  }
}
