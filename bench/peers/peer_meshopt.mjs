// meshoptimizer's simplifier on the full grid of a raw raster; nothing is read or written inside the timed part.
//
//   node peer_meshopt.mjs RASTER COLS ROWS Z_SCALE MODE BORDER PREFIX TRIANGLES...
//
// For each number of TRIANGLES a mesh, PREFIX.TRIANGLES, and a line about it. Errors are measured in space: Z_SCALE is
// what heights are multiplied with before. Small factors flatten the surface, so that a distance in space comes near to
// one along z. MODE: simplify; attribute (all of it in the plane, the height an attribute of weight 1); update (the
// vertices that are left are moved). BORDER: free or locked.

import { readFileSync, writeFileSync } from 'node:fs';
import { MeshoptSimplifier } from 'meshoptimizer';

const [path, colsText, rowsText, zScaleText, mode, border, prefix, ...sizes] = process.argv.slice(2);
if (sizes.length === 0) {
  console.error('usage: node peer_meshopt.mjs RASTER COLS ROWS Z_SCALE MODE BORDER PREFIX TRIANGLES...');
  process.exit(2);
}
const cols = Number(colsText);
const rows = Number(rowsText);
const zScale = Number(zScaleText);
const bytes = readFileSync(path);
const heights = new Float32Array(bytes.buffer, bytes.byteOffset, cols * rows);
const scaled = heights.map(z => z * zScale);
const flags = border === 'locked' ? ['LockBorder'] : [];

function gridPositions() {
  const positions = new Float32Array(3 * cols * rows);
  for (let v = 0; v < cols * rows; v++) {
    positions.set([v % cols, rows - 1 - Math.floor(v / cols), mode === 'attribute' ? 0 : scaled[v]], 3 * v);
  }
  return positions;
}

/** Every cell two triangles, cut along alternating diagonals. */
function gridTriangles() {
  const triangles = [];
  for (let row = 0; row + 1 < rows; row++) {
    for (let col = 0; col + 1 < cols; col++) {
      const nw = row * cols + col;
      const ne = nw + 1;
      const sw = nw + cols;
      const se = sw + 1;
      triangles.push(...((row + col) % 2 === 0 ? [nw, sw, se, nw, se, ne] : [nw, sw, ne, ne, sw, se]));
    }
  }
  return Uint32Array.from(triangles);
}

/** The triangles that are left; `positions` are changed by update. */
function simplify(triangles, positions, wanted) {
  const target = 3 * wanted;
  const anyError = 1e30;
  if (mode === 'attribute') {
    return MeshoptSimplifier.simplifyWithAttributes(
      triangles,
      positions,
      3,
      scaled,
      1,
      [1],
      null,
      target,
      anyError,
      flags,
    )[0];
  }
  if (mode === 'update') {
    const none = new Float32Array(0);
    const [count] = MeshoptSimplifier.simplifyWithUpdate(
      triangles,
      positions,
      3,
      none,
      0,
      [],
      null,
      target,
      anyError,
      flags,
    );
    return triangles.subarray(0, count);
  }
  return MeshoptSimplifier.simplify(triangles, positions, 3, target, anyError, flags)[0];
}

/** Written as surface.h reads it: two counts, points, triangles. */
function writeSurface(file, left, positions) {
  const names = new Map();
  const points = [];
  const triangles = left.map(v => {
    if (!names.has(v)) {
      names.set(v, names.size);
      const z = mode === 'update' ? positions[3 * v + 2] / zScale : heights[v];
      points.push(positions[3 * v], positions[3 * v + 1], z);
    }
    return names.get(v);
  });
  const counts = Uint32Array.of(names.size, triangles.length / 3);
  writeFileSync(
    file,
    Buffer.concat(
      [counts, Float64Array.from(points), triangles].map(array =>
        Buffer.from(array.buffer, array.byteOffset, array.byteLength),
      ),
    ),
  );
}

await MeshoptSimplifier.ready;
const { version } = JSON.parse(readFileSync(new URL('../node_modules/meshoptimizer/package.json', import.meta.url)));
const grid = gridTriangles();
const places = gridPositions();
for (const size of sizes) {
  const triangles = grid.slice();
  const positions = places.slice();
  const cpu = process.cpuUsage();
  const left = simplify(triangles, positions, Number(size));
  const used = process.cpuUsage(cpu);
  writeSurface(`${prefix}.${size}`, left, positions);
  console.log(
    JSON.stringify({
      version: `${version}, node ${process.versions.node}`,
      size: Number(size),
      cpu_seconds: (used.user + used.system) / 1e6,
    }),
  );
}
