// The position of samples in the program's default frame of a raster (src/grid/local_frame.cpp explains why cells are
// rounded). {affine, metres, extras, knowsMetres}: from columns and rows to x and y, metres for a unit of x, y and z, a
// mesh file's metadata about the frame.
export const WGS84 = { semiMajor: 6378137, inverseFlattening: 298.257223563 };

function metresPerRadian({ semiMajor, inverseFlattening }, latitude) {
  const f = inverseFlattening > 0 ? 1 / inverseFlattening : 0;
  const e2 = f * (2 - f);
  const w2 = 1 - e2 * Math.sin(latitude) ** 2;
  return [(semiMajor / Math.sqrt(w2)) * Math.cos(latitude), (semiMajor * (1 - e2)) / (w2 * Math.sqrt(w2))];
}

/** Rounds ties to even, as in C. */
function roundEven(value) {
  const near = Math.round(value);
  return Math.abs(value % 1) === 0.5 && near % 2 ? near - 1 : near;
}

/** Rounds to multiples of a power of two so coarse that float32 holds all their sums over the raster. */
function roundPair(pair, reach) {
  const span = Math.abs(pair[0]) * reach[0] + Math.abs(pair[1]) * reach[1];
  if (span === 0 || !Number.isFinite(span)) return pair;
  for (let unit = 2 ** (Math.floor(Math.log2(span)) - 25); ; unit *= 2) {
    const [p, q] = pair.map(value => roundEven(value / unit));
    if (Math.abs(p) * reach[0] + Math.abs(q) * reach[1] <= 2 ** 24) return [p * unit, q * unit];
  }
}

const at = (a, col, row) => [a[0] + a[1] * col + a[2] * row, a[3] + a[4] * col + a[5] * row];

/** From x and y relative to the centre sample to the coordinates of the raster's CRS. */
function backToSource([, a, b, , c, d], samples, centre) {
  const [, e, f, , g, h] = samples;
  const determinant = a * d - b * c;
  const [x, y] = at(samples, ...centre);
  return [
    x,
    (e * d - f * c) / determinant,
    (f * a - e * b) / determinant,
    y,
    (g * d - h * c) / determinant,
    (h * a - g * b) / determinant,
  ];
}

/** For every `step`th column and row: the position in the whole raster. */
export function thinFrame(frame, step) {
  return { ...frame, affine: frame.affine.map((value, k) => (k % 3 ? value * step : value)) };
}

export function gridFrame(rows) {
  return { affine: [0, 1, 0, rows - 1, 0, -1], metres: [1, 1, 1], knowsMetres: false, extras: { crs_option: 'grid' } };
}

/**
 * `samples`: from columns and rows to the coordinates of the CRS, in GDAL's order. `radians`: one unit of these, if
 * they are longitude and latitude; else `metres`, null where unknown. `height`: metres of a unit of the heights.
 * */
export function localFrame(
  samples,
  cols,
  rows,
  { radians = null, ellipsoid = WGS84, metres = null, height = 1, crs = null },
) {
  const centre = [Math.floor(cols / 2), Math.floor(rows / 2)];
  const latitude = radians && at(samples, ...centre)[1] * radians;
  const [east, north] = radians
    ? metresPerRadian(ellipsoid, latitude).map(length => length * radians)
    : Array(2).fill(metres ?? 1);
  const [xc, xr] = roundPair([samples[1] * east, samples[2] * east], centre);
  const [yc, yr] = roundPair([samples[4] * north, samples[5] * north], centre);
  const affine = [-(xc * centre[0] + xr * centre[1]), xc, xr, -(yc * centre[0] + yr * centre[1]), yc, yr];
  const isAtPole = radians && !(Math.abs(latitude) < Math.PI / 2 && east > 1e-3 * north);
  const area = xc * yr - xr * yc;
  if (isAtPole || area === 0 || !Number.isFinite(area)) return gridFrame(rows);
  const toSource = backToSource(affine, samples, centre);
  return {
    affine,
    metres: [1, 1, height],
    knowsMetres: Boolean(radians) || metres !== null,
    extras: {
      crs_option: 'local',
      origin: [toSource[0], toSource[3]],
      ...(crs ? { origin_crs: crs } : {}),
      to_source: toSource,
    },
  };
}
