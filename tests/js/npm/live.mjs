// Fields that change: the promise, a pure function of the samples, and refusals. With an argument: prints a hash of all
// changes of a sequence, which live.py makes from Python.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import test from 'node:test';
import { Live, measure, ready, simplifySync } from 'scarp/live';

await ready();
const [width, height] = [70, 50];
let state = 1;
const next = count => {
  state = (state * 16807) % 2147483647;
  return state % count;
};
const sample = () => (next(12) === 0 ? NaN : next(1000) / 64);
const field = () => Float32Array.from({ length: width * height }, (_, k) => (k % width) / 8 + sample());

/// A random window with its samples, another sample, or a step of the field.
function change(live) {
  if (next(5) === 0) return live.scroll(next(9) - 4, next(9) - 4);
  const [col, row] = [next(width - 1), next(height - 1)];
  const [cols, rows] = [1 + next(Math.min(20, width - col)), 1 + next(Math.min(20, height - row))];
  return live.update({ col, row, cols, rows }, Float32Array.from({ length: cols * rows }, sample));
}

/// The triangles in an order of their own: that of files differs without meshoptimizer.
function sorted({ positions, indices }) {
  const bytes = Buffer.from(positions.buffer);
  const corners = Array.from(indices, v => bytes.toString('hex', 12 * v, 12 * v + 12));
  const triangles = [];
  for (let k = 0; k < corners.length; k += 3) {
    const [a, b, c] = corners.slice(k, k + 3);
    triangles.push([a + b + c, b + c + a, c + a + b].sort()[0]);
  }
  return triangles.sort().join('');
}

function hash(effort, goals = { maxError: 3 }) {
  state = 7;
  const digest = createHash('sha256');
  const live = new Live(field(), width, height, { ...goals, effort, cell: 16, place: [5, -3] });
  let version = 0;
  for (let step = 0; step < 40; ++step) {
    const changes = live.changes(version);
    version = changes.version;
    for (const cell of changes.cells) {
      digest.update(Int32Array.from([cell.slot, cell.col, cell.row]));
      digest.update(sorted(cell));
    }
    change(live);
  }
  live.free();
  return digest.digest('hex');
}

const bytesOf = live => live.changes().cells.map(({ col, row, positions, indices }) => [col, row, positions, indices]);

