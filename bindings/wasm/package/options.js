// The options of all entries: one table of their kinds, and one check. settings.js has those of the program, from its
// table of options; pack.mjs writes it.
import { ScarpError } from './error.js';
import { ROWS } from './settings.js';

/// The kind of an object, such as DataView, in any realm.
export const kindOf = value =>
  Object.prototype.toString
    .call(value)
    .slice(8, -1)
    .replace(/^Object$/, 'object');

const isArray = value => (ArrayBuffer.isView(value) ? kindOf(value) !== 'DataView' : Array.isArray(value));
const number = ({ least = -Infinity, above = -Infinity, most = Infinity }) => ({
  fits: value => Number.isFinite(value) && value >= least && value > above && value <= most,
  is:
    most < Infinity
      ? `a number, ${least} to ${most}`
      : least === above
        ? 'a finite number'
        : `a number, ${above < least ? `at least ${least}` : `above ${above}`} and finite`,
});
const whole = ({ least, most = Number.MAX_SAFE_INTEGER }) => ({
  fits: value => Number.isSafeInteger(value) && value >= least && value <= most,
  is: most < Number.MAX_SAFE_INTEGER ? `a whole number, ${least} to ${most}` : `a whole number, at least ${least}`,
});
const choice = (...list) => ({ fits: value => list.includes(value), is: `one of ${list.join(', ')}`, list });
const kind = (fits, is) => ({ fits, is });
/// null means none, as in metadata of files.
const orNull = ({ fits, ...told }) => ({ fits: value => value === null || fits(value), ...told });
/// An array of valid items; the error names the first invalid one.
const items = (fits, item, is, count = undefined) => {
  const findOdd = value =>
    isArray(value) && value.length === (count ?? value.length)
      ? Array.from(value).findIndex(one => !fits(one))
      : undefined;
  return { fits: value => findOdd(value) === -1, is, item, findOdd };
};

const flag = kind(value => typeof value === 'boolean', 'true or false');
const work = orNull(kind(value => typeof value === 'function', 'a function'));
const text = kind(value => typeof value === 'string', 'a text');
const numbers = count => items(Number.isFinite, 'finite number', `an array of ${count} finite numbers`, count);
const bySample = orNull(kind(isArray, 'an array of numbers, one for each sample'));

const KINDS = {
  flag: () => flag,
  number: row => (row.nan ? kind(value => typeof value === 'number', 'a number') : number(row)),
  count: whole,
  choice: ({ choices }) => choice(...choices),
  file: () => bySample,
};
const takeRows = rows => Object.fromEntries(Object.entries(rows).map(([name, row]) => [name, KINDS[row.type](row)]));
const OF_PROGRAM = takeRows(ROWS.simplify);
const OF_TILES = takeRows(ROWS.tile);

const TABLE = {
  ...OF_TILES,
  ...OF_PROGRAM,
  nodata: orNull(OF_PROGRAM.nodata),
  lattice: flag,
  degrees: flag,
  transfer: flag,
  warm: flag,
  transform: orNull(numbers(6)),
  onProgress: work,
  worker: work,
  signal: orNull(kind(value => typeof value.addEventListener === 'function' && 'aborted' in value, 'an AbortSignal')),
  cell: whole({ least: 8, most: 254 }),
  place: numbers(2),
  level: kind(Number.isSafeInteger, 'the level of another Live field'),
  size: whole({ least: 1, most: 1024 }),
  height: whole({ least: 2 }),
  bounds: orNull(numbers(4)),
  crs: choice('degrees', 'mercator'),
  name: text,
  attribution: text,
  tiles: items(one => typeof one === 'string', 'text', 'an array of texts'),
  meshMaxError: OF_PROGRAM.maxError,
  skirtHeight: orNull(number({ least: 0 })),
  elevationDecoder: kind(
    value => typeof value === 'string' || (typeof value === 'object' && value),
    'terrarium, mapbox or { rScaler, gScaler, bScaler, offset }',
  ),
};

const PLACE = ['nodata', 'transform', 'degrees'];
const GOALS = ['maxError', 'maxTriangles', 'maxVertices'];
const RUN = ['onProgress', 'signal'];
/// The options accepted by each entry.
const SIMPLIFY = [
  ...GOALS,
  'effort',
  'vertices',
  'order',
  'objective',
  'minShape',
  'outlineTolerance',
  'normals',
  'uvs',
  'lattice',
  'doubles',
  'lockBorder',
  'mask',
  'tolerance',
  ...PLACE,
  ...RUN,
];
const POINTS = [...GOALS, 'duplicates', 'effort', 'vertices', 'minShape', 'objective', 'doubles', ...RUN];
export const ENTRIES = {
  simplify: [...SIMPLIFY, 'transfer'],
  simplifySync: SIMPLIFY,
  simplifyPoints: [...POINTS, 'transfer'],
  simplifyPointsSync: POINTS,
  place: PLACE,
  live: ['maxError', 'maxTriangles', 'effort', 'cell', 'tolerance', 'place', 'level', ...PLACE],
  update: ['tolerance'],
  refine: ['maxError', 'maxVertices'],
  pool: ['size', 'worker'],
  glb: ['compress'],
  tiler: ['bounds', 'crs', 'nodata', 'cells', 'maxZoom', 'maxError', 'quality', 'effort', 'background'],
  ready: ['warm'],
  layerJson: ['name', 'attribution', 'tiles'],
  martini: ['height', 'effort'],
  terrain: ['bounds', 'meshMaxError', 'elevationDecoder', 'skirtHeight', 'effort'],
};
/// Kinds restricted by some entries.
const NARROWER = { tiler: OF_TILES, live: { effort: OF_TILES.effort } };
/// The rows whose defaults an entry fills in.
const DEFAULTS = { simplifySync: ROWS.simplify, simplifyPointsSync: ROWS.simplify, tiler: ROWS.tile };
/// The goals required by an entry.
const GOAL = 'give a goal, such as { maxError: 1 }';
const NEEDS = {
  simplify: GOAL,
  simplifySync: GOAL,
  simplifyPoints: GOAL,
  simplifyPointsSync: GOAL,
  live: 'give { maxError: 0.05 }',
  tiler: 'give { bounds: [west, south, east, north] }',
};

