// Calls that the package refuses in Node, each with a message.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import test from 'node:test';
import {
  Refiner,
  Tiler,
  createPool,
  decodeTile,
  encodeGlb,
  measure,
  ready,
  simplify,
  simplifyPointsSync,
  simplifySync,
} from 'scarp/full';
import { height, refuses, width, z } from './checks.mjs';

await ready();

const flat = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 2] };
/// Calls with the error code and message that each throws.
const cases = [
  [() => simplifySync(z, width, height + 1, { maxError: 1 }), 'usage', /8051 values, and a raster of 97 x 84 has 8148/],
  [() => simplifySync(z, 1, z.length, { maxError: 1 }), 'usage', /width is 1/],
  [() => simplifySync(z, 97.5, height, { maxError: 1 }), 'usage', /width is 97.5/],
  [() => simplifySync(null, width, height, { maxError: 1 }), 'usage', /no array/],
  [() => simplifySync('heights', width, height, { maxError: 1 }), 'usage', /no array/],
  [() => simplifySync(new DataView(z.buffer), width, height, { maxError: 1 }), 'usage', /no array/],
  [() => simplifySync(new Float32Array(9).fill(NaN), 3, 3, { maxError: 1 }), 'input', /./],
  [() => simplifySync(z, width, height, {}), 'usage', /goal/],
  [() => simplifySync(z, width, height, { maxError: -1 }), 'usage', /maxError is -1/],
  [() => simplifySync(z, width, height, { maxError: NaN }), 'usage', /maxError is NaN/],
  [() => simplifySync(z, width, height, { maxTriangles: 1.5 }), 'usage', /maxTriangles is 1.5/],
  [() => simplifySync(z, width, height, { maxTriangles: 1 }), 'usage', /./],
  [() => simplifySync(z, width, height, { maxEror: 1 }), 'usage', /maxEror is unknown/],
  [() => simplifySync(z, width, height, { maxError: 1, effort: 'best' }), 'usage', /best.*normal/],
  [() => simplifySync(z, width, height, { maxError: 1, mask: [1] }), 'usage', /mask has 1 values/],
  [() => simplifySync(z, width, height, { maxError: 1, transform: [1, 2] }), 'usage', /transform/],
  [() => simplifySync(z, width, height, { maxError: 1, transform: [0, 0, 0, 0, 0, 0] }), 'usage', /line/],
  [() => simplifySync(z, width, height, { maxError: 1, degrees: true }), 'usage', /transform/],
  [
    () => simplifySync(z, width, height, { maxError: 1, transfer: true }),
    'usage',
    /transfer is for workers: leave it out, or take simplify\(\)/,
  ],
  [
    () => simplifySync(z, width, height, { maxError: 1, lockBorder: true, outlineTolerance: 1 }),
    'usage',
    /^lockBorder cannot be combined with outlineTol/,
  ],
  [
    () => simplifySync(z, width, height, { maxError: 1, lockBorder: true, maxTriangles: 99, tolerance: z }),
    'usage',
    /^lockBorder .* maxTriangles beside tol/,
  ],
  [
    () => simplifySync(z, width, height, { maxError: 1, effort: 'fast', vertices: 'free' }),
    'usage',
    /^effort: 'fast' cannot .* with vertices: 'free'/,
  ],
  ...[1e16, 1e20].map(far => [
    () => simplifySync(z, width, height, { maxError: 1, transform: [far, 1, 0, far, 0, -1] }),
    'promise',
    /move the raster nearer to 0/,
  ]),
  [
    () =>
      simplifySync(
        Float64Array.from(z, value => 6e6 + value / 7),
        width,
        height,
        { maxError: 0.1 },
      ),
    'promise',
    /ask for 0.25 or more, or subtract a base/,
  ],
  ...[simplifySync, (...given) => new Refiner(...given.slice(0, 3))].map(work => [
    () => work(new Int8Array(4), 33000, 33000, { maxError: 1 }),
    'memory',
    /33000 x 33000 has 1089000000 samples.*smaller raster/,
  ]),
  [() => measure(z, width, height, {}), 'usage', /positions/],
  [() => measure(z, width, height, { positions: [0, 0, 0], indices: [0, 1, 2] }), 'input', /./],
  [() => new Refiner(z, 5, 5), 'usage', /25/],
  [() => encodeGlb({}), 'usage', /positions/],
  [() => new Tiler(z, width, height, { bounds: [0, 0, 0, 0] }), 'usage', /bounds/],
  [() => createPool({ size: 0 }), 'usage', /size is 0/],
  [() => new Tiler(z, width, height, { bounds: [0, 0, 1, 1] }).layerJson(null), 'usage', /options are null/],
  [() => new Tiler(z, width, height, 'bounds'), 'usage', /options are a string/],
  [() => simplifySync(z, width, height, { maxError: 1n }), 'usage', /maxError is the BigInt 1; it is a number/],
  [() => simplifySync(z, width, height, { maxError: Symbol('x') }), 'usage', /maxError is Symbol/],
  [() => simplifySync(z, width, height, { maxError: '' }), 'usage', /maxError is ''/],
  [() => simplifySync(z, width, height, { maxTriangles: 0 }), 'usage', /maxTriangles is 0/],
  [
    () => simplifySync(z, width, height, { maxError: 1, minShape: 'x' }),
    'usage',
    /minShape is 'x'; it is a number, 0 to 0.5/,
  ],
  [() => simplifySync(z, width, height, { maxError: 1, mask: () => 1 }), 'usage', /mask is a function/],
  [() => simplifySync(z, width, height, { maxError: 1, signal: 'x' }), 'usage', /signal is 'x'; it is an AbortSignal/],
  ...['abc', '', []].map(nodata => [
    () => simplifySync(z, width, height, { maxError: 1, nodata }),
    'usage',
    /nodata is .*; it is a number/,
  ]),
  [() => simplifySync(z, width, height, {}), 'usage', /set maxError, maxTriangles, maxVertices/],
  [
    () => simplifySync(z, width, height, { maxError: 1, outlineTolerance: Infinity }),
    'usage',
    /outlineTolerance is Infinity; .*and finite/,
  ],
  [() => simplifyPointsSync([0, 0, 1e39, 1, 0, 0, 0, 1, 0], { maxError: 1 }), 'promise', /float32: take doubles: true/],
  ...[simplifySync, (...given) => new Refiner(...given.slice(0, 3)).run({ maxError: given[3].maxError })].map(work => [
    () => work(z, width, height, { maxError: Infinity }),
    'usage',
    /maxError is Infinity; it is a number, at least 0 and finite/,
  ]),
  [
    () => simplifySync(z, width, height, { maxError: 1, transform: [0, 1, 0, 0, NaN, 1] }),
    'usage',
    /index 4 of transform is NaN, and no finite/,
  ],
  [
    () => new Tiler(z, width, height, { bounds: [0, 0, 1, 1] }).layerJson({ tiles: ['a', 5] }),
    'usage',
    /index 1 of tiles is 5, and no text/,
  ],
  [
    () => new Tiler(z, width, height, { bounds: [0, 0, 1, 1], effort: 'max' }),
    'usage',
    /effort is 'max'; it is one of fast, normal, high/,
  ],
  ...[
    [{ maxError: 0 }, /maxError is 0; it is a number, above 0 and finite/],
    [{ maxZoom: 24 }, /maxZoom is 24; it is a whole number, 0 to 23/],
    [{ cells: 100 }, /cells is 100; it is one of 16, 32, 64, 128, 256/],
  ].map(([given, sentence]) => [
    () => new Tiler(z, width, height, { bounds: [0, 0, 1, 1], ...given }),
    'usage',
    sentence,
  ]),
  [
    () => simplifyPointsSync([0, 0, 1, 9, 0, 2, 0, 9, 3], { maxError: 1, effort: 'fast', minShape: 0.1 }),
    'usage',
    /minShape needs more than fast effort/,
  ],
  ...[BigInt64Array, BigUint64Array].map(Kind => [
    () => simplifySync(new Kind(9), 3, 3, { maxError: 1 }),
    'usage',
    /heights .*Array: its BigInts are/,
  ]),
  [
    () => encodeGlb({ ...flat, indices: new BigUint64Array(3) }),
    'usage',
    /indices are no array of numbers, but a BigUint64Array/,
  ],
  [
    () => simplifySync(new DataView(z.buffer), width, height, { maxError: 1 }),
    'usage',
    /a DataView: give a typed array over its buffer/,
  ],
  [() => simplifySync(z.buffer, width, height, { maxError: 1 }), 'usage', /an ArrayBuffer: give a typed array over it/],
  [() => simplifySync(new Map(), width, height, { maxError: 1 }), 'usage', /but a Map$/],
  [() => decodeTile(null, 2, 1), 'usage', /the pixels are no array of numbers, but null/],
  ...[() => simplifySync(z, width, height, null), () => simplifyPointsSync([0, 0, 1], null)].map(work => [
    work,
    'usage',
    /options are null.*give a goal/,
  ]),
  [() => new Tiler(z, width, height, null), 'usage', /null.*give { bounds/],
  [
    () => encodeGlb({ ...flat, positions: [0, 0, 0, 1e39, 0, 0, 0, 1, 0] }),
    'input',
    /index 3 of the mesh's positions is 1e\+39, and float32 ends/,
  ],
  [
    () => encodeGlb({ ...flat, origin: [1e300, 0, 0] }),
    'input',
    /index 0 of the mesh's origin is 1e\+300, and float32 ends/,
  ],
  [
    () =>
      encodeGlb({ ...flat, positions: [0, 3e38, 0, 1, 3e38, 0, 0, 3e38, 1], origin: [0, 3e38, 0] }, { compress: true }),
    'input',
    /node is -6e\+38/,
  ],
  [() => new Refiner(z, width, height, { noData: -9999 }), 'usage', /noData is unknown: did you mean nodata\?/],
  [() => new Refiner(z, width, height).run({ maxErr: 50 }), 'usage', /maxErr is unknown: did you mean maxError\?/],
  [() => new Refiner(z, width, height).run(null), 'usage', /options are null/],
  ...[NaN, -1, 'x'].map(maxVertices => [
    () => new Refiner(z, width, height).run({ maxVertices }),
    'usage',
    /maxVertices is .*whole number/,
  ]),
  [() => createPool({ sise: 1 }), 'usage', /sise is unknown: did you mean size\?/],
  [() => createPool({ worker: 'x' }), 'usage', /worker is 'x'; it is a function/],
  [() => encodeGlb(flat, { compres: true }), 'usage', /did you mean compress/],
  [
    () => encodeGlb({ ...flat, positions: [0, 0, NaN, 1, 0, 0, 0, 1, 0] }),
    'input',
    /index 2 of the mesh's positions is NaN/,
  ],
  [
    () => encodeGlb({ ...flat, indices: [0, 1, 3] }),
    'input',
    /index 2 of the mesh's indices is 3, and a mesh of 3 vertices/,
  ],
  [() => encodeGlb({ ...flat, indices: [0, 1] }), 'usage', /indices has 2 numbers/],
  [() => encodeGlb({ ...flat, normals: [0, 0, 1] }), 'usage', /normals has 3 values/],
  ...[
    [-2, -2],
    [1.6, 2.5],
  ].map(sides => [() => decodeTile(new Uint8ClampedArray(16), ...sides), 'usage', /width is/]),
  [() => new Tiler(z, width, height, {}), 'usage', /bounds is not given/],
  [() => new Tiler(z, width, height, { bounds: [0, 80, 10, 100] }), 'usage', /latitudes go from -90 to 90/],
  [() => new Tiler(z, width, height, { bounds: [-400, 0, 400, 10] }), 'usage', /800 degrees of longitude/],
  [() => new Tiler(z, width, height, { bounds: [900, 0, 901, 1] }), 'input', /in bounds, or take crs/],
  ...[
    () => simplifySync(z, width, height, null),
    () => new Refiner(z, width, height, null),
    () => createPool(null),
    () => encodeGlb({}, null),
  ].map(work => [work, 'usage', /options are null/]),
];

test('bad input gets a sentence that names it', () => {
  assert.ok(encodeGlb(flat).length > 0);
  new Tiler(z, width, height, { bounds: [-180 - 1, -90 - 1, 180 + 1, 90 + 1] }).free(); // pixels around the poles
  for (const [work, code, sentence] of cases) refuses(work, code, sentence);
});

test('the options that cannot be combined are those of the README', () => {
  const given = {
    mask: { mask: z.map(() => 1) },
    tolerance: { tolerance: z.map(() => 9) },
    outlineTolerance: { outlineTolerance: 1 },
    minShape: { minShape: 0.1 },
    maxTriangles: { maxTriangles: 900 },
    maxVertices: { maxVertices: 900 },
  };
  for (const name of ['lockBorder', 'lattice', 'doubles', 'normals', 'uvs']) given[name] = { [name]: true };
  for (const [name, values] of Object.entries({
    order: ['greedy', 'dominant'],
    effort: ['fast', 'normal', 'high'],
    vertices: ['samples', 'free'],
    objective: ['rms'],
  }))
    for (const value of values) given[`${name}: '${value}'`] = { [name]: value };
  const refused = [];
  const told = [];
  const sort = pair => pair.sort().join(' and ');
  const names = Object.keys(given);
  for (const [k, one] of names.entries()) {
    for (const other of names.slice(k + 1)) {
      try {
        simplifySync(z, width, height, {
          maxError: 9,
          ...(/rms/.test(one + other) && { maxTriangles: 900 }),
          ...given[one],
          ...given[other],
        });
      } catch ({ message }) {
        if (/cannot be combined/.test(message)) refused.push(sort([one, other]));
      }
    }
  }
  for (const [, one, others] of fs
    .readFileSync('node_modules/scarp/README.md', 'utf8')
    .matchAll(/^\| `([^`]*)` \| (`[^|]*`) \|$/gm))
    for (const [, other] of others.matchAll(/`([^`]*)`/g)) told.push(sort([one, other]));
  assert.deepEqual(told.sort(), refused.sort());
});
