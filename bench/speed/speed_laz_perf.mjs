// Times laz-perf on a LAZ file, as speed_las times Scarp, and counts what was read in the same way.
//
//   node speed_laz_perf.mjs FILE [ROUNDS]

import { readFileSync } from 'node:fs';
import { createLazPerf } from 'laz-perf';

const [path, rounds = '5'] = process.argv.slice(2);
if (path === undefined) {
  console.error('usage: node speed_laz_perf.mjs FILE [ROUNDS]');
  process.exit(2);
}
const file = readFileSync(path);
const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
const isExtended = (view.getUint8(104) & 63) >= 6;
const recordBytes = view.getUint16(105, true);
const wide = view.getUint8(25) >= 4 ? Number(view.getBigUint64(247, true)) : 0;
const count = wide || view.getUint32(107, true);

const engine = await createLazPerf();
const begin = engine._malloc(file.byteLength);
const record = engine._malloc(recordBytes);
engine.HEAPU8.set(file, begin);

const cpuSeconds = () => {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1e6;
};
let seconds = Infinity;
for (let round = 0; round < Number(rounds); round++) {
  const reader = new engine.LASZip();
  const start = cpuSeconds();
  reader.open(begin, file.byteLength);
  for (let k = 0; k < count; k++) reader.getPoint(record);
  seconds = Math.min(seconds, cpuSeconds() - start);
  reader.delete();
}

let hash = 2166136261;
let ground = 0;
const reader = new engine.LASZip();
reader.open(begin, file.byteLength);
for (let k = 0; k < count; k++) {
  reader.getPoint(record);
  const bytes = engine.HEAPU8.subarray(record, record + recordBytes);
  for (let b = 0; b < 12; b++) hash = Math.imul(hash ^ bytes[b], 16777619) >>> 0;
  if ((isExtended ? bytes[16] : bytes[15] & 31) === 2) ground++;
}
console.log(JSON.stringify({ points: count, hash, ground, bytes: file.byteLength, cpu_seconds: seconds }));