if (process.argv[2] === 'hash') {
  for (const effort of ['fast', 'normal', 'high']) console.log(hash(effort));
  console.log(hash('normal', { maxTriangles: 2000 }));
} else {
  test('the mesh of a changed field is that of a new one, and within the bound', () => {
    for (const effort of ['fast', 'normal', 'high']) {
      for (let round = 0; round < 6; ++round) {
        const live = new Live(field(), width, height, { maxError: 2, effort, cell: 12 });
        for (let step = 0; step < 10; ++step) change(live);
        const z = live.heights();
        const anew = new Live(z, live.width, live.height, { maxError: 2, effort, cell: 12, place: live.place });
        assert.deepEqual(bytesOf(live), bytesOf(anew));
        assert.equal(live.triangleCount, anew.triangleCount);
        const mesh = new Live(z, width, height, { maxError: 2, effort, cell: 12 }).mesh();
        const judged = measure(z, width, height, mesh);
        assert.ok(judged.maxError <= 2 && judged.isSound, JSON.stringify(judged));
        const whole = simplifySync(z, width, height, { maxError: 2 });
        assert.equal(judged.uncovered, measure(z, width, height, whole).uncovered);
        anew.free();
        live.free();
      }
    }
  });

  test('a budget is kept after every change', () => {
    const live = new Live(field(), width, height, { maxTriangles: 3000, effort: 'normal', cell: 8 });
    for (let step = 0; step < 10; ++step) {
      change(live);
      assert.ok(live.triangleCount <= 3000, `${live.triangleCount}`);
    }
    assert.ok(live.maxError > 0);
    const { level, place } = live;
    const options = { maxTriangles: 3000, effort: 'normal', cell: 8, place, level };
    const anew = new Live(live.heights(), width, height, options);
    assert.deepEqual(bytesOf(anew), bytesOf(live));
    assert.equal(anew.level, level);
    assert.throws(() => new Live(field(), width, height, { maxTriangles: 9 }), /more than its budget of 9/);
  });

  test('changes are what a renderer needs: cells by slot, and only those that an update touches', () => {
    const flat = new Live(new Float32Array(100 * 80), 100, 80, { maxError: 0.1, cell: 10 });
    const all = flat.changes();
    assert.equal(all.cells.length, 10 * 8);
    assert.equal(new Set(all.cells.map(({ slot }) => slot)).size, all.cells.length);
    flat.update({ col: 12, row: 13, cols: 5, rows: 4 }, new Array(20).fill(3));
    const { cells, version } = flat.changes(all.version);
    assert.deepEqual(
      cells.map(({ col, row }) => [col, row]),
      [[10, 10]],
    );
    assert.ok(cells[0].indices instanceof Uint16Array && cells[0].positions instanceof Float32Array);
    assert.equal(flat.changes(version).cells.length, 0);
    flat.set(50, 50, null);
    assert.ok(Number.isNaN(flat.heights()[50 * 100 + 50]));
    assert.equal(flat.maxError, 0);
    assert.ok(all.cells.every(({ slot }) => slot < flat.slotCount));
  });

  test('nodata and tolerances hold in updates too', () => {
    const live = new Live(new Float64Array(40 * 40), 40, 40, {
      maxError: 1,
      nodata: -9999,
      tolerance: new Array(1600).fill(0.5),
    });
    live.update({ col: 3, row: 4, cols: 2, rows: 1 }, [-9999, 0.75], { tolerance: [1, 0] });
    assert.ok(Number.isNaN(live.heights()[4 * 40 + 3]));
    assert.equal(live.heights()[4 * 40 + 4], 0.75);
    assert.ok(live.maxError <= 0.5);
  });

  test('what cannot be done is refused in a sentence, and changes nothing', () => {
    const live = new Live(field(), width, height, { maxError: 1 });
    const before = bytesOf(live);
    const refuses = (work, sentence) => assert.throws(work, { code: 'usage', message: sentence });
    const window = { col: 0, row: 0, cols: 2, rows: 2 };
    refuses(() => new Live(field(), width, height, {}), /maxError is missing/);
    refuses(() => new Live(field(), width, height), /maxError/);
    refuses(() => new Live(field(), width, height, { maxError: 1, effort: 'max' }), /fast, normal, high/);
    refuses(() => new Live(field(), width, height, { maxError: 1, cell: 7 }), /8 to 254/);
    refuses(() => new Live(field(), width, height, { maxError: 1, place: [0.5, 0] }), /place is 0.5/);
    refuses(() => new Live(field(), width, height, { maxError: 1, tolerances: [] }), /did you mean tolerance/);
    refuses(() => live.update({ ...window, col: width - 1 }, [1, 2, 3, 4]), /window/);
    refuses(() => live.update({ ...window, cols: 1.5 }, [1, 2, 3, 4]), /cols is 1.5/);
    refuses(() => live.update({ col: 0, row: 0 }, [1]), /cols is undefined/);
    refuses(() => live.update(undefined, [1]), /col is undefined/);
    refuses(() => live.update(window, [1, 2, 3]), /has 3 values, and a window of 2 x 2 has 4/);
    refuses(() => live.update(window, ['1', 2, 3, 4]), /index 0/);
    refuses(() => live.update(window, [1, 2, 3, 4], { tolerance: [1, 2, 3, 4] }), /toleranc/);
    refuses(() => live.scroll(0.5, 0), /cols is 0.5/);
    refuses(() => live.changes(-1), /since is -1/);
    assert.throws(() => live.update(window, [1e39, 2, 3, 4]), { code: 'input', message: /1e\+39/ });
    assert.deepEqual(bytesOf(live), before);
    live.free();
    live.free();
    refuses(() => live.changes(), /was freed/);
  });
}
