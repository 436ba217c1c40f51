// Times delatin on a raw raster, as speed_scarp times Scarp.
//
//   node speed_delatin.mjs RASTER COLS ROWS ERROR [MESH [once]]
//
// "once": no warm-up, so that the time of the process is that of reading, one triangulation and writing.

import { readFileSync, writeFileSync } from 'node:fs';
import Delatin from 'delatin';

const [path, cols, rows, error, mesh, once] = process.argv.slice(2);
if (error === undefined) {
  console.error('usage: node speed_delatin.mjs RASTER COLS ROWS ERROR [MESH [once]]');
  process.exit(2);
}
const bytes = readFileSync(path);
const width = Number(cols);
const height = Number(rows);
if (bytes.length !== 4 * width * height) {
  console.error(`${path} does not hold COLS times ROWS samples`);
  process.exit(2);
}
const samples = new Float32Array(bytes.buffer, bytes.byteOffset, width * height);

function refine(heights, w, h) {
  const tin = new Delatin(heights, w, h);
  tin.run(Number(error));
  return tin;
}

// The raster itself, or its upper left 512×512 samples where it has more than 2 million.
function warmUp() {
  if (samples.length <= 2e6) return refine(samples, width, height);
  const w = Math.min(width, 512);
  const h = Math.min(height, 512);
  const part = new Float32Array(w * h);
  for (let row = 0; row < h; row++) part.set(samples.subarray(row * width, row * width + w), row * w);
  return refine(part, w, h);
}

if (once === undefined) warmUp();
const cpu = process.cpuUsage();
const start = performance.now();
const tin = refine(samples, width, height);
const seconds = (performance.now() - start) / 1000;
const used = process.cpuUsage(cpu);

const { version } = JSON.parse(readFileSync(new URL('../node_modules/delatin/package.json', import.meta.url)));
console.log(
  JSON.stringify({
    version: `${version}, node ${process.versions.node}`,
    seconds,
    cpu_seconds: (used.user + used.system) / 1e6,
    vertices: tin.coords.length / 2,
    triangles: tin.triangles.length / 3,
  }),
);
if (mesh !== undefined) {
  const counts = Uint32Array.of(tin.coords.length / 2, tin.triangles.length / 3);
  writeFileSync(
    mesh,
    Buffer.concat(
      [counts, Uint32Array.from(tin.coords), Uint32Array.from(tin.triangles)].map(array => Buffer.from(array.buffer)),
    ),
  );
}
