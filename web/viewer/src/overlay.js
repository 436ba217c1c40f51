// The layers over the picture: north, scale bar, the legend of the colours, errors from above.
import { distance, number, withUnit } from './words.js';

const $ = id => document.getElementById(id);
const RELIEF = 'linear-gradient(90deg, rgb(92 120 89), rgb(168 161 120) 35%, rgb(158 140 125) 70%, rgb(247 247 250))';
const ERRORS = 'linear-gradient(90deg, rgb(33 102 171), rgb(242 242 242), rgb(178 23 43))';

export function drawCompass(azimuth) {
  $('needle').setAttribute('transform', `rotate(${-azimuth} 20 20)`);
}

/** A length of 1, 2 or 5 times a power of ten, at most 120 pixels wide. */
export function drawBar(metresPerPixel, unit) {
  const most = metresPerPixel * 120;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map(k => k * power).find(value => value <= most) ?? power;
  $('bar-line').style.width = `${length / metresPerPixel}px`;
  $('bar-text').textContent = distance(length, unit);
  $('bar').hidden = false;
}

export function drawLegend({ errors, image, scale, low, high, unit }) {
  $('legend').hidden = image && !errors;
  $('legend-bar').style.background = errors ? ERRORS : RELIEF;
  const end = Number(scale.toPrecision(3));
  const words = errors
    ? [end ? `−${end} below` : '', '0', end ? `+${withUnit(end, unit)} above` : '']
    : [number(low), '', withUnit(high, unit)];
  [...$('legend-text').children].forEach((span, k) => {
    span.textContent = words[k];
  });
}

const MOST_PIXELS = 512;
/** Blue below, red above, grey where no triangle covers a sample; a pixel shows the worst of its samples. */
export function drawMap(judged, field, scale) {
  const canvas = $('map');
  const step = Math.ceil(Math.max(field.cols, field.rows) / MOST_PIXELS);
  const width = Math.ceil(field.cols / step);
  const height = Math.ceil(field.rows / step);
  canvas.width = width;
  canvas.height = height;
  const picture = new ImageData(width, height);
  const worst = new Float32Array(width * height).fill(NaN);
  for (let row = 0, k = 0; row < field.rows; ++row) {
    for (let col = 0; col < field.cols; ++col, ++k) {
      const at = Math.floor(row / step) * width + Math.floor(col / step);
      const error = judged.errors[k];
      if (
        error === error
          ? !(Math.abs(error) <= Math.abs(worst[at])) && worst[at] !== Infinity
          : field.samples[k] === field.samples[k]
      )
        worst[at] = error === error ? error : Infinity;
    }
  }
  worst.forEach((error, at) => {
    const t = Math.min(1, Math.abs(error) / (scale || 1));
    const end = error < 0 ? [33, 102, 171] : [178, 23, 43];
    const color =
      error === Infinity ? [140, 140, 140] : error === error ? end.map(c => 242 + (c - 242) * t) : [0, 0, 0];
    picture.data.set([...color, error === error ? 255 : 0], 4 * at);
  });
  canvas.getContext('2d').putImageData(picture, 0, 0);
}
