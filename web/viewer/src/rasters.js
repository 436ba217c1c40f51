// Rasters dropped on the page: GeoTIFF, .hgt, and PNG tiles of the web. The mesh's frame is metres around the centre.
import { fromArrayBuffer } from 'geotiff';
import { Field } from './field.js';
import { Sentence } from './sentence.js';

const MOST_SAMPLES = 2 ** 24;
const METRES_OF_UNIT = { 9001: 1, 9002: 0.3048, 9003: 1200 / 3937 };

/** Metres of a degree of longitude and latitude, on the ellipsoid WGS 84. */
function metres_of_degree(latitude) {
  const phi = latitude * Math.PI / 180, e2 = 0.00669437999014, w = Math.sqrt(1 - e2 * Math.sin(phi) ** 2), a = 6378137 * Math.PI / 180;
  return [a * Math.cos(phi) / w, a * (1 - e2) / w ** 3];
}

function make_field(name, cols, rows, samples, [width, height] = [1, 1]) {
  if (cols < 2 || rows < 2) throw new Sentence(`${name} is ${cols} x ${rows} samples: a mesh needs two of each at least.`);
  const field = new Field({ name, cols, rows, samples, affine: [-(cols - 1) / 2 * width, width, 0, (rows - 1) / 2 * height, 0, -height] });
  if (field.low > field.high) throw new Sentence(`${name} holds no height.`);
  return field;
}

async function read_geotiff(name, buffer) {
  let tiff, image;
  try {
    tiff = await fromArrayBuffer(buffer);
    image = await tiff.getImage();
  } catch (error) {
    throw new Sentence(`${name} cannot be read as GeoTIFF: ${error?.message ?? 'it is damaged'}.`);
  }
  const [full_cols, full_rows] = [image.getWidth(), image.getHeight()], step = Math.ceil(Math.sqrt(full_cols * full_rows / MOST_SAMPLES));
  const cols = Math.floor(full_cols / step), rows = Math.floor(full_rows / step);
  let values;
  try {
    [values] = step > 1 ? await tiff.readRasters({ samples: [0], width: cols, height: rows }) : await image.readRasters({ samples: [0] });
  } catch (error) {
    throw new Sentence(`${name} is damaged, or packed in a way that this page does not know${error?.message ? `: ${error.message}` : ''}.`);
  }
  const nodata = image.getGDALNoData(), samples = Float32Array.from(values, z => z === nodata || !Number.isFinite(z) ? NaN : z);
  const keys = image.getGeoKeys() ?? {}, notes = step > 1 ? [`${name} has ${full_cols} x ${full_rows} samples, too many for a page: every ${step}th was read.`] : [];
  let cell, knows_metres = true;
  try {
    cell = image.getResolution().slice(0, 2).map(size => Math.abs(size) * step);
    const [, south, , north] = image.getBoundingBox(), is_degrees = keys.GTModelTypeGeoKey === 2;
    const metres = is_degrees ? metres_of_degree((south + north) / 2) : [1, 1].map(() => METRES_OF_UNIT[keys.ProjLinearUnitsGeoKey ?? 9001] ?? 1);
    cell = cell.map((size, k) => size * metres[k]);
  } catch {
    cell = [1, 1];
    knows_metres = false;
  }
  return { field: make_field(name, cols, rows, samples, cell), knows_metres, notes };
}

function read_hgt(name, buffer) {
  const side = Math.round(Math.sqrt(buffer.byteLength / 2)), place = /^([NS])(\d\d)([EW])(\d{3})/i.exec(name);
  if (side < 2 || side * side * 2 !== buffer.byteLength) throw new Sentence(`${name} is no square of 16-bit heights, as a .hgt file is.`);
  const view = new DataView(buffer), samples = new Float32Array(side * side);
  for (let k = 0; k < samples.length; ++k) {
    const z = view.getInt16(2 * k);
    samples[k] = z === -32768 ? NaN : z;
  }
  const latitude = place ? Number(place[2]) * (/s/i.test(place[1]) ? -1 : 1) + 0.5 : 0;
  return { field: make_field(name, side, side, samples, metres_of_degree(latitude).map(metres => metres / (side - 1))), knows_metres: Boolean(place), notes: [] };
}

const ENCODINGS = { terrarium: (r, g, b) => r * 256 + g + b / 256 - 32768, mapbox: (r, g, b) => (r * 65536 + g * 256 + b) / 10 - 10000 };

/** A grey PNG is heights; of coloured ones, that encoding whose neighbours differ less. */
async function read_png(name, file) {
  let bitmap;
  try {
    bitmap = await createImageBitmap(file, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  } catch {
    throw new Sentence(`${name} cannot be read as an image.`);
  }
  const { width, height } = bitmap;
  if (width * height > MOST_SAMPLES) throw new Sentence(`${name} has ${width} x ${height} pixels, too many for a page.`);
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  const decode = of => Float32Array.from({ length: width * height }, (_, k) => data[4 * k + 3] === 0 ? NaN : of(data[4 * k], data[4 * k + 1], data[4 * k + 2]));
  const roughness = z => z.reduce((sum, value, k) => k && value === value && z[k - 1] === z[k - 1] ? sum + Math.abs(value - z[k - 1]) : sum, 0);
  const is_grey = Array.from({ length: width * height }, (_, k) => 4 * k).every(k => data[k] === data[k + 1] && data[k] === data[k + 2]);
  if (is_grey) return { field: make_field(name, width, height, decode(r => r)), knows_metres: false, notes: ['Grey levels are taken for heights.'] };
  const [best] = Object.keys(ENCODINGS).map(key => ({ key, samples: decode(ENCODINGS[key]) })).sort((a, b) => roughness(a.samples) - roughness(b.samples));
  return { field: make_field(name, width, height, best.samples), knows_metres: false, notes: [`Colours are taken for heights as of ${best.key} tiles.`] };
}

export const RASTERS = /\.(tiff?|hgt|png)$/i;

/** {field, knows_metres, notes}. Throws a Sentence. */
export async function read_raster(file) {
  if (/\.png$/i.test(file.name)) return read_png(file.name, file);
  const buffer = await file.arrayBuffer();
  return /\.hgt$/i.test(file.name) ? read_hgt(file.name, buffer) : read_geotiff(file.name, buffer);
}
