// GeoTIFF: the heights of its first band, and their position.
import { fromArrayBuffer } from 'geotiff';
import { WGS84, gridFrame, localFrame, thinFrame } from './frame.js';
import { Sentence } from './sentence.js';
import { TiffSamples, damaged } from './tiff_samples.js';

const METRES_OF_UNIT = { 9001: 1, 9002: 0.3048, 9003: 1200 / 3937 };
const RADIANS_OF_UNIT = { 9101: 1, 9102: Math.PI / 180, 9105: Math.PI / 200 };
const CLARKE_1866 = { semiMajor: 6378206.4, inverseFlattening: 294.9786982139006 };
const GRS80 = { semiMajor: 6378137, inverseFlattening: 298.257222101 };
const ELLIPSOIDS = { 4267: CLARKE_1866, 4269: GRS80, 4258: GRS80, 4283: GRS80, 4617: GRS80, 7844: GRS80 };
const UNITS = { metre: 'm', meter: 'm', metres: 'm', meters: 'm', foot: 'ft', feet: 'ft' };
const METRES_OF_HEIGHT = { m: 1, ft: 0.3048, 'US survey foot': 1200 / 3937 };
const COLOURS = 2;
const PALETTE = 3;

/** From the centre of a sample to the CRS; null without a position. */
function samplesAffine(
  { fileDirectory: { ModelTransformation: m, ModelTiepoint: tie, ModelPixelScale: scale } },
  isPoint,
) {
  let gt = null;
  if (m) gt = [m[3], m[0], m[1], m[7], m[4], m[5]];
  else if (scale?.[0] && scale[1] && tie?.length >= 6)
    gt = [tie[3] - tie[0] * scale[0], scale[0], 0, tie[4] + tie[1] * Math.abs(scale[1]), 0, -Math.abs(scale[1])];
  if (!gt?.every(Number.isFinite)) return null;
  return isPoint ? gt : [gt[0] + (gt[1] + gt[2]) / 2, gt[1], gt[2], gt[3] + (gt[4] + gt[5]) / 2, gt[4], gt[5]];
}

function ellipsoidOf({
  GeogSemiMajorAxisGeoKey: semiMajor,
  GeogSemiMinorAxisGeoKey: semiMinor,
  GeogInvFlatteningGeoKey: given,
  GeographicTypeGeoKey: code,
}) {
  if (!(semiMajor > 0)) return ELLIPSOIDS[code] ?? WGS84;
  return {
    semiMajor,
    inverseFlattening: given ?? (semiMinor > 0 && semiMinor !== semiMajor ? semiMajor / (semiMajor - semiMinor) : 0),
  };
}

/** Heights are multiplied by `scale` to metres if x and y become metres (src/io/raster/height_unit.cpp). */
function frameOf(image, unit) {
  const frame = bareFrameOf(image, unit);
  const scale = frame.knowsMetres ? frame.metres[2] : 1;
  if (scale === 1) return { ...frame, scale };
  return { ...frame, scale, metres: [1, 1, 1], extras: { ...frame.extras, z_scale: scale, unit: 'm' } };
}

function bareFrameOf(image, unit) {
  const [cols, rows] = [image.getWidth(), image.getHeight()];
  const keys = image.getGeoKeys() ?? {};
  const samples = samplesAffine(image, keys.GTRasterTypeGeoKey === 2);
  const model = keys.GTModelTypeGeoKey;
  if (!samples) return gridFrame(rows);
  const height = METRES_OF_HEIGHT[unit] ?? 1;
  const ofCode = code => (code > 0 && code < 32767 ? `EPSG:${code}` : null);
  if (model === 2) {
    const radians = RADIANS_OF_UNIT[keys.GeogAngularUnitsGeoKey ?? 9102] ?? RADIANS_OF_UNIT[9102];
    return localFrame(samples, cols, rows, {
      radians,
      ellipsoid: ellipsoidOf(keys),
      height,
      crs: ofCode(keys.GeographicTypeGeoKey),
    });
  }
  if (model !== 1) return localFrame(samples, cols, rows, { height });
  const metres = METRES_OF_UNIT[keys.ProjLinearUnitsGeoKey ?? 9001] ?? keys.ProjLinearUnitSizeGeoKey ?? 1;
  return localFrame(samples, cols, rows, {
    metres,
    height: unit ? height : metres,
    crs: ofCode(keys.ProjectedCSTypeGeoKey),
  });
}

const LARGEST = 3.4028234663852886e38;
const NEAR_LARGEST = 3.4e38; // "-3.40282e+38" and the like, with any number of digits

/** Parses a number as C does. */
function numberOf(text) {
  const infinity = /^\s*([+-]?)inf/i.exec(text);
  return infinity ? Number(`${infinity[1]}Infinity`) : Number.parseFloat(text);
}

const ENTITIES = { lt: '<', gt: '>', quot: '"', apos: "'", amp: '&' };
/** The content of GDAL's own tag: about a band, counted from 0, by role; about the file, by name. */
function metadataOf({ GDAL_METADATA = '' }, band) {
  const text = String(GDAL_METADATA);
  const ofFile = band === undefined;
  const found = {};
  for (const [, words, value] of text.matchAll(/<Item\s+([^>]*)>([^<]*)<\/Item>/g)) {
    const { name, sample, role } = Object.fromEntries(
      [...words.matchAll(/(\w+)="([^"]*)"/g)].map(([, key, word]) => [key, word]),
    );
    if (ofFile ? sample === undefined : Number(sample) === band)
      found[ofFile ? name : role] = value.replace(/&(\w+);/g, (whole, key) => ENTITIES[key] ?? whole);
  }
  return found;
}

