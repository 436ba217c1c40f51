// Heights that are undeclared nodata, by the program's rule (scarp/height_field.h, find_undeclared_nodata).
import { count, number } from './words.js';

const ENDS = 6;
const SIGNS = [9999, 99999, 999999, 32767, 65535];
const HUGE = 1e20;

/** The outermost distinct heights at one end, inwards: [{height, samples}]. `isBeyond(a, b)`: a lies farther out than
 * b. */
function outermost(samples, isBeyond) {
  const ends = [];
  for (const z of samples) {
    if (z !== z || (ends.length === ENDS && isBeyond(ends[ENDS - 1].height, z))) continue;
    let k = ends.length;
    while (k > 0 && isBeyond(z, ends[k - 1].height)) --k;
    if (k > 0 && ends[k - 1].height === z) ++ends[k - 1].samples;
    else {
      ends.splice(k, 0, { height: z, samples: 1 });
      ends.length = Math.min(ends.length, ENDS);
    }
  }
  return ends;
}

const isSign = z => Math.abs(z) >= HUGE || z === -999 || z === -10000 || z === -32768 || SIGNS.includes(Math.abs(z));

function isFar({ height, samples }, gap, range, valid) {
  if (isSign(height) && gap >= 0.2 * range) return true;
  if (range === 0) return false;
  if (height === 0 && gap >= 10 && gap >= 0.05 * range && samples >= Math.floor(valid / 1000)) return true;
  return gap >= 50 * range && samples <= Math.floor(valid / 100);
}

/** The number of heights at one end that are far from the others, which end at `other`. */
function countFar(ends, first, other, valid) {
  for (let next = first + 1; next < ends.length; ++next) {
    const { height } = ends[next];
    const range = Math.abs(other - height);
    const mayTell = range > 0 || !isSign(height);
    if (mayTell && ends.slice(first, next).every(here => isFar(here, Math.abs(height - here.height), range, valid)))
      return next;
  }
  return first;
}

/** Sentences, one for each such height. */
export function warnOfUndeclared({ name, samples }) {
  const lowest = outermost(samples, (a, b) => a < b);
  const highest = outermost(samples, (a, b) => a > b);
  if (lowest.length < 2) return [];
  let valid = 0;
  let low = 0;
  let high = 0;
  for (const z of samples) valid += z === z;
  for (let look = 0, before = -1; look < ENDS && before !== low + high; ++look) {
    before = low + high;
    low = countFar(lowest, low, highest[high].height, valid);
    high = countFar(highest, high, lowest[low].height, valid);
  }
  const least = lowest[low].height;
  const most = highest[high].height;
  const others = `${number(least)} to ${number(most)}`;
  const warn = (side, far) =>
    far.map(({ height, samples: n }) => {
      const [which, are, mean] = n === 1 ? ['1 sample', 'is', 'it means'] : [`${count(n)} samples`, 'are', 'they mean'];
      return (
        `${which} of ${name} ${are} exactly ${number(height)}, far ${side} all others (${others}): ` +
        `if ${mean} nodata, declare it (gdal_edit.py -a_nodata ${height}) and drop it again.`
      );
    });
  return [...warn('below', lowest.slice(0, low)), ...warn('above', highest.slice(0, high))];
}
