// The declarations as in an editor; compiled, never run.
import {
  Refiner,
  ScarpError,
  createPool,
  decodeTile,
  encodeGlb,
  measure,
  ready,
  simplify,
  simplifySync,
  type Mesh,
  type Report,
} from 'scarp';
import { Tiler, simplifyPointsSync, type LayerJson } from 'scarp/full';
import { Refiner as Lite } from 'scarp/lite';
import { Live, type LiveCell } from 'scarp/live';
import { simplify as inlined } from 'scarp/inline';
import Delatin from 'scarp/delatin';
import Martini from 'scarp/martini';
import { TerrainLoader, makeTerrainMesh } from 'scarp/loaders';

const z = new Float32Array(65 * 65);
await ready(new URL('https://example.org/scarp.wasm'));
const mesh: Mesh = simplifySync(z, 65, 65, {
  maxError: 1,
  effort: 'high',
  onProgress: ({ fraction }) => fraction < 0.5,
});
const report: Report = measure(z, 65, 65, mesh);
const later: Promise<Mesh> = simplify(z, 65, 65, {
  maxTriangles: 100,
  signal: new AbortController().signal,
  transfer: true,
});
const pool = createPool({ size: 2 });
const glb = encodeGlb(
  await pool.simplify(decodeTile(new Uint8ClampedArray(16), 2, 2, 'mapbox'), 2, 2, { maxError: 1 }),
);
const files: BlobPart[] = [glb, mesh.positions, mesh.indices];
const blob = new Blob(files),
  file = new File([encodeGlb(mesh)], 'a.glb'),
  response = new Response(encodeGlb(mesh));
postMessage(mesh, '*', mesh.transferables());
const refiner = new Refiner([1, null, 3, 4], 2, 2, { nodata: null }),
  lite = new Lite(z, 65, 65);
const inserted: number = refiner.run({ maxError: 1 }) + lite.run({ maxVertices: 10 });
const live = new Live(z, 65, 65, { maxError: 0.1, effort: 'normal', place: [3, 4] });
live.update({ col: 1, row: 2, cols: 1, rows: 2 }, [1, null], { tolerance: null });
const cells: readonly LiveCell[] = live.changes(live.changes().version).cells;
const tile: Uint8Array = new Tiler(z, 65, 65, { bounds: [0, 0, 1, 1] }).tile(0, 1, 0).bytes;
const layer: LayerJson = new Tiler(z, 65, 65, { bounds: [0, 0, 1, 1] }).layerJson({ name: 'land' });
const points: Mesh = simplifyPointsSync([0, 0, 0], { maxError: 1 });
const coords: number[] = new Delatin(z, 65).coords;
const { vertices }: { vertices: Uint16Array } = new Martini(65).createTile(z).getMesh(1);
const loaded = makeTerrainMesh({ data: new Uint8ClampedArray(16), width: 2, height: 2 }, { meshMaxError: 1 });
const code: 'usage' | string = new ScarpError('usage', 'a sentence').code;
// @ts-expect-error: no such effort
simplifySync(z, 65, 65, { maxError: 1, effort: 'best' });
// @ts-expect-error: no such option
simplifySync(z, 65, 65, { maxEror: 1 });
export {
  blob,
  file,
  response,
  code,
  cells,
  coords,
  glb,
  inlined,
  inserted,
  later,
  layer,
  loaded,
  points,
  report,
  tile,
  vertices,
  TerrainLoader,
};
