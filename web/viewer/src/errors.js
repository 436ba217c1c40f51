// The error of every sample, mesh minus sample, by brute force over the triangles.
const EDGE = 1e-9; // share of a triangle: more than rounding moves a sample on an edge

const knownStray = new WeakMap();

/** Valid samples in no cell with three valid corners: no mesh needs to cover them. */
function findStray({ samples, cols, rows }) {
  if (knownStray.has(samples)) return knownStray.get(samples);
  const stray = new Set();
  const isValid = (col, row) =>
    col >= 0 && row >= 0 && col < cols && row < rows && samples[row * cols + col] === samples[row * cols + col];
  for (let row = 0, at = 0; row < rows; ++row) {
    for (let col = 0; col < cols; ++col, ++at) {
      if (samples[at] !== samples[at]) continue;
      const isCorner = (dx, dy) => isValid(col + dx, row) + isValid(col, row + dy) + isValid(col + dx, row + dy) >= 2;
      if (!(isCorner(1, 1) || isCorner(-1, 1) || isCorner(1, -1) || isCorner(-1, -1))) stray.add(at);
    }
  }
  knownStray.set(samples, stray);
  return stray;
}

/**
 * `positions`: x, y, z of the frame that the field lies in. Returns errors of all samples (NaN: void or uncovered),
 * the largest |error|, the root of the mean square, and how many samples were covered, not, and stray: these are not
 * judged.
 */
export function judge(field, { positions, indices }) {
  const { samples, cols, rows } = field;
  const stray = findStray(field);
  const grid = field.toGrids(positions);
  const errors = new Float32Array(cols * rows).fill(NaN);
  let maxError = 0;
  let squares = 0;
  let covered = 0;
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [indices[t], indices[t + 1], indices[t + 2]];
    const ax = grid[2 * a];
    const ay = grid[2 * a + 1];
    const bx = grid[2 * b];
    const by = grid[2 * b + 1];
    const cx = grid[2 * c];
    const cy = grid[2 * c + 1];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) continue;
    const az = positions[3 * a + 2];
    const bz = positions[3 * b + 2];
    const cz = positions[3 * c + 2];
    const lastRow = Math.min(rows - 1, Math.floor(Math.max(ay, by, cy)));
    const lastCol = Math.min(cols - 1, Math.floor(Math.max(ax, bx, cx)));
    const firstCol = Math.max(0, Math.ceil(Math.min(ax, bx, cx)));
    for (let row = Math.max(0, Math.ceil(Math.min(ay, by, cy))); row <= lastRow; ++row) {
      for (let col = firstCol; col <= lastCol; ++col) {
        const ofB = (col - ax) * (cy - ay) - (row - ay) * (cx - ax);
        const ofC = (bx - ax) * (row - ay) - (by - ay) * (col - ax);
        if (ofB / area < -EDGE || ofC / area < -EDGE || (ofB + ofC) / area > 1 + EDGE) continue;
        const at = row * cols + col;
        if (errors[at] === errors[at] || stray.has(at)) continue; // on an edge, judged with the neighbour
        const z = samples[at];
        const error = ((area - ofB - ofC) * (az - z) + ofB * (bz - z) + ofC * (cz - z)) / area; // 0 if it has no area
        if (error !== error) continue;
        errors[at] = error;
        ++covered;
        squares += error * error;
        maxError = Math.max(maxError, Math.abs(error));
      }
    }
  }
  let valid = 0;
  let worst = -1;
  errors.forEach((error, at) => {
    if (Math.abs(error) > (worst < 0 ? -1 : Math.abs(errors[worst]))) worst = at;
  });
  for (const z of samples) if (z === z) ++valid;
  return {
    errors,
    maxError,
    rmse: Math.sqrt(squares / Math.max(1, covered)),
    covered,
    uncovered: valid - covered - stray.size,
    stray: stray.size,
    worst: worst < 0 ? null : [worst % cols, Math.floor(worst / cols)],
  };
}

/** Halves the size at each step, keeping the value of largest |error| among four: no spike is lost from afar. */
export function makePyramid(errors, cols, rows) {
  const levels = [{ data: errors, width: cols, height: rows }];
  for (let { data, width, height } = levels[0]; width > 1 || height > 1; { data, width, height } = levels.at(-1)) {
    const w = Math.max(1, width >> 1);
    const h = Math.max(1, height >> 1);
    const next = new Float32Array(w * h);
    for (let y = 0; y < h; ++y) {
      for (let x = 0; x < w; ++x) {
        let largest = NaN;
        const right = x === w - 1 ? width : 2 * x + 2;
        const below = y === h - 1 ? height : 2 * y + 2;
        for (let r = 2 * y; r < below; ++r) {
          for (let c = 2 * x; c < right; ++c) {
            const error = data[r * width + c];
            if (!(Math.abs(error) <= Math.abs(largest))) largest = error === error ? error : largest;
          }
        }
        next[y * w + x] = largest;
      }
    }
    levels.push({ data: next, width: w, height: h });
  }
  return levels;
}
