// Compares with the program's tiles, except the order of triangles, and its layer.json: tiles.mjs CRS NAME WIDTH HEIGHT
// WEST SOUTH EAST NORTH FOLDER
//
// Prints how many were compared, and for how many the error is known.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import zlib from 'node:zlib';
import { Tiler, ready } from 'scarp/full';

/// The header and triangles of quantized-mesh, with normals of their corners, as text.
function canonical(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = view.getUint32(88, true);
  const list = (at, length) => Array.from({ length }, (_, k) => view.getUint16(at + 2 * k, true));
  const [u, v, h] = [0, 1, 2].map(k => {
    let value = 0;
    return list(92 + 2 * count * k, count).map(code => (value += (code >> 1) ^ -(code & 1)));
  });
  let at = 92 + 6 * count;
  let highest = 0;
  const triangles = view.getUint32(at, true);
  const corners = list(at + 4, 3 * triangles).map(code => {
    if (code === 0) ++highest;
    return highest - code - (code === 0 ? 1 : 0);
  });
  at += 4 + 6 * triangles;
  const edges = [0, 1, 2, 3].map(() => {
    const length = view.getUint32(at, true);
    const edge = list(at + 4, length);
    at += 4 + 2 * length;
    return edge;
  });
  const normals = bytes.subarray(at + 5, at + 5 + 2 * count);
  const vertex = k => [u[k], v[k], h[k], normals[2 * k], normals[2 * k + 1]].join();
  const turned = Array.from({ length: triangles }, (_, t) => {
    const three = [0, 1, 2].map(k => vertex(corners[3 * t + k]));
    const first = three.indexOf([...three].sort()[0]);
    return [0, 1, 2].map(k => three[(first + k) % 3]).join(' ');
  });
  return [
    Buffer.from(bytes.subarray(0, 92)).toString('hex'),
    ...turned.sort(),
    ...edges.map(edge => edge.map(vertex).sort().join(' ')),
  ].join('\n');
}

const [crs, name, ...words] = process.argv.slice(2);
const [width, height, west, south, east, north] = words.map(Number);
const folder = words.at(-1);
await ready();
const z = new Float32Array(new Uint8Array(fs.readFileSync(`${name}.f32`)).buffer);
const tiler = new Tiler(z, width, height, { bounds: [west, south, east, north], crs });
let tiles = 0;
let proven = 0;
for (let level = 0; level <= tiler.maxZoom; ++level) {
  const listed = tiler
    .list(level)
    .map(pair => pair.join('/'))
    .sort();
  const kept = fs
    .readdirSync(`${folder}/${level}`)
    .flatMap(x => fs.readdirSync(`${folder}/${level}/${x}`).map(file => `${x}/${file.split('.')[0]}`))
    .sort();
  if (listed.join() !== kept.join()) throw new Error(`level ${level}: ${listed} here, and ${kept} there`);
  for (const place of listed) {
    const tile = tiler.tile(level, ...place.split('/').map(Number));
    const theirs = zlib.gunzipSync(fs.readFileSync(`${folder}/${level}/${place}.terrain`));
    if (canonical(theirs) !== canonical(tile.bytes)) throw new Error(`tile ${level}/${place} is not the program's`);
    ++tiles;
    if (tile.nodeError >= 0) ++proven;
  }
}
if (fs.existsSync(`${folder}/${tiler.maxZoom + 1}`)) throw new Error('the program has more levels');
const [mine, theirs] = [
  tiler.layerJson({ name: `${name}.tif` }),
  JSON.parse(fs.readFileSync(`${folder}/layer.json`, 'utf8')),
];
for (const key of Object.keys(mine).filter(key => !['version', 'tiles', 'bounds'].includes(key)))
  assert.deepEqual(mine[key], theirs[key], key);
// The program's cover of a raster not in degrees is slightly larger.
const slack = crs === 'mercator' ? (mine.bounds[2] - mine.bounds[0]) / width : 0;
mine.bounds.forEach((degree, k) =>
  assert.ok(Math.abs(degree - theirs.bounds[k]) <= slack, `bounds: ${mine.bounds} here, and ${theirs.bounds} there`),
);
tiler.free();
console.log(tiles, proven);
