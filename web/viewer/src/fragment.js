// The state of the page in its address, behind #: a link shows the same picture.
const FLAG = { low: 0, high: 1 };
const ANY = { low: -1e9, high: 1e9 };
const LENGTH = { low: 1e-9, high: 1e9 };
const COUNT = { low: 2, high: 2 ** 24 };
const KEYS = {
  errors: [FLAG],
  image: [FLAG],
  edges: [FLAG],
  smooth: [FLAG],
  both: [FLAG],
  count: [FLAG],
  exaggeration: [{ low: 0.1, high: 10 }],
  azimuth: [{ low: 0, high: 360 }],
  altitude: [{ low: 0, high: 90 }],
  level: [{ low: 0, high: 1000 }],
  error: [LENGTH],
  samples: [COUNT, COUNT],
  view: [ANY, { low: -90, high: 90 }, LENGTH, ANY, ANY, ANY],
};

/** Parses the numbers of a key, each within its range; else null. */
function parse(text, ranges) {
  const words = text.split(',');
  const numbers = words.map(Number);
  const areRight =
    words.length === ranges.length &&
    ranges.every(({ low, high }, k) => words[k].trim() !== '' && numbers[k] >= low && numbers[k] <= high);
  return !areRight ? null : numbers.length > 1 ? numbers : numbers[0];
}

export function readFragment() {
  const state = {};
  for (const [key, text] of new URLSearchParams(location.hash.slice(1))) {
    const value = Object.hasOwn(KEYS, key) ? parse(text, KEYS[key]) : null;
    if (value !== null) state[key] = value;
  }
  return state;
}

let timer = 0;
/** Not for each frame of a rotation, which browsers refuse; nor within a notebook, where the page has no address. */
export function writeFragment(makeState) {
  if (location.protocol === 'about:') return;
  clearTimeout(timer);
  timer = setTimeout(() => {
    const words = Object.entries(makeState()).map(
      ([key, value]) =>
        `${key}=${[]
          .concat(value)
          .map(part => Number(part.toPrecision(5)))
          .join(',')}`,
    );
    history.replaceState(null, '', `#${words.join('&')}`);
  }, 300);
}
