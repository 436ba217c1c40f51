// Makes the tiles of a square raster with martini: martini.mjs RASTER SIDE TILES STEP ERROR OUTPUT
//
// RASTER: SIDE × SIDE float32. TILES × TILES tiles of 65 × 65 samples each, every STEP-th of the raster. Writes of each
// tile, row by row, counts of vertices and triangles (uint32), vertices (uint16 column, row) and triangles (uint32).
// Prints the CPU milliseconds of meshing.
import { readFileSync, writeFileSync } from 'node:fs';
import Martini from '@mapbox/martini';

const [path, output] = [process.argv[2], process.argv[7]];
const [side, tiles, step, error] = process.argv.slice(3, 7).map(Number);
const bytes = readFileSync(path);
const raster = new Float32Array(bytes.buffer, bytes.byteOffset, side * side);
const martini = new Martini(65);
const windows = [];
for (let row = 0; row < tiles; ++row) {
  for (let column = 0; column < tiles; ++column) {
    windows.push(
      Float32Array.from(
        { length: 65 * 65 },
        (_, k) => raster[(row * 64 + Math.floor(k / 65)) * step * side + (column * 64 + (k % 65)) * step],
      ),
    );
  }
}
const mesh = window => martini.createTile(window).getMesh(error);
windows.forEach(mesh); // warm
const start = process.cpuUsage();
const meshes = windows.map(mesh);
const { user, system } = process.cpuUsage(start);
const parts = [];
for (const { vertices, triangles } of meshes) {
  parts.push(
    Uint32Array.of(vertices.length / 2, triangles.length / 3),
    Uint16Array.from(vertices),
    Uint32Array.from(triangles),
  );
}
writeFileSync(output, Buffer.concat(parts.map(part => Buffer.from(part.buffer, part.byteOffset, part.byteLength))));
console.log((user + system) / 1000);
