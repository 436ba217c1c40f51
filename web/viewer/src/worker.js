// The engine in the background: greedy meshes from a continued refinement, others by effort. Results are judged here.
import { holdLock } from './alive.js';
import { ready, Refiner, simplifySync } from 'scarp/inline';
import { judge } from './errors.js';
import { Field, placeMesh } from './field.js';

let field = null;
let place = null;
let refiner = null;
let failed = null;
const loaded = ready()
  .then(warmUp)
  .catch(error => {
    failed = `this browser refuses WebAssembly, which the slider needs (${error.message})`;
  });

/** The first mesh of a fresh module needs ten times as long as the next. */
function warmUp() {
  const side = 65;
  const z = Float32Array.from({ length: side * side }, (_, k) => Math.sin(k) * (k % side));
  simplifySync(z, side, side, { maxError: 1, effort: 'fast' });
}

// Factor for an error: with rounding, the refiner would continue where an exact decision ends.
const AT_THE_BOUND = 1 + 1e-12;

/** Finer meshes continue from the last one; a coarser one begins anew. */
function refine(error) {
  if (!refiner || refiner.maxError < error) {
    refiner?.free();
    refiner = new Refiner(field.samples, field.cols, field.rows, place);
  }
  refiner.run({ maxError: error * AT_THE_BOUND });
  return refiner.mesh();
}

function answer({ kind, error, goal, effort, order = 'auto' }) {
  const mesh =
    kind === 'refine'
      ? refine(error)
      : simplifySync(field.samples, field.cols, field.rows, { ...place, ...goal, effort, order });
  const { positions, indices } = mesh;
  const origin = [...mesh.origin];
  return {
    mesh: { positions, indices, origin },
    judged: judge(field, { positions: placeMesh({ positions, origin }), indices }),
  };
}

const lock = holdLock();

onmessage = async ({ data }) => {
  if (data.field) {
    field = new Field(data.field);
    const a = field.affine;
    place = { transform: [a[0] - (a[1] + a[2]) / 2, a[1], a[2], a[3] - (a[4] + a[5]) / 2, a[4], a[5]] };
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
