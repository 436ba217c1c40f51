// GeoTIFF: the heights of its first band, and where they lie.
import { fromArrayBuffer } from 'geotiff';
import { WGS84, grid_frame, local_frame, thin_frame } from './frame.js';
import { Sentence } from './sentence.js';

const METRES_OF_UNIT = { 9001: 1, 9002: 0.3048, 9003: 1200 / 3937 };
const RADIANS_OF_UNIT = { 9101: 1, 9102: Math.PI / 180, 9105: Math.PI / 200 };
const CLARKE_1866 = { semi_major: 6378206.4, inverse_flattening: 294.9786982139006 }, GRS80 = { semi_major: 6378137, inverse_flattening: 298.257222101 };
const ELLIPSOIDS = { 4267: CLARKE_1866, 4269: GRS80, 4258: GRS80, 4283: GRS80, 4617: GRS80, 7844: GRS80 };
const UNITS = { metre: 'm', meter: 'm', metres: 'm', meters: 'm', foot: 'ft', feet: 'ft' };
const METRES_OF_HEIGHT = { ft: 0.3048, 'US survey foot': 1200 / 3937 };
const COLOURS = 2, PALETTE = 3;

/** From the centre of a sample to the CRS; null without a place. */
function samples_affine({ fileDirectory: { ModelTransformation: m, ModelTiepoint: tie, ModelPixelScale: scale } }, is_point) {
  let gt = null;
  if (m) gt = [m[3], m[0], m[1], m[7], m[4], m[5]];
  else if (scale?.[0] && scale[1] && tie?.length >= 6) gt = [tie[3] - tie[0] * scale[0], scale[0], 0, tie[4] + tie[1] * Math.abs(scale[1]), 0, -Math.abs(scale[1])];
  if (!gt?.every(Number.isFinite)) return null;
  return is_point ? gt : [gt[0] + (gt[1] + gt[2]) / 2, gt[1], gt[2], gt[3] + (gt[4] + gt[5]) / 2, gt[4], gt[5]];
}

function ellipsoid_of({ GeogSemiMajorAxisGeoKey: semi_major, GeogSemiMinorAxisGeoKey: semi_minor, GeogInvFlatteningGeoKey: given, GeographicTypeGeoKey: code }) {
  if (!(semi_major > 0)) return ELLIPSOIDS[code] ?? WGS84;
  return { semi_major, inverse_flattening: given ?? (semi_minor > 0 && semi_minor !== semi_major ? semi_major / (semi_major - semi_minor) : 0) };
}

function frame_of(image, unit) {
  const [cols, rows] = [image.getWidth(), image.getHeight()];
  const keys = image.getGeoKeys() ?? {}, samples = samples_affine(image, keys.GTRasterTypeGeoKey === 2), model = keys.GTModelTypeGeoKey;
  if (!samples) return grid_frame(rows);
  const height = METRES_OF_HEIGHT[unit] ?? 1, of_code = code => code > 0 && code < 32767 ? `EPSG:${code}` : null;
  if (model === 2) {
    const radians = RADIANS_OF_UNIT[keys.GeogAngularUnitsGeoKey ?? 9102] ?? RADIANS_OF_UNIT[9102];
    return local_frame(samples, cols, rows, { radians, ellipsoid: ellipsoid_of(keys), height, crs: of_code(keys.GeographicTypeGeoKey) });
  }
  if (model !== 1) return local_frame(samples, cols, rows, { height });
  const metres = METRES_OF_UNIT[keys.ProjLinearUnitsGeoKey ?? 9001] ?? keys.ProjLinearUnitSizeGeoKey ?? 1;
  return local_frame(samples, cols, rows, { metres, keeps_unit: Math.abs(metres - 0.3048) < 1e-5, height, crs: of_code(keys.ProjectedCSTypeGeoKey) });
}

/** Every `step`th sample of every `step`th row, by bands of rows: never all of a raster that is too large. */
async function read_samples(image, cols, rows, step) {
  const window = (top, bottom) => image.readRasters({ samples: [0], window: [0, top, image.getWidth(), bottom] });
  if (step === 1) return (await window(0, rows))[0];
  const out = new Float64Array(cols * rows), high = step * Math.max(1, Math.ceil(image.getTileHeight() / step));
  for (let top = 0; top < rows * step; top += high) {
    const bottom = Math.min(image.getHeight(), top + high), [band] = await window(top, bottom);
    for (let row = top / step; row < rows && row * step < bottom; ++row)
      for (let col = 0; col < cols; ++col) out[row * cols + col] = band[(row * step - top) * image.getWidth() + col * step];
  }
  return out;
}

export async function read_geotiff(name, buffer, most_samples) {
  let image;
  try {
    image = await (await fromArrayBuffer(buffer)).getImage();
  } catch {
    throw new Sentence(`${name} is no TIFF file, or its beginning is damaged.`);
  }
  const [full_cols, full_rows] = [image.getWidth(), image.getHeight()], step = Math.max(1, Math.ceil(Math.sqrt(full_cols * full_rows / most_samples)));
  const cols = Math.floor(full_cols / step), rows = Math.floor(full_rows / step), { Compression, PhotometricInterpretation: colours } = image.fileDirectory;
  let values;
  try {
    values = await read_samples(image, cols, rows, step);
  } catch (error) {
    if (/compression method/i.test(error?.message)) throw new Sentence(`${name} is packed in a way that this page does not know (compression ${Compression}): gdal_translate unpacks it.`);
    throw new Sentence(`${name} is damaged or cut off: its samples cannot be read.`);
  }
  const told = image.getGDALMetadata(0) ?? {}, scale = Number(told.SCALE ?? 1), offset = Number(told.OFFSET ?? 0), nodata = image.getGDALNoData(), rounded = Math.fround(nodata);
  const is_missing = values instanceof Float32Array || step > 1 ? z => z === nodata || Math.fround(z) === rounded && nodata !== null : z => z === nodata;
  const samples = Float32Array.from(values, z => is_missing(z) || !Number.isFinite(z) ? NaN : z * scale + offset), unit = UNITS[told.UNITTYPE] ?? told.UNITTYPE ?? '';
  const notes = [];
  if (step > 1) notes.push(`${name} has ${full_cols} x ${full_rows} samples, too many for a page: one of ${step} x ${step} was read, and errors are against these.`);
  if (colours === COLOURS || colours === PALETTE) notes.push(`This is a colour picture, and its ${colours === COLOURS ? 'red is' : 'colour numbers are'} taken as height.`);
  return { cols, rows, samples, frame: thin_frame(frame_of(image, unit), step), unit, notes, step };
}
