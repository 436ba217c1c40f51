// The promises of the package, in Node.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import test from 'node:test';
import vm from 'node:vm';
import { Worker } from 'node:worker_threads';
import * as scarp from 'scarp/full';
import { ROUNDING, judgeMesh } from './judge.mjs';
import { hills } from './rasters.mjs';

// The memory of the module of this thread: it grows and never shrinks.
const { instantiate } = WebAssembly;
let memory;
WebAssembly.instantiate = async (...given) => {
  const instance = await instantiate(...given);
  ({ memory } = instance.exports);
  return instance;
};

const {
  ScarpError,
  Refiner,
  Tiler,
  createPool,
  decodeTile,
  encodeGlb,
  measure,
  ready,
  simplify,
  simplifyPoints,
  simplifyPointsSync,
  simplifySync,
} = scarp;
const [width, height] = [97, 83];
const z = hills(width, height);
const refuses = (work, code, sentence) =>
  assert.throws(
    work,
    error =>
      (error instanceof ScarpError && error.code === code && sentence.test(error.message)) ||
      assert.fail(`${error.code}: ${error.message}`),
  );
const rejects = (promise, code, sentence) =>
  assert.rejects(
    promise,
    error =>
      (error instanceof ScarpError && error.code === code && sentence.test(error.message)) ||
      assert.fail(`${error.code}: ${error.message}`),
  );

test('before ready() a sentence says so', () =>
  refuses(() => simplifySync(z, width, height, { maxError: 1 }), 'usage', /await ready/));

test('ready() may be called twice, and the version is the library’s', async () => {
  await Promise.all([ready(), ready()]);
  await ready(undefined, { warm: true });
  await assert.rejects(ready(undefined, { hot: true }), { code: 'usage', message: /hot/ });
  assert.equal(scarp.version(), JSON.parse(fs.readFileSync('node_modules/scarp/package.json')).version);
});

test('what a module lacks is told with the entry that was loaded, and what ready() does not take', () => {
  const told = (entry, later, work) =>
    execFileSync(process.execPath, [
      '--input-type=module',
      '-e',
      `import { ready } from '${entry}'; await ready();
    const { measure, Refiner, Tiler } = await import('${later}');
    try { ${work} } catch (error) { console.log(error.code, error.message); }`,
    ]).toString();
  assert.match(
    told(
      'scarp/lite',
      'scarp',
      'measure([1, 2, 3, 4], 2, 2, { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 2] })',
    ),
    /^usage the module of scarp\/lite was loaded first.*import scarp, or scarp\/full/,
  );
  assert.match(
    told('scarp', 'scarp/full', 'new Tiler([1, 2, 3, 4], 2, 2, { bounds: [0, 0, 1, 1] })'),
    /^usage the module of scarp was loaded first.*import scarp\/full/,
  );
  assert.match(
    told('scarp', 'scarp/lite', "await (await import('./node_modules/scarp/module.js?again')).start(5)"),
    /^usage ready\(\) was given 5; it takes/,
  );
});

test('no sample is farther away than the error that was asked for', () => {
  for (const effort of ['fast', 'normal', 'high']) {
    for (const maxError of [0, 0.5, 4, 30]) {
      const mesh = simplifySync(z, width, height, { maxError, effort });
      const { max, uncovered } = judgeMesh(z, width, height, mesh);
      assert.equal(uncovered, 0);
      assert.ok(max <= maxError + ROUNDING * 1000, `${effort}: ${max} of ${maxError}`);
      assert.ok(Math.abs(max - mesh.maxError) <= 1e-9, `${effort}: judged ${max}, told ${mesh.maxError}`);
    }
  }
});

test('more effort takes fewer triangles', () => {
  const [fast, normal, high] = ['fast', 'normal', 'high'].map(
    effort => simplifySync(z, width, height, { maxError: 4, effort }).triangleCount,
  );
  assert.ok(high < normal && normal < fast, `${fast} ${normal} ${high}`);
});

