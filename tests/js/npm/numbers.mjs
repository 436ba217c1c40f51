// Numbers in messages, printed like in C: numbers.mjs CASES.json, a list of [value, is float32, style, precision,
// printed].
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { printNumber } from './node_modules/scarp/number.js';

const cases = JSON.parse(fs.readFileSync(process.argv[2]));
for (const [value, ...how] of cases) assert.equal(printNumber(value, ...how.slice(0, 3)), how[3], `${value} ${how}`);
assert.deepEqual(
  [NaN, Infinity, -Infinity].map(value => printNumber(value, false, 'g', -1)),
  ['nan', 'inf', '-inf'],
);
console.log(cases.length);
