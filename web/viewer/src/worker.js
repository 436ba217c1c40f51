// The engine, beside the page: greedy meshes from one kept refinement, others by an effort. Answers are judged here.
import { holdLock } from './alive.js';
import { ready, Refiner, simplifySync } from 'scarp/inline';
import { judge } from './errors.js';

let field = null, refiner = null, failed = null;
const loaded = ready().then(warm_up).catch(error => { failed = `this browser refuses WebAssembly, which the slider needs (${error.message})`; });

/** The first mesh of a fresh module takes ten times as long as the next. */
function warm_up() {
  const side = 65, z = Float32Array.from({ length: side * side }, (_, k) => Math.sin(k) * (k % side));
  simplifySync(z, side, side, { maxError: 1, effort: 'fast' });
}

/** Finer meshes go on from the last; for a coarser one it begins again. */
function refine(error) {
  if (!refiner || refiner.maxError < error) {
    refiner?.free();
    refiner = new Refiner(field.samples, field.cols, field.rows);
  }
  refiner.run({ maxError: error });
  return refiner.mesh();
}

function answer({ kind, error, goal, effort }) {
  const mesh = kind === 'refine' ? refine(error) : simplifySync(field.samples, field.cols, field.rows, { ...goal, effort });
  const { positions, indices } = mesh, origin = [...mesh.origin], vertices = positions.length / 3, grid = new Float64Array(2 * vertices), heights = new Float64Array(vertices);
  for (let v = 0; v < vertices; ++v) {
    grid[2 * v] = positions[3 * v] + origin[0];
    grid[2 * v + 1] = field.rows - 1 - positions[3 * v + 1] - origin[1];
    heights[v] = positions[3 * v + 2] + origin[2];
  }
  return { mesh: { positions, indices, origin }, judged: judge(field, { grid, heights, indices }) };
}

const lock = holdLock();

onmessage = async ({ data }) => {
  if (data.field) {
    field = data.field;
    return postMessage({ lock: await lock });
  }
  await Promise.all([loaded, lock]);
  if (failed) return postMessage({ error: failed });
  try {
    const made = answer(data);
    postMessage(made, [made.mesh.positions.buffer, made.mesh.indices.buffer, made.judged.errors.buffer]);
  } catch (error) {
    postMessage({ error: error.message });
  }
};
