// Rasters to meshes, and their measurement.
import { ScarpError, callOrThrow, view, withBlocks } from './module.js';
import { checkNumbers, checkOptions, putBeside, putDoubles, putField } from './heights.js';
import { REPORT_DOUBLES, readReport, takeMesh } from './mesh.js';

const CHOICES = {
  effort: ['auto', 'fast', 'normal', 'high', 'max'],
  vertices: ['auto', 'samples', 'free'],
  order: ['auto', 'greedy', 'dominant'],
  objective: ['max', 'rms'],
  duplicates: ['first', 'last', 'highest', 'lowest', 'mean'],
};
const KNOWN = ['maxError', 'maxTriangles', 'maxVertices', 'effort', 'vertices', 'order', 'objective', 'minShape',
  'outlineTolerance', 'normals', 'uvs', 'lattice', 'doubles', 'lockBorder', 'mask', 'tolerance', 'nodata', 'transform', 'degrees',
  'onProgress', 'signal', 'transfer'];

/// The number of a choice in the library's list of them.
export function choose(name, value) {
  const number = CHOICES[name].indexOf(value);
  if (number < 0) throw new ScarpError('usage', `${name} '${value}' is unknown: choose ${CHOICES[name].join(', ')}`);
  return number;
}

export function checkKnown(options, known) {
  checkOptions(options);
  for (const name of Object.keys(options)) {
    if (!known.includes(name)) throw new ScarpError('usage', `option ${name} is unknown; there are ${known.join(', ')}`);
  }
}

/// Goals as the door has them.
export function takeGoals({ maxError, maxTriangles = 0, maxVertices = 0 }) {
  if (maxError !== undefined && !(Number(maxError) >= 0)) throw new ScarpError('usage', `maxError is ${maxError}; it is a number, at least 0`);
  for (const [name, budget] of Object.entries({ maxTriangles, maxVertices })) {
    if (!Number.isSafeInteger(budget) || budget < 0) throw new ScarpError('usage', `${name} is ${budget}; it is a whole number, at least 1`);
  }
  return [maxError ?? NaN, maxTriangles, maxVertices];
}

/// What is asked during a call: the caller's function, and a flag that another thread sets.
export function watch(onProgress, flag) {
  if (!onProgress && !flag) return undefined;
  return snapshot => (flag && Atomics.load(flag, 0) ? false : onProgress?.(snapshot));
}

export function checkSignal(signal) {
  if (signal?.aborted) throw new ScarpError('cancelled', 'the call was cancelled before it began', { cause: signal.reason });
}

/// Simplifies here and now. `flag`: an Int32Array over shared memory, whose first number cancels.
export function simplifySync(z, width, height, options = {}, flag = undefined) {
  checkKnown(options, KNOWN);
  checkSignal(options.signal);
  const { effort = 'auto', vertices = 'auto', order = 'auto', objective = 'max', minShape = NaN, outlineTolerance = 0,
    normals, uvs, lattice, doubles, lockBorder, mask, tolerance, onProgress } = options;
  const progress = watch(onProgress, flag);
  return withBlocks(blocks => {
    const field = putField(blocks, z, width, height, options);
    const asked = putDoubles(blocks, takeGoals(options), choose('effort', effort), choose('vertices', vertices), choose('order', order),
      choose('objective', objective), minShape, outlineTolerance, Number(Boolean(normals)), Number(Boolean(uvs)),
      Number(Boolean(lattice)), Number(Boolean(doubles)), Number(Boolean(lockBorder)),
      putBeside(blocks, 'mask', mask, width, height), putBeside(blocks, 'tolerance', tolerance, width, height), Number(Boolean(progress)));
    return takeMesh(blocks, callOrThrow('scarp_simplify', [field, asked], progress), options);
  });
}

/// Judges a mesh by brute force, without knowing how it was made.
export function measure(z, width, height, mesh, options = {}) {
  checkKnown(options, ['nodata', 'transform', 'degrees']);
  const { positions, indices, origin = [0, 0, 0] } = mesh ?? {};
  if (!positions?.length || !indices?.length || positions.length % 3 || indices.length % 3)
    throw new ScarpError('usage', 'the mesh needs positions and indices, three numbers for each vertex and each triangle');
  const [x, y, up] = checkNumbers('origin', origin, 3);
  return withBlocks(blocks => {
    const field = putField(blocks, z, width, height, options);
    const absolute = Float64Array.from(positions);
    for (let k = 0; k < absolute.length; k += 3) {
      absolute[k] += x;
      absolute[k + 1] += y;
      absolute[k + 2] += up;
    }
    const out = blocks.allocate(8 * REPORT_DOUBLES);
    callOrThrow('scarp_measure', [field, blocks.put(absolute), positions.length / 3, blocks.put(Uint32Array.from(indices)),
      indices.length / 3, out]);
    return readReport(view(Float64Array, out, REPORT_DOUBLES).slice());
  });
}

/// Scattered points: x, y, z in turn.
export function simplifyPointsSync(points, options = {}, flag = undefined) {
  checkKnown(options, ['maxError', 'maxTriangles', 'maxVertices', 'duplicates', 'doubles', 'onProgress', 'signal', 'transfer']);
  checkSignal(options.signal);
  const { duplicates = 'first', doubles, onProgress } = options;
  if (!(ArrayBuffer.isView(points) || Array.isArray(points)) || points.length === 0 || points.length % 3)
    throw new ScarpError('usage', 'the points are no array of x, y, z in turn');
  const progress = watch(onProgress, flag);
  return withBlocks(blocks => {
    const asked = putDoubles(blocks, blocks.put(Float64Array.from(points)), points.length / 3, takeGoals(options),
      choose('duplicates', duplicates), Number(Boolean(doubles)), Number(Boolean(progress)));
    return takeMesh(blocks, callOrThrow('scarp_simplify_points', [asked], progress), options);
  });
}
