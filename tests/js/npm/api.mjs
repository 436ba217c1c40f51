// The promises of the package, in Node.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import test from 'node:test';
import vm from 'node:vm';
import * as scarp from 'scarp/full';
import { height, refuses, rejects, width, z } from './checks.mjs';
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

const { Refiner, Tiler, decodeTile, encodeGlb, measure, ready, simplify, simplifyPointsSync, simplifySync } = scarp;

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
    told('scarp', 'scarp/live', 'new (await import("scarp/live")).Live([1, 2, 3, 4], 2, 2, { maxError: 1 })'),
    /^usage the module of scarp was loaded first.*import scarp\/live/,
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
  // Their nearest float32 are a tolerance above and a weight below, which the height would barely keep.
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
  const [coarse, flat] = ['max', 'rms'].map(objective =>
    simplifyPointsSync(Float64Array.from(points), { maxTriangles: 300, objective }),
  );
  assert.ok(flat.triangleCount <= 300 && flat.report.rmse < 0.95 * coarse.report.rmse);
  refuses(() => simplifyPointsSync(points, { maxError: 1, objective: 'rms' }), 'usage', /maxTriangles or maxVertices/);
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
  // Garbage collection may delegate freeing to another thread.
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