test('a budget is kept', () => {
  const mesh = simplifySync(z, width, height, { maxTriangles: 500 });
  assert.ok(mesh.triangleCount <= 500 && mesh.triangleCount > 400, `${mesh.triangleCount}`);
  assert.equal(mesh.report.stop, 'maxTriangles');
  const judged = judgeMesh(z, width, height, mesh);
  assert.ok(Math.abs(judged.max - mesh.maxError) <= 1e-9);
});

test('measure() finds what simplifySync() told, and a vertex that was moved', () => {
  const mesh = simplifySync(z, width, height, { maxError: 4 });
  const report = measure(z, width, height, mesh);
  assert.equal(report.maxError, mesh.maxError);
  assert.equal(report.rmse, mesh.rmse);
  assert.equal(report.isSound, true);
  assert.equal(report.samples, width * height);
  mesh.positions[2] += 1000;
  assert.ok(measure(z, width, height, mesh).maxError > 900);
});

test('what a mesh tells of its error is true of its positions, whatever its cell', () => {
  let kept = 0;
  for (const cell of [0.1, 1 / 3, 27.7, 1 / 3600]) {
    const transform = [4e5, cell, 0, 5e6, 0, -cell];
    const place = { transform };
    for (const maxError of [0, 1]) {
      for (const lattice of [false, true]) {
        let mesh;
        try {
          mesh = simplifySync(z, width, height, { maxError, lattice, effort: 'high', transform });
        } catch ({ code }) {
          assert.ok(code === 'promise' && !lattice, code);
          continue;
        }
        assert.equal(measure(z, width, height, mesh, place).maxError, mesh.maxError);
        assert.ok(mesh.maxError <= maxError && mesh.positions.constructor === (lattice ? Float64Array : Float32Array));
        ++kept;
        if (lattice)
          assert.match(
            new TextDecoder().decode(encodeGlb(mesh, { compress: true })),
            /"componentType":5123,"count":\d+,"type":"VEC3"/,
          );
      }
    }
    const refiner = new Refiner(z, width, height, place);
    refiner.run({ maxError: 1 });
    const mesh = refiner.mesh();
    assert.ok(measure(z, width, height, mesh, place).maxError === mesh.maxError && mesh.maxError <= 1);
    refiner.free();
  }
  assert.ok(kept >= 12, `${kept}`);
});

test('texture coordinates beyond 0 and 1 are kept', () => {
  const quad = { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]), indices: [0, 1, 2, 2, 1, 3] };
  const kindOf = uvs => {
    const file = encodeGlb({ ...quad, uvs: new Float32Array(uvs) }, { compress: true });
    const { accessors, meshes } = JSON.parse(
      new TextDecoder().decode(file.subarray(20, 20 + new DataView(file.buffer).getUint32(12, true))),
    );
    return accessors[meshes[0].primitives[0].attributes.TEXCOORD_0];
  };
  assert.deepEqual(
    [
      [0, 0, 2.5, 0, 0, 1, 1, 1],
      [0, 0, 1, 0, -0.5, 1, 1, 1],
      [0, 0, 1, 0, 0, 1, 1, 1],
    ].map(uvs => kindOf(uvs).componentType),
    [5126, 5126, 5123],
  );
  assert.equal(kindOf([0, 0, 2.5, 0, 0, 1, 1, 1]).normalized, undefined);
});

