// The declarations without a browser's types; compiled, never run.
import { Refiner, createPool, measure, ready, simplify, simplifySync, encodeGlb } from 'scarp';
import { Tiler } from 'scarp/full';
import { makeTerrainMesh } from 'scarp/loaders';
import * as inlined from 'scarp/inline';
const z = new Float32Array(4);
await ready(new Uint8Array(8));
const mesh = await simplify(z, 2, 2, {
  maxError: 1,
  mask: [1, 1, 1, 1],
  transform: new Float64Array(6),
  tolerance: null,
});
measure(z, 2, 2, mesh);
encodeGlb({ positions: [0, 0, 0], indices: [0, 0, 0] });
new Tiler(z, 2, 2, { bounds: [0, 0, 1, 1] }).free();
inlined.createPool().terminate();
// @ts-expect-error: what is refused
simplifySync(z, 2, 2, { maxError: 1, mask: { length: 4 } });
// @ts-expect-error: of the asynchronous functions
simplifySync(z, 2, 2, { maxError: 1, transfer: true });
// @ts-expect-error: no source
ready(5);
