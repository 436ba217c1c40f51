// The work of a page in the browser test: the cases of same.mjs, cancelled work, and refusals.
import { createPool, ready, simplifySync } from './node_modules/scarp/index.js';
import { hashOf } from './canonical.mjs';
import { heightsOf, hills } from './rasters.mjs';

async function run() {
  try {
    await ready();
  } catch (error) {
    return { refused: error.code, message: error.message };
  }
  const wrong = [];
  const cases = await (await fetch('cases.json')).json();
  for (const { name, width, height, error, effort, hash } of crossOriginIsolated ? cases.slice(-3) : cases) {
    const z = heightsOf(await (await fetch(`${name}.f32`)).arrayBuffer());
    const mine = await hashOf(simplifySync(z, width, height, { maxError: error, effort }));
    if (mine !== hash) wrong.push(`${name} ${effort}: ${mine}, in Node ${hash}`);
  }
  const pool = createPool({ size: 1 });
  const controller = new AbortController();
  const work = pool.simplify(hills(600, 400), 600, 400, {
    maxError: 0.01,
    effort: 'max',
    signal: controller.signal,
    onProgress: () => controller.abort(),
  });
  const cancelled = await work.then(
    () => 'not cancelled',
    error => error.code,
  );
  const after = (await pool.simplify(hills(50, 50), 50, 50, { maxError: 1 })).triangleCount;
  pool.terminate();
  const script = ['mortal.mjs', 'node_modules/scarp/worker.js']
    .map(name => `import '${new URL(name, location.href)}';`)
    .join('');
  const worker = () =>
    new Worker(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })), { type: 'module' });
  const mortal = createPool({ size: 1, worker });
  const made = [];
  for (let k = 0; k < 3; ++k) {
    made.push(
      await mortal.simplify(hills(50, 50), 50, 50, { maxError: 1 }).then(
        mesh => mesh.triangleCount,
        error => `${error.code}: ${error.message}`,
      ),
    );
  }
  mortal.terminate();
  return { cases: cases.length, wrong, cancelled, after, made, isolated: crossOriginIsolated };
}

window.told = run().catch(error => ({ failed: `${error.code}: ${error.message}` }));