test('arrays of another realm are arrays', async () => {
  const marked = z.map((value, k) => (k === 500 ? -9999.1 : value));
  const options = { maxError: 4, nodata: -9999.1 };
  const mesh = simplifySync(marked, width, height, options);
  const [Floats, Corners, View] = ['Float32Array', mesh.indices.constructor.name, 'DataView'].map(name =>
    vm.runInNewContext(name),
  );
  const theirs = new Floats(marked);
  const foreign = { ...mesh, positions: new Floats(mesh.positions), indices: new Corners(mesh.indices) };
  assert.ok(!(theirs instanceof Float32Array) && mesh.report.samples === z.length - 1);
  for (const made of [simplifySync(theirs, width, height, options), await simplify(theirs, width, height, options)])
    assert.deepEqual([made.report, made.positions], [mesh.report, mesh.positions]);
  assert.equal(measure(theirs, width, height, foreign, { nodata: -9999.1 }).maxError, mesh.maxError);
  for (const compress of [false, true])
    assert.deepEqual(encodeGlb(foreign, { compress }), encodeGlb(mesh, { compress }));
  refuses(
    () => simplifySync(new View(new ArrayBuffer(8)), 2, 2, { maxError: 4 }),
    'usage',
    /a DataView: give a typed array/,
  );
});

test('arrays of every kind give the same mesh', () => {
  const whole = Int16Array.from(z);
  const counts = [
    whole,
    Float32Array.from(whole),
    Float64Array.from(whole),
    Array.from(whole),
    Uint16Array.from(whole),
  ].map(heights => [...simplifySync(heights, width, height, { maxError: 4 }).positions].join());
  assert.equal(new Set(counts).size, 1);
});

test('the promise is about float64 values as they are given', () => {
  const exact = Float64Array.from(z, value => value + 1e5 + 1 / 3);
  const mesh = simplifySync(exact, width, height, { maxError: 0.05 });
  assert.ok(judgeMesh(exact, width, height, mesh).max <= 0.05 + ROUNDING * 1e5);
});

test('an error counts what float32 took from the heights', () => {
  const large = Int32Array.from(z, value => 2e9 + Math.round(value));
  const mesh = simplifySync(large, width, height, { maxTriangles: 500 });
  const report = measure(large, width, height, mesh);
  const refiner = new Refiner(large, width, height);
  refiner.run({ maxError: 150 });
  for (const one of [mesh, refiner.mesh()])
    assert.ok(judgeMesh(large, width, height, one).max <= one.maxError, `${one.maxError}`);
  assert.ok(refiner.maxError <= 150 && report.sampleRounding > 1 && report.maxError === mesh.maxError);
  refuses(() => refiner.run({ maxError: 1 }), 'promise', /maxError of 1 cannot be kept/);
  refuses(() => simplifySync(large, width, height, { maxError: 1 }), 'promise', /cannot be kept/);
});

test('null is no height, and what is no number is refused', () => {
  const plain = JSON.parse(JSON.stringify(Array.from(z, (value, k) => (k === 500 ? NaN : value))));
  assert.equal(plain[500], null);
  assert.equal(simplifySync(plain, width, height, { maxError: 4 }).report.samples, z.length - 1);
  for (const odd of [undefined, '12', 5n])
    refuses(
      () =>
        simplifySync(
          plain.map((value, k) => (k === 7 ? odd : value)),
          width,
          height,
          { maxError: 4 },
        ),
      'usage',
      /index 7 of the heights/,
    );
  refuses(
    () => simplifySync(new Array(z.length), width, height, { maxError: 4 }),
    'usage',
    /index 0 of the heights is undefined/,
  );
  refuses(() => simplifyPointsSync([0, 0, null], { maxError: 1 }), 'usage', /index 2 of the points is null/);
});

test('a mesh that lies elsewhere covers nothing', () => {
  const { isSound, uncovered, samples } = measure(z, width, height, {
    ...simplifySync(z, width, height, { maxError: 4 }),
    origin: [1e6, 0, 0],
  });
  assert.deepEqual([isSound, uncovered, samples], [true, width * height, 0]);
});