/// The number of a choice in the library's list of choices.
export const choose = (name, value) => TABLE[name].list.indexOf(value);

export const article = noun => `${/^[aeiou]/i.test(noun) ? 'an' : 'a'} ${noun}`;

/// A value as text for a message.
export function show(value) {
  if (typeof value === 'string') return `'${value.slice(0, 40)}'`;
  if (typeof value === 'bigint') return `the BigInt ${value}`;
  if (typeof value === 'function') return 'a function';
  if (isArray(value)) return `an array of ${value.length}`;
  return typeof value === 'object' && value ? article(kindOf(value)) : String(value);
}

/// Number of letters to change, insert or remove between two words.
function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, k) => k);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j)
      next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1)));
    row = next;
  }
  return row[b.length];
}

function findNear(name, known) {
  const plain = word => word.toLowerCase().replace(/[^a-z]/g, '');
  const far = known.map(one => [distance(plain(name), plain(one)) / one.length, one]).sort(([a], [b]) => a - b);
  const [share, near] = far[0];
  return share <= 0.4 ? near : known.find(one => plain(one).startsWith(plain(name)) && plain(name).length > 2);
}

/// Checks and returns the given options of an entry.
export function takeOptions(options, entry) {
  if (options === null || typeof options !== 'object' || isArray(options))
    throw new ScarpError(
      'usage',
      `the options are ${options === null ? 'null' : isArray(options) ? 'an array' : article(typeof options)}, ` +
        `and no object: ${NEEDS[entry] ?? 'leave them out, or give { name: value }'}`,
    );
  const known = ENTRIES[entry];
  const taken = {};
  for (const name of known) {
    const byDefault = DEFAULTS[entry]?.[name]?.byDefault;
    if (byDefault !== undefined) taken[name] = byDefault;
  }
  for (const [name, value] of Object.entries(options)) {
    if (!known.includes(name)) {
      const later = entry.replace(/Sync$/, '');
      if (later !== entry && ENTRIES[later].includes(name))
        throw new ScarpError(
          'usage',
          `option ${name} is for workers: leave it out, or take ${later}() in place of ${entry}()`,
        );
      const near = findNear(name, known);
      throw new ScarpError(
        'usage',
        `option ${name} is unknown${near ? `: did you mean ${near}? Known are` : '; known are'} ${known.join(', ')}`,
      );
    }
    if (value === undefined) continue;
    const { fits, is, item, findOdd } = NARROWER[entry]?.[name] ?? TABLE[name];
    if (!fits(value)) {
      const odd = findOdd?.(value);
      throw new ScarpError(
        'usage',
        odd === undefined
          ? `${name} is ${show(value)}; it is ${is}`
          : `index ${odd} of ${name} is ${show(value[odd])}, and no ${item}`,
      );
    }
    if (value !== null) taken[name] = value;
  }
  return taken;
}

/// Messages of the library with the package's names.
const WORDS = [
  [/\binf\b/g, 'Infinity'],
  [/write OBJ or PLY, whose positions are double/, 'take doubles: true'],
  [/(?:or use|write in) the local or grid frame/, 'leave transform out'],
  [/\bdomain\.border\b/, 'lockBorder'],
  [/float32_positions = false/, 'doubles'],
  [/\b(effort|order|vertices|objective) = (\w+)/g, "$1: '$2'"],
  [/choose the frame 'source'/, 'leave degrees out'],
  [/choose a polar CRS such as EPSG:3413 or EPSG:3031/, 'leave degrees out if the transform is in other units'],
  [
    /\(gdal_translate -a_ullr .*\), or their CRS if they are not degrees \(.*\)/,
    "in bounds, or take crs: 'mercator' if they are its metres",
  ],
  [
    /\b[a-z]+(?:_[a-z]+)+\b/g,
    word => {
      const name = word.replace(/_(.)/g, (_, letter) => letter.toUpperCase());
      return TABLE[name] ? name : word;
    },
  ],
];
export const translate = sentence => WORDS.reduce((told, [theirs, ours]) => told.replace(theirs, ours), sentence);
