// The promises of the package's workers, in Node.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Worker } from 'node:worker_threads';
import { createPool, ready, simplify, simplifyPoints, simplifySync } from 'scarp/full';
import { height, refuses, rejects, width, z } from './checks.mjs';
import { hills } from './rasters.mjs';

await ready();

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
  // The running call reports progress before its answer, so it is cancelled at work.
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