test('NaN and nodata are no heights, and are not covered', () => {
  const holes = Float32Array.from(z);
  const marked = Float32Array.from(z);
  for (let k = 30; k < 50; ++k) {
    holes.fill(NaN, k * width + 20, k * width + 40);
    marked.fill(-9999, k * width + 20, k * width + 40);
  }
  const [a, b] = [
    simplifySync(holes, width, height, { maxError: 4 }),
    simplifySync(marked, width, height, { maxError: 4, nodata: -9999 }),
  ];
  assert.deepEqual(a.positions, b.positions);
  assert.ok(judgeMesh(holes, width, height, a).max <= 4 + ROUNDING * 1000);
  assert.equal(measure(holes, width, height, a).samples, width * height - 400);
});

test('nodata is compared with the heights as they are given', async () => {
  const near = Float64Array.from(z, (_, k) => (k === 500 ? 100.0000001 : k === 700 ? 100 : 200 + (k % 7)));
  const count = async (heights, nodata) => {
    const options = { maxError: 4, nodata };
    const mesh = simplifySync(heights, width, height, options);
    for (const other of [
      await simplify(heights, width, height, options),
      { ...mesh, report: measure(heights, width, height, mesh, { nodata }) },
    ])
      assert.deepEqual([other.report.samples, other.positions], [mesh.report.samples, mesh.positions]);
    return z.length - mesh.report.samples;
  };
  assert.equal(await count(near, 100), 1);
  assert.equal(await count(near, 100.0000001), 1);
  const whole = near.map(Math.floor);
  for (const heights of [whole, Array.from(whole), Float32Array.from(whole), Int16Array.from(whole)]) {
    assert.equal(await count(heights, 100), 2);
    assert.equal(
      await count(
        heights.map(value => value - 100),
        5e-324,
      ),
      0,
    );
  }
  for (const heights of [whole, Int16Array.from(whole)]) assert.equal(await count(heights, 100.0000001), 0);
  assert.equal(
    await count(
      Float32Array.from(z, (_, k) => (k % 7 ? k % 5 : 0.1)),
      0.1,
    ),
    Math.ceil(z.length / 7),
  );
});

test('a height beyond float32 is refused, and as nodata it is a hole', async () => {
  for (const far of [1e39, -1e300]) {
    const heights = Float64Array.from(z, (value, k) => (k === 40 ? far : value));
    for (const given of [heights, Array.from(heights)]) {
      const sentence = /^index 40 of the heights is -?1e\+\d+, and float32 ends at 3.4028235e38: scale/;
      refuses(() => simplifySync(given, width, height, { maxError: 4 }), 'input', sentence);
      refuses(() => new Refiner(given, width, height), 'input', sentence);
      await rejects(simplify(given, width, height, { maxError: 4 }), 'input', sentence);
      assert.equal(simplifySync(given, width, height, { maxError: 4, nodata: far }).report.samples, z.length - 1);
    }
  }
  assert.equal(
    simplifySync(
      Float64Array.from(z, (value, k) => (k === 40 ? Infinity : value)),
      width,
      height,
      { maxError: 4 },
    ).report.samples,
    z.length - 1,
  );
});

test('weights and tolerances bind each sample', () => {
  const tolerance = Float32Array.from(z, (_, k) => (k % width < 50 ? 0.5 : 20));
  const mesh = simplifySync(z, width, height, { tolerance });
  assert.ok(
    judgeMesh(
      z.map((value, k) => (k % width < 50 ? value : NaN)),
      width,
      height,
      mesh,
    ).max <=
      0.5 + ROUNDING * 1000,
  );
  const mask = Float32Array.from(z, (_, k) => (k % width < 50 ? 1 : 0.1));
  const weighted = simplifySync(z, width, height, { maxError: 1, mask });
  assert.ok(
    judgeMesh(
      z.map((value, k) => (k % width < 50 ? value : NaN)),
      width,
      height,
      weighted,
    ).max <=
      1 + ROUNDING * 1000,
  );
  assert.ok(weighted.triangleCount < simplifySync(z, width, height, { maxError: 1 }).triangleCount);
  // Their nearest float32 are a tolerance above and a weight below, which the height would just keep.
  const low = new Float32Array(25);
  const near = Math.fround(0.1);
  const exact = Float64Array.from(low);
  low[12] = near;
  assert.ok(near > 0.1);
  assert.ok(simplifySync(low, 5, 5, { tolerance: exact.fill(0.1) }).maxError <= 0.1);
  const weight = Array.from({ length: 1000 }, (_, k) => (k + 1) / 997).find(
    one => Math.fround(1 / one) * one > 1 && Math.fround(1 / one) * Math.fround(one) <= 1,
  );
  low[12] = 1 / weight;
  assert.ok(simplifySync(low, 5, 5, { maxError: 1, mask: exact.fill(weight) }).maxError * weight <= 1);
});

