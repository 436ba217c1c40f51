// Checks callers' heights and copies them, in float32, into the module's memory.
import { ScarpError } from './error.js';
import { article, kindOf, show } from './options.js';

export const FARTHEST = '3.4028235e38';
/// Arrays are identified by class name, since arrays of another realm, such as a frame or jsdom, are no instances of
/// this realm's classes.
const EXACT = ['Float32Array', 'Int16Array', 'Uint16Array', 'Int8Array', 'Uint8Array', 'Uint8ClampedArray'];
const isFloat32 = values => kindOf(values) === 'Float32Array';
/// Max number of four-byte samples in a module's memory.
const MOST_SAMPLES = 2 ** 30;

export function refuse(message) {
  throw new ScarpError('usage', message);
}

export function checkSide(name, side, least = 2) {
  if (!Number.isInteger(side) || side < least || side > 2 ** 31 - 1)
    refuse(`${name} is ${show(side)}; it is a whole number, at least ${least}`);
}

export function checkLength(name, values, count, grid) {
  if (values.length === count) return;
  const isDetached = values.length === 0 && values.buffer?.detached !== false && values.buffer?.byteLength === 0;
  refuse(
    isDetached
      ? `the buffer of ${name} is detached: it was transferred, such as to a worker; keep a copy`
      : `${name} has ${values.length} values, and ${grid} has ${count}`,
  );
}

/// The remedy for arrays that hold no numbers.
const WAYS = {
  BigInt64Array: 'its BigInts are numbers in Float64Array.from(array, Number)',
  BigUint64Array: 'its BigInts are numbers in Float64Array.from(array, Number)',
  DataView: 'give a typed array over its buffer',
  ArrayBuffer: 'give a typed array over it',
  SharedArrayBuffer: 'give a typed array over it',
};

/// Returns a typed array unchanged, or the numbers of an array. `voidOf`: the value that replaces null, JSON's NaN.
export function checkArray(name, values, voidOf = undefined) {
  if (Array.isArray(values)) {
    const odd = values.findIndex(value => typeof value !== 'number' && !(value === null && voidOf !== undefined));
    const advice = voidOf === undefined ? '' : ': give NaN or null where there is none';
    if (odd >= 0) refuse(`index ${odd} of ${name} is ${show(values[odd])}, and no number${advice}`);
    return voidOf === undefined ? values : values.map(value => value ?? voidOf);
  }
  const kind = kindOf(values);
  if (!ArrayBuffer.isView(values) || WAYS[kind])
    refuse(
      `${name} ${name.endsWith('s') ? 'are' : 'is'} no array of numbers, but ` +
        (WAYS[kind] ? `${article(kind)}: ${WAYS[kind]}` : show(values)),
    );
  return values;
}

/// The nodata value in float32: NaN, meaning none, if no float32 value equals it.
function roundNodata(values, nodata = NaN) {
  const near = Math.fround(nodata);
  return near === nodata || (isFloat32(values) && near !== 0) ? near : NaN;
}

/// The values in float32, their nodata value, and the largest rounding of a height. Values to round are compared with
/// nodata as given, and become NaN.
function round(values, nodata) {
  if (EXACT.includes(kindOf(values)))
    return {
      samples: isFloat32(values) ? values : Float32Array.from(values),
      nodata: roundNodata(values, nodata),
      rounding: 0,
    };
  const samples = Float32Array.from(values);
  let rounding = 0;
  for (let k = 0; k < samples.length; ++k) {
    if (values[k] === nodata) {
      samples[k] = NaN;
      continue;
    }
    const moved = Math.abs(values[k] - samples[k]);
    if (moved === Infinity) checkFloat32('the heights', values, nodata);
    if (moved > rounding) rounding = moved;
  }
  return { samples, nodata: NaN, rounding };
}

/// Rejects numbers that become infinite in float32.
export function checkFloat32(name, values, nodata = undefined) {
  const far = values.findIndex(
    value => Number.isFinite(value) && !Number.isFinite(Math.fround(value)) && value !== nodata,
  );
  if (far >= 0)
    throw new ScarpError(
      'input',
      `index ${far} of ${name} is ${values[far]}, and float32 ends at ${FARTHEST}: scale or move ${name}`,
    );
}

/// Checks heights; does not copy float32. `z`: a typed array, or another array of numbers; `given`: the same, without
/// null.
export function checkHeights(z, width, height, nodata) {
  checkSide('width', width);
  checkSide('height', height);
  if (width * height > MOST_SAMPLES) {
    throw new ScarpError(
      'memory',
      `a raster of ${width} x ${height} has ${width * height} samples, and a module of WebAssembly has memory for ` +
        `fewer than ${MOST_SAMPLES}: take a smaller raster, or the program scarp`,
    );
  }
  const given = checkArray('the heights', z, NaN);
  checkLength('the array of heights', given, width * height, `a raster of ${width} x ${height}`);
  return { given, ...round(given, nodata) };
}

const voidNodata = ({ samples, nodata }) =>
  Number.isNaN(nodata) ? samples : samples.map(value => (value === nodata ? NaN : value));

/// The float32 samples of a raster, where NaN is nodata.
export const takeRaster = (z, width, height, nodata) => voidNodata(checkHeights(z, width, height, nodata));

/// The float32 samples of a window of it.
export function takeWindow(z, cols, rows, nodata) {
  const given = checkArray('the heights', z, NaN);
  checkLength('the array of heights', given, cols * rows, `a window of ${cols} x ${rows}`);
  return voidNodata(round(given, nodata));
}

/// A struct of doubles: numbers, and arrays of them.
export function putDoubles(blocks, ...numbers) {
  return blocks.put(Float64Array.from(numbers.flat()));
}

/// A value for each sample, in float32; undefined without values. Rounded so that no bound grows: tolerances towards 0,
/// weights away from 0.
export function takeBeside(name, values, width, height) {
  if (values === undefined) return undefined;
  checkLength(name, values, width * height, `a raster of ${width} x ${height}`);
  const given = checkArray(name, values);
  const rounded = Float32Array.from(given);
  if (EXACT.includes(kindOf(given))) return rounded;
  const bits = new Int32Array(rounded.buffer);
  const isWeight = name === 'mask';
  for (let k = 0; k < rounded.length; ++k) {
    const [near, exact] = [Math.abs(rounded[k]), Math.abs(given[k])];
    if (isWeight ? near < exact : near > exact) bits[k] += isWeight ? 1 : -1;
  }
  return rounded;
}

/// A Field of the door (door.h), with its samples in `blocks`.
export function putField(blocks, z, width, height, { nodata, transform, degrees = false } = {}) {
  const { samples, rounding, nodata: hole } = checkHeights(z, width, height, nodata);
  if (degrees && !transform) refuse('degrees: true needs a transform, which says where the samples lie');
  const place = transform === undefined ? 0 : degrees ? 2 : 1;
  const geotransform = Array.from(transform ?? [0, 1, 0, 0, 0, -1]);
  return {
    address: putDoubles(blocks, blocks.put(samples), width, height, hole, rounding, place, geotransform),
    rounding,
  };
}
