// Rasters that tests generate.
export function hills(width, height, seed = 1) {
  let state = seed;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const waves = Array.from({ length: 12 }, () => [random() / 4, random() / 4, 6 * random(), 40 * random()]);
  return Float32Array.from({ length: width * height }, (_, k) => {
    const x = k % width;
    const y = Math.floor(k / width);
    return (
      Math.round(8 * waves.reduce((sum, [a, b, c, d]) => sum + d * Math.sin(a * x + b * y + c), 300 + 4 * random())) / 8
    );
  });
}

/// The samples of a float32 file, with its nodata value as NaN.
export const heightsOf = buffer => new Float32Array(buffer).map(z => (z === -9999 ? NaN : z));
