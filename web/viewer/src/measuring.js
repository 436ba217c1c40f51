// Measuring: a click asks for a point, the next for a line with its profile.
import { distance, number, with_unit } from './words.js';

const $ = id => document.getElementById(id);
const STEPS = 256;

/** Along a line between two places of the mesh's frame: [share of the way, height of the mesh, of the raster]. */
function sample_line(terrain, from, to) {
  return Array.from({ length: STEPS + 1 }, (_, k) => {
    const t = k / STEPS, x = from[0] + t * (to[0] - from[0]), y = from[1] + t * (to[1] - from[1]);
    return [t, terrain.height_at(x, y), terrain.field ? terrain.field.height_at(x, y) : NaN];
  });
}

function trace(points, to_x, to_y) {
  let path = '', is_down = false;
  for (const [x, y] of points) {
    if (Number.isFinite(y)) path += `${is_down ? 'L' : 'M'}${to_x(x).toFixed(1)} ${to_y(y).toFixed(1)}`;
    is_down = Number.isFinite(y);
  }
  return path;
}

export class Measuring {
  constructor(scene) {
    this.scene = scene;
    this.points = [];
    this.is_on = false;
  }

  turn(is_on) {
    this.is_on = is_on;
    $('measure').setAttribute('aria-pressed', String(is_on));
    this.scene.canvas.style.cursor = is_on ? 'crosshair' : '';
    if (!is_on) this.clear();
    else this.say('Click on the terrain for a point, and once more for a line.');
  }

  clear() {
    this.points = [];
    this.line = null;
    $('measured').hidden = true;
    this.draw_marks();
  }

  show_profile(shown) {
    for (const id of ['profile', 'profile-text']) $(id).toggleAttribute('hidden', !shown);
  }

  say(text) {
    $('measured').hidden = false;
    $('measured-text').textContent = text;
    this.show_profile(false);
  }

  /** A pixel of the picture. */
  click(x, y, page) {
    const hit = this.scene.pick(x, y);
    if (!hit) return;
    if (this.points.length > 1) this.points = [];
    const { place } = page.document, [px, py] = place.from_scene(...hit), mesh = page.shown[0].height_at(px, py);
    this.points.push({ x: px, y: py, z: Number.isFinite(mesh) ? mesh : place.from_scene(...hit)[2] });
    this.tell(page);
  }

  /** Again, when another mesh is shown. */
  tell(page) {
    if (!this.points.length) return;
    const terrain = page.shown[0], { unit, place } = page.document, [a, b] = this.points, length_unit = page.document.knows_metres ? 'm' : 'units';
    for (const point of this.points) point.z = Number.isFinite(terrain.height_at(point.x, point.y)) ? terrain.height_at(point.x, point.y) : point.z;
    if (!b) {
      const sample = terrain.field ? terrain.field.height_at(a.x, a.y) : NaN;
      this.line = null;
      this.say(`Height ${with_unit(a.z, unit)}` + (Number.isFinite(sample) ? `, raster ${with_unit(sample, unit)}, mesh minus raster ${with_unit(a.z - sample, unit)}` : '') + `, at x ${number(a.x)}, y ${number(a.y)}.`);
    } else {
      const from = place.to_scene(a.x, a.y, a.z), to = place.to_scene(b.x, b.y, b.z), run = Math.hypot(to[0] - from[0], to[1] - from[1]), rise = to[2] - from[2];
      this.say(`Distance ${distance(run, length_unit)} on the map, ${distance(Math.hypot(run, rise), length_unit)} straight; height difference ${with_unit(b.z - a.z, unit)}; slope ${Number((Math.atan2(rise, run) * 180 / Math.PI).toPrecision(3))}°.`);
      this.draw_profile(sample_line(terrain, [a.x, a.y], [b.x, b.y]), [a, b], place, run, unit, length_unit);
    }
    this.draw_marks();
  }

  draw_profile(line, [a, b], place, run, unit, length_unit) {
    const heights = line.flatMap(([, mesh, raster]) => [mesh, raster]).filter(Number.isFinite);
    const low = Math.min(...heights), high = Math.max(...heights, low + 1e-9), to_y = z => 134 - (z - low) / (high - low) * 128, to_x = t => 600 * t;
    const path = (name, k) => `<path class="${name}" d="${trace(line.map(point => [point[0], point[k]]), to_x, to_y)}"/>`;
    $('profile').innerHTML = path('raster', 2) + path('mesh', 1);
    $('profile').setAttribute('aria-label', `Profile of ${distance(run, length_unit)}, heights ${number(low)} to ${with_unit(high, unit)}`);
    $('profile-range').textContent = `heights ${number(low)} to ${with_unit(high, unit)} over ${distance(run, length_unit)}`;
    document.querySelector('#profile-text .of-raster').hidden = !line.some(([, , raster]) => Number.isFinite(raster));
    this.show_profile(true);
    this.line = line.map(([t, mesh]) => place.to_scene(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), mesh));
  }

  draw_marks() {
    let marks = '';
    for (let k = 0; k < this.scene.count; ++k) {
      if (this.line) {
        const points = this.line.map(point => Number.isFinite(point[2]) ? this.scene.project(point, k) : null);
        const path = trace(points.map(at => at ?? [0, NaN]), x => x, y => y);
        marks += `<path d="${path}"/><path class="top" d="${path}"/>`;
      }
      for (const { x, y, z } of this.points) {
        const at = this.scene.project(this.scene.views[0].terrain.place.to_scene(x, y, z), k);
        if (at) marks += `<circle cx="${at[0].toFixed(1)}" cy="${at[1].toFixed(1)}" r="5"/>`;
      }
    }
    document.getElementById('marks').innerHTML = marks;
  }
}
