// What callers give as heights: checked, in float32, and in the module's memory.
import { ScarpError } from './error.js';
import { show } from './options.js';

const EXACT = [Float32Array, Int16Array, Uint16Array, Int8Array, Uint8Array, Uint8ClampedArray];

export function refuse(message) {
  throw new ScarpError('usage', message);
}

export function checkSide(name, side, least = 2) {
  if (!Number.isInteger(side) || side < least || side > 2 ** 31 - 1) refuse(`${name} is ${show(side)}; it is a whole number, at least ${least}`);
}

export function checkLength(name, values, count, grid) {
  if (values.length === count) return;
  const isDetached = values.length === 0 && values.buffer?.detached !== false && values.buffer?.byteLength === 0;
  refuse(isDetached ? `the buffer of ${name} is detached: it was transferred, such as to a worker; keep a copy`
                    : `${name} has ${values.length} values, and ${grid} has ${count}`);
}

/// A typed array as it is; of an array the numbers. `voidOf`: what null stands for, as NaN is in JSON.
export function checkArray(name, values, voidOf = undefined) {
  if (Array.isArray(values)) {
    const odd = values.findIndex(value => typeof value !== 'number' && !(value === null && voidOf !== undefined));
    const advice = voidOf === undefined ? '' : ': give NaN or null where there is none';
    if (odd >= 0) refuse(`index ${odd} of ${name} is ${show(values[odd])}, and no number${advice}`);
    return voidOf === undefined ? values : values.map(value => value ?? voidOf);
  }
  if (!ArrayBuffer.isView(values) || values instanceof DataView || values instanceof BigInt64Array || values instanceof BigUint64Array)
    refuse(`${name} ${name.endsWith('s') ? 'are' : 'is'} no array of numbers, but ${show(values)}`);
  return values;
}

/// Float32 of the values, and the largest rounding among those that are heights.
function round(values, nodata) {
  if (EXACT.some(Kind => values instanceof Kind)) return { samples: values instanceof Float32Array ? values : Float32Array.from(values), rounding: 0 };
  const samples = Float32Array.from(values);
  let rounding = 0;
  for (let k = 0; k < samples.length; ++k) {
    const moved = Math.abs(values[k] - samples[k]);
    if (moved > rounding && moved < Infinity && values[k] !== nodata) rounding = moved;
  }
  return { samples, rounding };
}

/// Checks heights without a copy of those that are float32. `z`: a typed array, or another array of numbers; `given`: the same, without null.
export function checkHeights(z, width, height, nodata) {
  checkSide('width', width);
  checkSide('height', height);
  const given = checkArray('the heights', z, NaN);
  checkLength('the array of heights', given, width * height, `a raster of ${width} x ${height}`);
  return { given, ...round(given, nodata) };
}

/// A struct of doubles: numbers, and arrays of them.
export function putDoubles(blocks, ...numbers) {
  return blocks.put(Float64Array.from(numbers.flat()));
}

/// A value for each sample, in float32; undefined without any.
export function takeBeside(name, values, width, height) {
  if (values === undefined) return undefined;
  checkLength(name, values, width * height, `a raster of ${width} x ${height}`);
  return Float32Array.from(checkArray(name, values));
}

/// A Field of the door (door.h), whose samples `blocks` hold.
export function putField(blocks, z, width, height, { nodata, transform, degrees = false } = {}) {
  const { samples, rounding } = checkHeights(z, width, height, nodata);
  if (degrees && !transform) refuse('degrees: true needs a transform, which says where the samples lie');
  const place = transform === undefined ? 0 : degrees ? 2 : 1;
  const geotransform = Array.from(transform ?? [0, 1, 0, 0, 0, -1]);
  return { address: putDoubles(blocks, blocks.put(samples), width, height, nodata ?? NaN, rounding, place, geotransform), rounding };
}