/** A test for nodata values, by the program's rule (src/io/gdal/read_samples.cpp). */
function missingTest({ format, bits }, nodata) {
  if (nodata === null || Number.isNaN(nodata)) return () => false;
  if (format !== 3) return z => z === nodata;
  const value = bits <= 32 ? Math.fround(Math.max(-LARGEST, Math.min(LARGEST, nodata))) : nodata;
  const near = bits <= 32 ? Math.fround(NEAR_LARGEST) : NEAR_LARGEST;
  const least = value >= near ? near : NaN;
  const most = value <= -near ? -near : NaN;
  return z => z === value || z >= least || z <= most;
}

/** The alpha band that marks nodata; null: none. GDAL ignores it if a nodata value is declared, except in one place, so
 * the program uses both. */
function findAlpha({ fileDirectory: d }, { bands, format, bits }, hasNodata) {
  const { ExtraSamples: extra = [] } = d;
  const isAlpha = k => {
    const told = metadataOf(d, k).colorinterp;
    return told ? told === 'Alpha' : [1, 2].includes(extra[k - bands + extra.length]);
  };
  if (hasNodata) return Array.from({ length: bands - 1 }, (_, k) => k + 1).find(isAlpha) ?? null;
  return (bands === 2 || bands === 4) && isAlpha(bands - 1) && format === 1 && (bits === 8 || bits === 16)
    ? bands - 1
    : null;
}

/** The file's image that is the mask of the first one; null: none. */
async function findMask(tiff) {
  const seen = new Set([0]);
  for (let k = 1, before = await tiff.requestIFD(0); !seen.has(before.nextIFDByteOffset); ++k) {
    seen.add(before.nextIFDByteOffset);
    before = await tiff.requestIFD(k);
    if ((before.fileDirectory.NewSubfileType & 5) === 4) return tiff.getImage(k);
  }
  return null;
}

/** Heights of every `step`th sample of every `step`th row, in double if float32 does not hold them. */
async function readHeights(name, tiff, image, buffer, step, told, factor) {
  const source = new TiffSamples(name, image, buffer);
  const {
    fileDirectory: { GDAL_NODATA },
  } = image;
  const { NODATA_VALUES } = metadataOf(image.fileDirectory);
  const nodata = GDAL_NODATA
    ? numberOf(GDAL_NODATA)
    : source.bands === 1 && NODATA_VALUES
      ? numberOf(NODATA_VALUES)
      : null;
  if (source.bands > 1 && NODATA_VALUES)
    throw new Sentence(
      `${name} tells by all bands at once where there is nothing (NODATA_VALUES): this page reads one band; ` +
        `gdal_translate -b 1 makes a file of it.`,
    );
  let scale = numberOf(told.scale ?? '1');
  let offset = numberOf(told.offset ?? '0');
  let beyond = null;
  if (scale === 0 || !Number.isFinite(scale) || !Number.isFinite(offset)) [scale, offset] = [1, 0];
  [scale, offset] = [scale * factor, offset * factor];
  const isScaled = scale !== 1 || offset !== 0;
  const isMissing = missingTest(source, nodata);
  const [low, high] = source.range;
  const values = new Float64Array(Math.floor(source.cols / step) * Math.floor(source.rows / step));
  await source.each(0, step, Math.max(low, Math.min(high, nodata || 0)), (at, raw) => {
    const value = isMissing(raw) || !Number.isFinite(raw) ? NaN : isScaled ? raw * scale + offset : raw;
    if (Math.abs(value) > LARGEST) beyond ??= value;
    values[at] = value;
  });
  if (beyond !== null) throw new Sentence(`${name} has a height of ${beyond}, and heights end at 3.4028235e38.`);
  const mask = await findMask(tiff);
  const alpha = mask ? 0 : findAlpha(image, source, nodata !== null);
  const shows = mask ? new TiffSamples(name, mask, buffer) : source;
  if (shows.cols !== source.cols || shows.rows !== source.rows) throw damaged(name);
  if (alpha !== null)
    await shows.each(alpha, step, 0, (at, shown) => {
      if (!(shown >= 0.5)) values[at] = NaN;
    });
  return values;
}

export async function readGeotiff(name, buffer, mostSamples) {
  let tiff, image;
  try {
    tiff = await fromArrayBuffer(buffer);
    image = await tiff.getImage();
  } catch {
    throw new Sentence(`${name} is no TIFF file, or its beginning is damaged.`);
  }
  const [fullCols, fullRows] = [image.getWidth(), image.getHeight()];
  const step = Math.max(1, Math.ceil(Math.sqrt((fullCols * fullRows) / mostSamples)));
  const cols = Math.floor(fullCols / step);
  const rows = Math.floor(fullRows / step);
  const { PhotometricInterpretation: colours } = image.fileDirectory;
  const told = metadataOf(image.fileDirectory, 0);
  const said = UNITS[told.unittype] ?? told.unittype ?? '';
  const notes = [];
  const { scale, ...frame } = frameOf(image, said);
  const unit = scale === 1 ? said : 'm';
  const samples = await readHeights(name, tiff, image, buffer, step, told, scale).catch(error => {
    throw error instanceof Sentence ? error : damaged(name);
  });
  if (step > 1)
    notes.push(
      `${name} has ${fullCols} x ${fullRows} samples, too many for a page: one of ${step} x ${step} was read, ` +
        `and errors are against these.`,
    );
  if (colours === COLOURS || colours === PALETTE)
    notes.push(
      `This is a colour picture, and its ${colours === COLOURS ? 'red is' : 'colour numbers are'} taken as height.`,
    );
  return { cols, rows, samples, frame: thinFrame(frame, step), unit, notes, step };
}