test('a transform places the mesh, and degrees become metres', () => {
  const placed = simplifySync(z, width, height, { maxError: 4, transform: [500000, 30, 0, 4000000, 0, -30] });
  const [x, y] = [0, 1].map(axis => {
    const values = Array.from(placed.positions)
      .filter((_, k) => k % 3 === axis)
      .map(value => value + placed.origin[axis]);
    return [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))];
  });
  assert.deepEqual(x, [500015, 500015 + 30 * (width - 1)]);
  assert.deepEqual(y, [4000000 - 15 - 30 * (height - 1), 4000000 - 15]);
  const local = simplifySync(z, width, height, {
    maxError: 4,
    transform: [8, 1 / 1200, 0, 46, 0, -1 / 1200],
    degrees: true,
  });
  const widest =
    Math.max(...local.positions.filter((_, k) => k % 3 === 0)) -
    Math.min(...local.positions.filter((_, k) => k % 3 === 0));
  assert.ok(
    Math.abs(widest / (((width - 1) / 1200) * 111320 * Math.cos((46 * Math.PI) / 180)) - 1) < 0.01,
    `${widest}`,
  );
});

test('normals point up, and texture coordinates run over the raster', () => {
  const { normals, uvs, vertexCount } = simplifySync(z, width, height, { maxError: 4, normals: true, uvs: true });
  assert.equal(normals.length, 3 * vertexCount);
  assert.ok(normals.every((value, k) => k % 3 < 2 || value > 0));
  assert.ok(uvs.every(value => value >= 0 && value <= 1));
});

test('progress is told, and false cancels', () => {
  const large = hills(200, 150);
  const told = [];
  simplifySync(large, 200, 150, {
    maxError: 1,
    effort: 'high',
    onProgress: progress => {
      told.push(progress);
    },
  });
  assert.ok(told.length > 0 && told.every(({ pass, fraction }) => pass.length > 0 && fraction >= 0 && fraction <= 1));
  refuses(
    () => simplifySync(large, 200, 150, { maxError: 0.1, effort: 'high', onProgress: () => false }),
    'cancelled',
    /cancel/,
  );
  assert.throws(
    () =>
      simplifySync(large, 200, 150, {
        maxError: 0.1,
        effort: 'high',
        onProgress: () => {
          throw new Error('mine');
        },
      }),
    /mine/,
  );
  assert.ok(simplifySync(large, 200, 150, { maxError: 30 }).triangleCount > 0);
});

test('a Refiner inserts the worst sample first, as the greedy order does', () => {
  const refiner = new Refiner(z, width, height);
  const first = refiner.maxError;
  assert.equal(refiner.insertWorst(), true);
  const inserted = refiner.run({ maxError: 4 });
  assert.ok(inserted > 10 && refiner.maxError <= 4 && first > 4);
  const mesh = refiner.mesh();
  assert.equal(mesh.vertexCount, refiner.vertexCount);
  assert.equal(mesh.triangleCount, refiner.triangleCount);
  assert.ok(Math.abs(judgeMesh(z, width, height, mesh).max - refiner.maxError) <= 1e-9);
  assert.equal(
    mesh.triangleCount,
    simplifySync(z, width, height, { maxError: 4, order: 'greedy', effort: 'fast' }).triangleCount,
  );
  refiner.run({ maxVertices: mesh.vertexCount + 5 });
  assert.equal(refiner.vertexCount, mesh.vertexCount + 5);
  refiner.run();
  assert.equal(refiner.maxError, 0);
  assert.equal(refiner.insertWorst(), false);
  refiner.free();
  refiner.free();
  refuses(() => refiner.maxError, 'usage', /freed/);
});

