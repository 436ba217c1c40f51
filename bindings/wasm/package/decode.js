// Decodes heights from pixels of terrain tiles.
import { ScarpError } from './error.js';
import { FARTHEST, checkArray, checkSide } from './heights.js';

/// Metres: the sum of scaler · value, plus the offset.
const ENCODINGS = {
  terrarium: { rScaler: 256, gScaler: 1, bScaler: 1 / 256, offset: -32768 },
  mapbox: { rScaler: 6553.6, gScaler: 25.6, bScaler: 0.1, offset: -10000 },
};

/// `rgba`: four bytes a pixel, as in a canvas' ImageData. Returns a Float32Array, the first row in the north, with NaN
/// for fully transparent pixels.
export function decodeTile(rgba, width, height, encoding = 'terrarium') {
  const { rScaler, gScaler, bScaler, offset } =
    typeof encoding === 'object' && encoding ? encoding : (ENCODINGS[encoding] ?? {});
  if (![rScaler, gScaler, bScaler, offset].every(Number.isFinite)) {
    throw new ScarpError(
      'usage',
      `the encoding is none of ${Object.keys(ENCODINGS).join(', ')}, nor { rScaler, gScaler, bScaler, offset }`,
    );
  }
  checkSide('width', width, 1);
  checkSide('height', height, 1);
  if (checkArray('the pixels', rgba).length !== 4 * width * height)
    throw new ScarpError(
      'usage',
      `a tile of ${width} x ${height} pixels has ${4 * width * height} bytes, and ${rgba.length} were given`,
    );
  const z = new Float32Array(width * height);
  for (let k = 0; k < z.length; ++k) {
    const at = 4 * k;
    if (rgba[at + 3] === 0) {
      z[k] = NaN;
      continue;
    }
    const metres = rgba[at] * rScaler + rgba[at + 1] * gScaler + rgba[at + 2] * bScaler + offset;
    z[k] = metres;
    if (Number.isFinite(z[k])) continue;
    throw new ScarpError(
      'input',
      `the encoding makes ${metres} of pixel ${k} (${rgba[at]}, ${rgba[at + 1]}, ${rgba[at + 2]}), and float32 ` +
        `ends at ${FARTHEST}: take smaller scalers`,
    );
  }
  return z;
}
