// The raster of the package's tests, and assertions on errors.
import assert from 'node:assert/strict';
import { ScarpError } from 'scarp/full';
import { hills } from './rasters.mjs';

export const [width, height] = [97, 83];
export const z = hills(width, height);

const isOf = (code, sentence) => error =>
  (error instanceof ScarpError && error.code === code && sentence.test(error.message)) ||
  assert.fail(`${error.code}: ${error.message}`);

/// Asserts that `work` throws an error of the package.
export const refuses = (work, code, sentence) => assert.throws(work, isOf(code, sentence));

/// Asserts that `promise` is rejected with one.
export const rejects = (promise, code, sentence) => assert.rejects(promise, isOf(code, sentence));
