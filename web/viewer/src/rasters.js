// Rasters dropped on the page: GeoTIFF, .hgt, and PNG web tiles, in the program's frame.
import { Field } from './field.js';
import { gridFrame, localFrame } from './frame.js';
import { readGeotiff } from './geotiff.js';
import { readPng } from './png.js';
import { Sentence } from './sentence.js';
import { warnOfUndeclared } from './undeclared.js';

const MOST_SAMPLES = 2 ** 24;

function readHgt(name, buffer) {
  const side = Math.round(Math.sqrt(buffer.byteLength / 2));
  const place = /^([NS])(\d\d)([EW])(\d{3})/i.exec(name);
  if (side < 2 || side * side * 2 !== buffer.byteLength)
    throw new Sentence(`${name} is no square of 16-bit heights, as a .hgt file is.`);
  const view = new DataView(buffer);
  const samples = new Float32Array(side * side);
  for (let k = 0; k < samples.length; ++k) {
    const z = view.getInt16(2 * k);
    samples[k] = z === -32768 ? NaN : z;
  }
  const raster = { cols: side, rows: side, samples, unit: 'm', notes: [] };
  if (!place) return { ...raster, frame: gridFrame(side) };
  const [, ns, south, ew, west] = place;
  const cell = 1 / (side - 1);
  const x = Number(west) * (/w/i.test(ew) ? -1 : 1);
  const y = Number(south) * (/s/i.test(ns) ? -1 : 1) + 1;
  return {
    ...raster,
    frame: localFrame([x, cell, 0, y, 0, -cell], side, side, { radians: Math.PI / 180, crs: 'EPSG:4326' }),
  };
}

const DECODINGS = {
  terrarium: (r, g, b) => r * 256 + g + b / 256 - 32768,
  mapbox: (r, g, b) => -10000 + (r * 65536 + g * 256 + b) * 0.1,
  grey: r => r,
};
// Limits of heights on earth.
const LOWEST = -12000;
const HIGHEST = 9000;
const MOST_ODD = 0.1; // share of nodata among a tile's pixels

/** The decoding with heights on earth. Never both: terrarium's have a red of 81 to 163, mapbox's of 0 to 2. */
function guessDecoding(pixels, decode) {
  const found = ['terrarium', 'mapbox'].find(key => {
    const heights = decode(key);
    let there = 0;
    let odd = 0;
    for (const z of heights) {
      if (z !== z) continue;
      ++there;
      odd += !(z >= LOWEST && z <= HIGHEST);
    }
    return there > 0 && odd <= MOST_ODD * there;
  });
  return found ?? 'grey';
}

const NOTES = {
  terrarium: 'Colours are taken for heights as of terrarium tiles.',
  mapbox: 'Colours are taken for heights as of mapbox tiles.',
  grey: 'This is a colour picture, and its red is taken as height.',
};

/** Values of a grey PNG or one with a palette are heights. `asked`: a decoding; null: the one that fits. */
async function readPngHeights(name, buffer, asked) {
  const image = await readPng(name, new Uint8Array(buffer), MOST_SAMPLES);
  const { width, height, channels, values, missing } = image;
  const isMissing = at =>
    (channels % 2 === 0 && values[at + channels - 1] === 0) ||
    (missing !== null && missing.every((value, k) => values[at + k] === value));
  const decode = key =>
    Float64Array.from({ length: width * height }, (_, k) =>
      isMissing(channels * k)
        ? NaN
        : DECODINGS[key](values[channels * k], values[channels * k + 1], values[channels * k + 2]),
    );
  const isPacked = channels >= 3 && image.depth === 8;
  const key = isPacked ? (asked ?? guessDecoding(image, decode)) : 'grey';
  const note =
    channels >= 3
      ? NOTES[key]
      : image.isPalette
        ? 'The numbers of the palette are taken for heights.'
        : 'Grey levels are taken for heights.';
  return {
    cols: width,
    rows: height,
    samples: decode(key),
    frame: gridFrame(height),
    unit: key === 'grey' ? '' : 'm',
    notes: [note],
    decoding: isPacked ? key : null,
  };
}

/** {field, frame, unit, notes}. `decoding`: of heights packed into colours. Throws a Sentence. */
export async function readRaster(file, decoding = null) {
  const { name } = file;
  const buffer = await file.arrayBuffer();
  const raster = /\.png$/i.test(name)
    ? await readPngHeights(name, buffer, decoding)
    : /\.hgt$/i.test(name)
      ? readHgt(name, buffer)
      : await readGeotiff(name, buffer, MOST_SAMPLES);
  const { cols, rows, frame, unit, notes, step = 1 } = raster;
  if (cols < 2 || rows < 2)
    throw new Sentence(`${name} is ${cols} x ${rows} samples: a mesh needs two of each at least.`);
  const field = new Field({
    name,
    cols,
    rows,
    samples: raster.samples,
    affine: frame.affine,
    unit,
    decoding: raster.decoding ?? null,
    step,
  });
  if (field.low > field.high) throw new Sentence(`${name} holds no height.`);
  return { field, frame, unit, notes: [...notes, ...warnOfUndeclared(field)] };
}