test('scattered points are kept within the error', () => {
  const points = [];
  for (let k = 0; k < z.length; k += 3)
    points.push((k % width) + (k % 7) / 10, Math.floor(k / width) + (k % 5) / 10, z[k]);
  const mesh = simplifyPointsSync(Float64Array.from(points), { maxError: 6 });
  assert.ok(mesh.maxError <= 6 && mesh.report.uncovered === 0 && mesh.triangleCount < points.length / 3);
  refuses(() => simplifyPointsSync([0, 0, 0, 1, 1, 1], { maxError: 1 }), 'input', /./);
  refuses(() => simplifyPointsSync([0, 0], { maxError: 1 }), 'usage', /x, y, z/);
});

test('pixels of tiles become heights', () => {
  const pixel = (...bytes) => Uint8ClampedArray.from(bytes);
  assert.deepEqual([...decodeTile(pixel(128, 10, 128, 255), 1, 1)], [10.5]);
  assert.ok(Math.abs(decodeTile(pixel(1, 134, 160, 255), 1, 1, 'mapbox')[0] - 0) < 1e-3);
  assert.deepEqual(
    [...decodeTile(pixel(7, 2, 1, 255), 1, 1, { rScaler: 1, gScaler: 10, bScaler: 100, offset: -5 })],
    [122],
  );
  assert.ok(Number.isNaN(decodeTile(pixel(7, 2, 1, 0), 1, 1)[0]));
  refuses(() => decodeTile(pixel(1, 2, 3, 4), 2, 1), 'usage', /8 bytes/);
  refuses(
    () => decodeTile(pixel(1, 2, 3, 4), 1, 1, { rScaler: 4e38, gScaler: 0, bScaler: 0, offset: 0 }),
    'input',
    /makes 4e\+38 of pixel 0 \(1, 2, 3\), and float32 ends at/,
  );
  refuses(() => decodeTile(pixel(1, 2, 3, 4), 1, 1, 'mapzen'), 'usage', /terrarium/);
});

test('a pool simplifies as the thread itself, in any order', async () => {
  const pool = createPool({ size: 2 });
  const errors = [1, 8, 2, 16, 4];
  const meshes = await Promise.all(errors.map(maxError => pool.simplify(z, width, height, { maxError })));
  errors.forEach((maxError, k) => {
    const mine = simplifySync(z, width, height, { maxError });
    assert.deepEqual(meshes[k].positions, mine.positions);
    assert.deepEqual(meshes[k].indices, mine.indices);
    assert.equal(meshes[k].triangleCount, mine.triangleCount);
  });
  const told = [];
  await pool.simplify(hills(200, 150), 200, 150, {
    maxError: 1,
    effort: 'high',
    onProgress: progress => {
      told.push(progress.pass);
    },
  });
  assert.ok(told.length > 0);
  const kept = z.slice();
  assert.ok((await pool.simplify(kept, width, height, { maxError: 4, transfer: true })).triangleCount > 0);
  assert.equal(kept.length, 0);
  await rejects(pool.simplify(kept, width, height, { maxError: 4 }), 'usage', /detached/);
  await rejects(pool.simplify(z.fill(NaN, 0, 0), width, height, {}), 'usage', /goal/);
  const shared = new Float32Array(new SharedArrayBuffer(z.byteLength));
  await rejects(
    pool.simplify(shared, width, height, { maxError: 4, transfer: true }),
    'usage',
    /SharedArrayBuffer.*leave transfer out/,
  );
  pool.terminate();
  await rejects(pool.simplify(z, width, height, { maxError: 4 }), 'usage', /terminated/);
});

