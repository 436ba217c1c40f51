// An application of twenty lines for all bundlers: simplifies here and in a worker, and reports the result.
import { Refiner, createPool, encodeGlb, ready, simplifySync } from 'scarp';
import { hashOf } from './canonical.mjs';
import { hills } from './rasters.mjs';

export async function use() {
  const width = 120;
  const height = 90;
  const z = hills(width, height, 5);
  await ready();
  const mesh = simplifySync(z, width, height, { maxError: 2 });
  const pool = createPool({ size: 2 });
  const others = await Promise.all([1, 2, 3].map(() => pool.simplify(z, width, height, { maxError: 2 })));
  pool.terminate();
  const refiner = new Refiner(z, width, height);
  refiner.run({ maxError: 2 });
  const hashes = await Promise.all([mesh, ...others].map(hashOf));
  if (new Set(hashes).size !== 1) throw new Error(`the workers make other meshes: ${hashes}`);
  const told = `${hashes[0]} ${mesh.maxError} ${refiner.triangleCount} ${encodeGlb(mesh).length}`;
  refiner.free();
  return told;
}

if (typeof document === 'undefined') use().then(console.log);
else window.told = use().catch(error => `FAILED: ${error.code} ${error.message}`);
