// The state of the page in its address, behind #: a link shows the same picture.
const KEYS = ['errors', 'image', 'edges', 'smooth', 'exaggeration', 'azimuth', 'altitude', 'view', 'level', 'error', 'both', 'count'];

export function read_fragment() {
  const state = {};
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    if (!KEYS.includes(key)) continue;
    const numbers = value.split(',').map(Number);
    if (numbers.every(Number.isFinite)) state[key] = numbers.length > 1 ? numbers : numbers[0];
  }
  return state;
}

let timer = 0;
/** Not at each picture while one turns it: browsers refuse that; nor within a notebook, where the page has no address. */
export function write_fragment(make_state) {
  if (location.protocol === 'about:') return;
  clearTimeout(timer);
  timer = setTimeout(() => {
    const words = Object.entries(make_state()).map(([key, value]) => `${key}=${[].concat(value).map(part => Number(part.toPrecision(5))).join(',')}`);
    history.replaceState(null, '', `#${words.join('&')}`);
  }, 300);
}
