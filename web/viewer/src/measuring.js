// Measuring: a click selects a point, the next one a line with its profile.
import { distance, number, withUnit } from './words.js';

const $ = id => document.getElementById(id);
const STEPS = 256;

/** Along a line between two positions in the mesh's frame: [share of the length, height of the mesh, of the raster]. */
function sampleLine(terrain, from, to) {
  return Array.from({ length: STEPS + 1 }, (_, k) => {
    const t = k / STEPS;
    const x = from[0] + t * (to[0] - from[0]);
    const y = from[1] + t * (to[1] - from[1]);
    return [t, terrain.heightAt(x, y), terrain.field ? terrain.field.heightAt(x, y) : NaN];
  });
}

function trace(points, toX, toY) {
  let path = '';
  let isDown = false;
  for (const [x, y] of points) {
    if (Number.isFinite(y)) path += `${isDown ? 'L' : 'M'}${toX(x).toFixed(1)} ${toY(y).toFixed(1)}`;
    isDown = Number.isFinite(y);
  }
  return path;
}

export class Measuring {
  constructor(scene) {
    this.scene = scene;
    this.points = [];
    this.isOn = false;
  }

  turn(isOn) {
    this.isOn = isOn;
    $('measure').setAttribute('aria-pressed', String(isOn));
    this.scene.canvas.style.cursor = isOn ? 'crosshair' : '';
    if (!isOn) this.clear();
    else this.say('Click on the terrain for a point, and once more for a line.');
  }

  clear() {
    this.points = [];
    this.line = null;
    $('measured').hidden = true;
    this.drawMarks();
  }

  showProfile(shown) {
    for (const id of ['profile', 'profile-text']) $(id).toggleAttribute('hidden', !shown);
  }

  say(text) {
    $('measured').hidden = false;
    $('measured-text').textContent = text;
    this.showProfile(false);
  }

  /** Measures at a pixel. */
  click(x, y, page) {
    const hit = this.scene.pick(x, y);
    if (!hit) return;
    if (this.points.length > 1) this.points = [];
    const { place } = page.document;
    const [px, py] = place.fromScene(...hit);
    const mesh = page.shown[0].heightAt(px, py);
    this.points.push({ x: px, y: py, z: Number.isFinite(mesh) ? mesh : place.fromScene(...hit)[2] });
    this.tell(page);
  }

  /** Measures again when another mesh is displayed. */
  tell(page) {
    if (!this.points.length) return;
    const terrain = page.shown[0];
    const { unit, place } = page.document;
    const [a, b] = this.points;
    const lengthUnit = page.document.knowsMetres ? 'm' : 'units';
    for (const point of this.points)
      point.z = Number.isFinite(terrain.heightAt(point.x, point.y)) ? terrain.heightAt(point.x, point.y) : point.z;
    if (!b) {
      const sample = terrain.field ? terrain.field.heightAt(a.x, a.y) : NaN;
      this.line = null;
      this.say(
        `Height ${withUnit(a.z, unit)}` +
          (Number.isFinite(sample)
            ? `, raster ${withUnit(sample, unit)}, mesh minus raster ${withUnit(a.z - sample, unit)}`
            : '') +
          `, at x ${number(a.x)}, y ${number(a.y)}.`,
      );
    } else {
      const from = place.toScene(a.x, a.y, a.z);
      const to = place.toScene(b.x, b.y, b.z);
      const run = Math.hypot(to[0] - from[0], to[1] - from[1]);
      const rise = to[2] - from[2];
      const straight = distance(Math.hypot(run, rise), lengthUnit);
      const slope = Number(((Math.atan2(rise, run) * 180) / Math.PI).toPrecision(3));
      this.say(
        `Distance ${distance(run, lengthUnit)} on the map, ${straight} straight; ` +
          `height difference ${withUnit(b.z - a.z, unit)}; slope ${slope}°.`,
      );
      this.drawProfile(sampleLine(terrain, [a.x, a.y], [b.x, b.y]), [a, b], place, run, unit, lengthUnit);
    }
    this.drawMarks();
  }

  drawProfile(line, [a, b], place, run, unit, lengthUnit) {
    const heights = line.flatMap(([, mesh, raster]) => [mesh, raster]).filter(Number.isFinite);
    const low = Math.min(...heights);
    const high = Math.max(...heights, low + 1e-9);
    const toY = z => 134 - ((z - low) / (high - low)) * 128;
    const toX = t => 600 * t;
    const path = (name, k) => {
      const points = line.map(point => [point[0], point[k]]);
      return `<path class="${name}" d="${trace(points, toX, toY)}"/>`;
    };
    $('profile').innerHTML = path('raster', 2) + path('mesh', 1);
    $('profile').setAttribute(
      'aria-label',
      `Profile of ${distance(run, lengthUnit)}, heights ${number(low)} to ${withUnit(high, unit)}`,
    );
    $('profile-range').textContent =
      `heights ${number(low)} to ${withUnit(high, unit)} over ${distance(run, lengthUnit)}`;
    document.querySelector('#profile-text .of-raster').hidden = !line.some(([, , raster]) => Number.isFinite(raster));
    this.showProfile(true);
    this.line = line.map(([t, mesh]) => place.toScene(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), mesh));
  }

  drawMarks() {
    let marks = '';
    for (let k = 0; k < this.scene.count; ++k) {
      if (this.line) {
        const points = this.line.map(point => (Number.isFinite(point[2]) ? this.scene.project(point, k) : null));
        const path = trace(
          points.map(at => at ?? [0, NaN]),
          x => x,
          y => y,
        );
        marks += `<path d="${path}"/><path class="top" d="${path}"/>`;
      }
      for (const { x, y, z } of this.points) {
        const at = this.scene.project(this.scene.views[0].terrain.place.toScene(x, y, z), k);
        if (at) marks += `<circle cx="${at[0].toFixed(1)}" cy="${at[1].toFixed(1)}" r="5"/>`;
      }
    }
    document.getElementById('marks').innerHTML = marks;
  }
}
