// What callers give as heights: checked, in float32, and in the module's memory.
import { ScarpError } from './module.js';

const EXACT = [Float32Array, Int16Array, Uint16Array, Int8Array, Uint8Array, Uint8ClampedArray];

function refuse(message) {
  throw new ScarpError('usage', message);
}

export function checkOptions(options) {
  if (options === null || typeof options !== 'object') refuse(`the options are ${options === null ? 'null' : `a ${typeof options}`}, and no object: leave them out, or give { name: value }`);
}

function checkSide(name, side) {
  if (!Number.isInteger(side) || side < 2 || side > 2 ** 31 - 1) refuse(`${name} is ${side}; it is a whole number, at least 2`);
}

function checkLength(name, values, count, grid) {
  if (values.length === count) return;
  const isDetached = values.length === 0 && values.buffer?.detached !== false && values.buffer?.byteLength === 0;
  refuse(isDetached ? `the buffer of ${name} is detached: it was transferred, such as to a worker; keep a copy`
                    : `${name} has ${values.length} values, and ${grid} has ${count}`);
}

/// Float32 of the values, and the largest rounding among those that are heights.
function round(values) {
  if (EXACT.some(Kind => values instanceof Kind)) return { samples: values instanceof Float32Array ? values : Float32Array.from(values), rounding: 0 };
  const samples = Float32Array.from(values);
  let rounding = 0;
  for (let k = 0; k < samples.length; ++k) {
    const moved = Math.abs(values[k] - samples[k]);
    if (moved > rounding && moved < Infinity) rounding = moved;
  }
  return { samples, rounding };
}

/// Checks heights without a copy of those that are float32. `z`: a typed array, or another array of numbers.
export function checkHeights(z, width, height) {
  checkSide('width', width);
  checkSide('height', height);
  if (!ArrayBuffer.isView(z) && !Array.isArray(z)) refuse('the heights are no array of numbers');
  if (z instanceof DataView || z instanceof BigInt64Array || z instanceof BigUint64Array) refuse('the heights are no array of numbers');
  checkLength('the array of heights', z, width * height, `a raster of ${width} x ${height}`);
  return round(z);
}

/// A struct of doubles: numbers, and arrays of them.
export function putDoubles(blocks, ...numbers) {
  return blocks.put(Float64Array.from(numbers.flat()));
}

export function checkNumbers(name, values, count) {
  if (!values || typeof values.length !== 'number') refuse(`${name} is no array of numbers`);
  if (values.length !== count || !Array.from(values).every(Number.isFinite)) refuse(`${name} is not ${count} numbers`);
  return Array.from(values);
}

/// A value for each sample: its address; 0 without any.
export function putBeside(blocks, name, values, width, height) {
  if (values == null) return 0;
  checkLength(name, values, width * height, `a raster of ${width} x ${height}`);
  return blocks.put(Float32Array.from(values));
}

/// A Field of the door (door.h), whose samples `blocks` hold.
export function putField(blocks, z, width, height, { nodata, transform, degrees = false } = {}) {
  const { samples, rounding } = checkHeights(z, width, height);
  if (degrees && !transform) refuse('degrees: true needs a transform, which says where the samples lie');
  const place = transform == null ? 0 : degrees ? 2 : 1;
  const geotransform = place ? checkNumbers('transform', transform, 6) : [0, 1, 0, 0, 0, -1];
  return putDoubles(blocks, blocks.put(samples), width, height, nodata ?? NaN, rounding, place, geotransform);
}
