// Simplifies rasters to meshes, and measures meshes.
import { ScarpError } from './error.js';
import { callOrThrow, view, withBlocks } from './module.js';
import { checkArray, putDoubles, putField, refuse, takeBeside } from './heights.js';
import { REPORT_DOUBLES, checkMesh, readReport, takeMesh } from './mesh.js';
import { choose, takeOptions } from './options.js';

/// Goals as numbers for the door.
const listGoals = ({ maxError = NaN, maxTriangles = 0, maxVertices = 0 }) => [maxError, maxTriangles, maxVertices];

/// The checks during a call: the caller's function, and a flag set by another thread.
export function watch(onProgress, flag) {
  if (!onProgress && !flag) return undefined;
  return snapshot => (flag && Atomics.load(flag, 0) ? false : onProgress?.(snapshot));
}

export function checkSignal(signal) {
  if (signal?.aborted)
    throw new ScarpError('cancelled', 'the call was cancelled before it began', { cause: signal.reason });
}

/// Simplifies synchronously. `flag`: an Int32Array over shared memory, whose first number cancels.
export function simplifySync(z, width, height, options = {}, flag = undefined) {
  const taken = takeOptions(options, 'simplifySync');
  checkSignal(taken.signal);
  const {
    effort,
    vertices,
    order,
    objective,
    minShape = NaN,
    outlineTolerance,
    normals,
    uvs,
    lattice,
    doubles,
    lockBorder,
    mask,
    tolerance,
    onProgress,
  } = taken;
  const progress = watch(onProgress, flag);
  return withBlocks(blocks => {
    const { address, rounding } = putField(blocks, z, width, height, taken);
    const beside = (name, values) => (values ? blocks.put(takeBeside(name, values, width, height)) : 0);
    const asked = putDoubles(
      blocks,
      listGoals(taken),
      choose('effort', effort),
      choose('vertices', vertices),
      choose('order', order),
      choose('objective', objective),
      minShape,
      outlineTolerance,
      Number(Boolean(normals)),
      Number(Boolean(uvs)),
      Number(Boolean(lattice)),
      Number(Boolean(doubles)),
      Number(Boolean(lockBorder)),
      beside('mask', mask),
      beside('tolerance', tolerance),
      Number(Boolean(progress)),
    );
    return takeMesh(blocks, callOrThrow('scarp_simplify', [address, asked], progress), {
      doubles: doubles || lattice,
      rounding,
    });
  });
}

/// Judges a mesh by brute force, regardless of how it was made.
export function measure(z, width, height, mesh, options = {}) {
  const place = takeOptions(options, 'place');
  const { positions, indices, origin } = checkMesh(mesh);
  return withBlocks(blocks => {
    const { address, rounding } = putField(blocks, z, width, height, place);
    const out = blocks.allocate(8 * REPORT_DOUBLES);
    callOrThrow('scarp_measure', [
      address,
      putDoubles(blocks, Array.from(origin)),
      blocks.put(Float64Array.from(positions)),
      positions.length / 3,
      blocks.put(Uint32Array.from(indices)),
      indices.length / 3,
      out,
    ]);
    return readReport(view(Float64Array, out, REPORT_DOUBLES).slice(), rounding);
  });
}

/// Checks scattered points.
export function checkPoints(points) {
  const given = checkArray('the points', points);
  if (given.length === 0 || given.length % 3)
    refuse(`the points have ${given.length} numbers, and are x, y, z in turn`);
  return given;
}

/// Scattered points: interleaved x, y, z.
export function simplifyPointsSync(points, options = {}, flag = undefined) {
  const taken = takeOptions(options, 'simplifyPointsSync');
  checkSignal(taken.signal);
  const { duplicates, effort, vertices, minShape = NaN, objective, doubles, onProgress } = taken;
  const given = checkPoints(points);
  const progress = watch(onProgress, flag);
  return withBlocks(blocks => {
    const asked = putDoubles(
      blocks,
      blocks.put(Float64Array.from(given)),
      given.length / 3,
      listGoals(taken),
      choose('duplicates', duplicates),
      choose('effort', effort),
      choose('vertices', vertices),
      minShape,
      choose('objective', objective),
      Number(Boolean(doubles)),
      Number(Boolean(progress)),
    );
    return takeMesh(blocks, callOrThrow('scarp_simplify_points', [asked], progress), { doubles });
  });
}
