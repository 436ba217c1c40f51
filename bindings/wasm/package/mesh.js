// Meshes in JavaScript's memory: copies, which need not be freed.
import { ScarpError } from './error.js';
import { call, view } from './module.js';
import { checkArray, checkLength, refuse } from './heights.js';

const STOPS = ['maxError', 'maxTriangles', 'maxVertices', 'exact'];
const EFFORTS = ['fast', 'normal', 'high', 'max'];
const REPORT = 17;
const VIEW = 11;

/// The report from the door's doubles. `rounding`: the largest rounding of heights to float32, added to the max error.
export function readReport(numbers, rounding = 0) {
  const [
    stop,
    effort,
    vertices,
    triangles,
    samples,
    uncovered,
    stray,
    maxError,
    col,
    row,
    rmse,
    meanError,
    meanAbsError,
    p50,
    p95,
    p99,
    isSound,
  ] = numbers;
  const report = {
    vertexCount: vertices,
    triangleCount: triangles,
    samples,
    uncovered,
    stray,
    maxError: maxError + rounding,
    sampleRounding: rounding,
    maxErrorAt: col < 0 ? null : [col, row],
    rmse,
    meanError,
    meanAbsError,
    p50,
    p95,
    p99,
  };
  if (stop >= 0) report.stop = STOPS[stop];
  if (effort >= 0) report.effort = EFFORTS[effort];
  if (isSound >= 0) report.isSound = isSound === 1;
  return report;
}
export const REPORT_DOUBLES = REPORT;

export class Mesh {
  constructor(parts) {
    Object.assign(this, parts);
  }
  get vertexCount() {
    return this.positions.length / 3;
  }
  get triangleCount() {
    return this.indices.length / 3;
  }
  /// Buffers that postMessage() may move instead of copying.
  transferables() {
    return [this.positions, this.indices, this.normals, this.uvs].filter(Boolean).map(array => array.buffer);
  }
}

/// Checks a caller's mesh: the lengths of its arrays, and the range of its indices.
export function checkMesh(mesh) {
  const { positions, indices, normals, uvs } = mesh ?? {};
  const origin = mesh?.origin ?? [0, 0, 0];
  const cell = mesh?.cell ?? undefined;
  if (!positions?.length || !indices?.length) refuse('the mesh needs positions and indices');
  for (const [name, values] of Object.entries({ positions, indices, origin, cell, normals, uvs })) {
    if (values == null) continue;
    const bad = checkArray(`the mesh's ${name}`, values).findIndex(value => !Number.isFinite(value));
    if (bad >= 0)
      throw new ScarpError('input', `index ${bad} of the mesh's ${name} is ${values[bad]}, and no finite number`);
  }
  for (const [name, values] of Object.entries({ positions, indices })) {
    if (values.length % 3)
      refuse(
        `the mesh's ${name} has ${values.length} numbers, and needs three for each ` +
          (name === 'indices' ? 'triangle' : 'vertex'),
      );
  }
  const count = positions.length / 3;
  const vertices = `a mesh of ${count} vertices`;
  const lost = indices.findIndex(index => !(index >= 0 && index < count && Number.isInteger(index)));
  if (lost >= 0)
    throw new ScarpError(
      'input',
      `index ${lost} of the mesh's indices is ${indices[lost]}, and ${vertices} has none of that number`,
    );
  checkLength("the mesh's origin", origin, 3, 'a point');
  if (cell) checkLength("the mesh's cell", cell, 2, 'a cell');
  if (normals) checkLength("the mesh's normals", normals, 3 * count, vertices);
  if (uvs) checkLength("the mesh's uvs", uvs, 2 * count, vertices);
  return { positions, indices, origin, cell, normals, uvs };
}

/// Returns the mesh of a handle, and frees it. `doubles`: positions are float64, as they always are if float32 would
/// move them.
export function takeMesh(blocks, handle, { doubles = false, rounding = 0 } = {}) {
  try {
    const out = blocks.allocate(8 * (VIEW + REPORT));
    call('scarp_mesh_view', [handle, out]);
    const numbers = view(Float64Array, out, VIEW + REPORT).slice();
    const [vertices, triangles, positions, corners, normals, uvs] = numbers;
    const Corner = vertices <= 65535 ? Uint16Array : Uint32Array;
    const report = readReport(numbers.subarray(VIEW), rounding);
    const places = view(Float64Array, positions, 3 * vertices);
    const mesh = new Mesh({
      positions:
        doubles || places.some(place => Math.fround(place) !== place) ? places.slice() : Float32Array.from(places),
      indices: Corner.from(view(Uint32Array, corners, 3 * triangles)),
      origin: Array.from(numbers.subarray(6, 9)),
      cell: Array.from(numbers.subarray(9, 11)),
      maxError: report.maxError,
      rmse: report.rmse,
      report,
    });
    if (normals) mesh.normals = view(Float32Array, normals, 3 * vertices).slice();
    if (uvs) mesh.uvs = view(Float32Array, uvs, 2 * vertices).slice();
    return mesh;
  } finally {
    call('scarp_mesh_free', [handle]);
  }
}