test('what is given to a pool may be changed after the call', async () => {
  const pool = createPool({ size: 1 });
  const scratch = new Float32Array(z.length);
  const tolerance = new Float32Array(z.length);
  const given = [];
  for (let k = 0; k < 3; ++k) {
    scratch.set(z.map(value => value + 1000 * k));
    tolerance.fill(2 + k);
    given.push(pool.simplify(scratch, width, height, { tolerance, transform: [0, 1, 0, 0, 0, -1] }));
  }
  const points = new Float64Array([0, 0, 1, 9, 0, 2, 0, 9, 3]);
  const last = pool.simplifyPoints(points, { maxError: 1 });
  for (const array of [scratch, tolerance, points]) array.fill(7);
  (await Promise.all(given)).forEach((mesh, k) => {
    const own = { tolerance: new Float32Array(z.length).fill(2 + k), transform: [0, 1, 0, 0, 0, -1] };
    const mine = simplifySync(
      z.map(value => value + 1000 * k),
      width,
      height,
      own,
    );
    assert.deepEqual([mesh.positions, mesh.origin], [mine.positions, mine.origin]);
  });
  assert.equal((await last).triangleCount, 1);
  pool.terminate();
  await rejects(
    createPool({ size: 1, worker: () => null }).simplify(z, width, height, { maxError: 4 }),
    'usage',
    /made null/,
  );
});

test('work in workers leaves no global name behind', async () => {
  const had = Object.getOwnPropertyNames(globalThis);
  const pool = createPool({ size: 1 });
  await pool.simplify(z, width, height, { maxError: 4 });
  pool.terminate();
  assert.deepEqual(Object.getOwnPropertyNames(globalThis), had);
});

test('a page of HTML is no module, and the sentence says so', async () => {
  const { start } = await import('./node_modules/scarp/module.js?again');
  const page = new TextEncoder().encode('<!doctype html><title>');
  await assert.rejects(
    start(page),
    error =>
      error.code === 'input' &&
      /a page of HTML.*optimizeDeps: { exclude: \['scarp'\] }/.test(error.message) &&
      !/refused/.test(error.message),
  );
  await assert.rejects(start(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0)), {
    code: 'input',
    message: /is a module of WebAssembly, but not Scarp's/,
  });
  await assert.rejects(start(new Uint8Array(9)), { code: 'input', message: /begins with other bytes/ });
});

test('a signal cancels what runs, what waits and what has not begun', async () => {
  const pool = createPool({ size: 1 });
  await pool.simplify(z, width, height, { maxError: 4 });
  const large = hills(600, 400);
  const work = (signal, onProgress) =>
    pool.simplify(large, 600, 400, { maxError: 0.01, effort: 'max', signal, onProgress });
  const [runs, waits] = [new AbortController(), new AbortController()];
  // The running call has reported progress before it has answered, so that it is cancelled at work.
  const running = work(runs.signal, () => {
    waits.abort();
    runs.abort('enough');
  });
  const waiting = work(waits.signal);
  await rejects(waiting, 'cancelled', /cancelled/);
  await rejects(running, 'cancelled', /cancelled/);
  await rejects(work(AbortSignal.abort()), 'cancelled', /before it began/);
  refuses(
    () => simplifySync(z, width, height, { maxError: 1, signal: AbortSignal.abort() }),
    'cancelled',
    /before it began/,
  );
  assert.ok((await pool.simplify(z, width, height, { maxError: 4 })).triangleCount > 0, 'the pool goes on');
  pool.terminate();
});

