// A small raster to simplify before the caller's raster: WebAssembly engines optimise code that has run.
export const SIDE = 65;
export const hills = () =>
  Float32Array.from({ length: SIDE * SIDE }, (_, k) => {
    const x = k % SIDE;
    const y = Math.floor(k / SIDE);
    return 20 * Math.sin(x / 7) * Math.cos(y / 5) + ((x * 7919 + y * 104729) % 97) / 20;
  });
