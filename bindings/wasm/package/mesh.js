// Meshes as JavaScript has them: copies, so that nothing has to be freed.
import { call, view } from './module.js';

const STOPS = ['maxError', 'maxTriangles', 'maxVertices', 'exact'];
const EFFORTS = ['fast', 'normal', 'high', 'max'];
const REPORT = 17;
const VIEW = 11;

/// Of the door's doubles.
export function readReport(numbers) {
  const [stop, effort, vertices, triangles, samples, uncovered, stray, maxError, col, row, rmse, meanError, meanAbsError,
    p50, p95, p99, isSound] = numbers;
  const report = { vertexCount: vertices, triangleCount: triangles, samples, uncovered, stray, maxError,
    maxErrorAt: col < 0 ? null : [col, row], rmse, meanError, meanAbsError, p50, p95, p99 };
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
  /// What postMessage() may move instead of copying.
  transferables() {
    return [this.positions, this.indices, this.normals, this.uvs].filter(Boolean).map(array => array.buffer);
  }
}

/// The mesh of a handle, which is freed. `doubles`: positions are float64.
export function takeMesh(blocks, handle, { doubles = false } = {}) {
  try {
    const out = blocks.allocate(8 * (VIEW + REPORT));
    call('scarp_mesh_view', [handle, out]);
    const numbers = view(Float64Array, out, VIEW + REPORT).slice();
    const [vertices, triangles, positions, corners, normals, uvs] = numbers;
    const Corner = vertices <= 65535 ? Uint16Array : Uint32Array;
    const report = readReport(numbers.subarray(VIEW));
    const mesh = new Mesh({
      positions: (doubles ? Float64Array : Float32Array).from(view(Float64Array, positions, 3 * vertices)),
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