test('a pool that is terminated rejects what it had, and leaves no worker', async () => {
  const exits = [];
  const worker = () => {
    const made = new Worker(new URL('node_modules/scarp/worker.js', import.meta.url));
    exits.push(new Promise(resolve => made.once('exit', resolve)));
    return made;
  };
  const [begins, runs] = [1, 2].map(size => createPool({ size, worker }));
  const work = (pool, onProgress) =>
    pool.simplify(hills(400, 300), 400, 300, { maxError: 0.01, effort: 'high', onProgress });
  const had = work(begins);
  begins.terminate();
  await rejects(had, 'cancelled', /terminated/);
  await Promise.all(
    [work(runs, () => runs.terminate()), work(runs)].map(promise => rejects(promise, 'cancelled', /terminated/)),
  );
  assert.ok(exits.length > 0);
  await Promise.all(exits);
});

test('simplify() needs neither ready() nor a pool', async () => {
  assert.ok((await simplify(z, width, height, { maxError: 4 })).triangleCount > 0);
  for (const work of [simplify(z, width, height, null), simplifyPoints([0, 0, 1], null)])
    await rejects(work, 'usage', /options are null/);
  assert.ok(
    (await simplifyPoints([0, 0, 1, 9, 0, 2, 0, 9, 3, 9, 9, 4, 5, 5, 60], { maxError: 1 })).triangleCount === 4,
  );
});

test('bad input gets a sentence that names it', () => {
  const flat = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 2] };
  assert.ok(encodeGlb(flat).length > 0);
  new Tiler(z, width, height, { bounds: [-180 - 1, -90 - 1, 180 + 1, 90 + 1] }).free(); // pixels around the poles
  const cases = [
    [
      () => simplifySync(z, width, height + 1, { maxError: 1 }),
      'usage',
      /8051 values, and a raster of 97 x 84 has 8148/,
    ],
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
    [
      () => simplifySync(z, width, height, { maxError: 1, signal: 'x' }),
      'usage',
      /signal is 'x'; it is an AbortSignal/,
    ],
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
    [
      () => simplifyPointsSync([0, 0, 1e39, 1, 0, 0, 0, 1, 0], { maxError: 1 }),
      'promise',
      /float32: take doubles: true/,
    ],
    ...[simplifySync, (...given) => new Refiner(...given.slice(0, 3)).run({ maxError: given[3].maxError })].map(
      work => [
        () => work(z, width, height, { maxError: Infinity }),
        'usage',
        /maxError is Infinity; it is a number, at least 0 and finite/,
      ],
    ),
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
    [
      () => simplifySync(z.buffer, width, height, { maxError: 1 }),
      'usage',
      /an ArrayBuffer: give a typed array over it/,
    ],
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
        encodeGlb(
          { ...flat, positions: [0, 3e38, 0, 1, 3e38, 0, 0, 3e38, 1], origin: [0, 3e38, 0] },
          { compress: true },
        ),
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

test('what ran before leaves no memory behind', { skip: !globalThis.gc && 'needs --expose-gc' }, async () => {
  const run = () => {
    for (let k = 0; k < 60; ++k) simplifySync(z, width, height, { maxError: 1, normals: true });
    for (let k = 0; k < 20; ++k) {
      const refiner = new Refiner(z, width, height);
      refiner.run({ maxError: 1 });
      refiner.mesh();
      refiner.free();
    }
    for (let k = 0; k < 20; ++k) assert.throws(() => simplifySync(z, width, height, {}));
  };
  // A collection may hand its findings to another thread to free.
  const kept = async most => {
    for (let k = 0; k < 100; ++k) {
      globalThis.gc();
      await new Promise(setImmediate);
      if (process.memoryUsage().arrayBuffers <= most) break;
    }
    return process.memoryUsage().arrayBuffers;
  };
  run();
  const before = await kept(0);
  const grown = memory.buffer.byteLength;
  run();
  const after = await kept(before);
  assert.ok(after <= before, `${after - before} bytes of arrays are kept`);
  assert.equal(memory.buffer.byteLength, grown, 'the memory of the module has grown');
});
