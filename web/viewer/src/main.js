// The page: what is shown, and how its controls change that.
import { read_inline } from './document.js';
import { accept_drops, begin } from './drop.js';
import { read_fragment, write_fragment } from './fragment.js';
import { listen_to_keys } from './keys.js';
import { Live } from './live.js';
import { Measuring } from './measuring.js';
import { draw_bar, draw_compass, draw_legend, draw_map } from './overlay.js';
import { command_notes, command_of } from './command.js';
import { save, save_mesh } from './downloads.js';
import { fill_readout, summarize } from './readout.js';
import { Scene } from './scene.js';
import { Sentence } from './sentence.js';
import { number } from './words.js';

const $ = id => document.getElementById(id);

/** Controls that need a mesh. */
const CONTROLS = '#controls :is(input, select, button):not(#file, #full, #help)';

/** A card in the middle, red if it reports an error; none for no words. */
function say(text, is_error = false) {
  $('notice').textContent = text;
  $('notice').classList.toggle('error', is_error);
  $('notice').hidden = !text;
}

function complain(error) {
  if (!(error instanceof Sentence)) console.error(error);
  say(error instanceof Sentence ? error.message : `This page failed: ${error.message}`, true);
}

class Page {
  constructor() {
    this.look = { errors: false, image: false, edges: false, smooth: false, exaggeration: 1, sun: { azimuth: 315, altitude: 40 }, scale: 1, divider: 0.5, covered: () => $('panel').getBoundingClientRect() };
    this.scene = new Scene($('canvas'), this.look);
    this.measuring = new Measuring(this.scene);
    this.live = new Live(this);
    this.scene.on_draw(() => this.draw_overlay());
    this.wire();
    listen_to_keys(this);
    accept_drops(this);
    Object.assign(this, { say, complain });
    for (const control of document.querySelectorAll(CONTROLS)) control.disabled = true;
  }

  /** Shows another document; `state` as in the address. */
  open(document_, state = {}) {
    for (const control of this.document ? [] : document.querySelectorAll(CONTROLS)) control.disabled = false;
    this.document = document_;
    this.level = Math.min(Math.trunc(state.level ?? 0), document_.levels.length - 1);
    $('name').textContent = document.title = document_.name;
    $('level').max = String(document_.levels.length - 1);
    $('level-row').hidden = document_.levels.length < 2;
    $('errors').disabled = !document_.field;
    this.look.errors = Boolean(state.errors) && Boolean(document_.field);
    this.has_image = document_.levels.some(terrain => terrain.has_image);
    $('image-choice').hidden = !this.has_image;
    this.look.image = Boolean(state.image ?? true) && this.has_image;
    for (const name of ['edges', 'smooth']) this.look[name] = Boolean(state[name] ?? this.look[name]);
    this.look.exaggeration = state.exaggeration ?? (document_.knows_metres ? 1 : document_.place.low_exaggeration);
    this.look.sun = { azimuth: state.azimuth ?? 315, altitude: state.altitude ?? 40 };
    this.measuring.clear();
    this.live.open(document_);
    this.show([document_.levels[this.level]]);
    this.scene.is_for_two = Boolean(state.view && state.both) && this.live.is_usable;
    if (state.view) {
      const [azimuth, altitude, distance, ...target] = state.view;
      this.scene.set_orbit({ azimuth, altitude, distance, target });
    } else {
      this.scene.reset();
    }
    this.live.begin(state);
  }

  /** One mesh, or two side by side. */
  show(terrains) {
    this.shown = terrains;
    this.scene.show(terrains);
    this.update();
    this.measuring.tell(this);
    for (const terrain of terrains) if (!terrain.is_judged) this.judge(terrain);
  }

  /** Once the picture is there: the worker occupies a processor that a picture drawn by software needs. */
  async judge(terrain) {
    await this.scene.next_picture();
    await terrain.judge();
    if (!this.shown.includes(terrain)) return;
    this.live.hear(terrain);
    this.update(this.look.errors);
  }

  choose_level(level) {
    this.level = Math.max(0, Math.min(this.document.levels.length - 1, level));
    const terrain = this.document.levels[this.level];
    this.live.leave(terrain);
    this.show([terrain]);
  }

  /** The file's mesh again, as it was first seen. */
  reset() {
    if (this.live.step_now !== null) this.choose_level(this.level);
    this.scene.reset();
  }

  /** Makes the controls and the readout agree with the state, and the picture. */
  update(is_drawn = true) {
    const { look, shown, document: { field, unit, levels, place, knows_metres, is_of_tiles } } = this, [terrain] = shown;
    const are_judged = shown.every(({ is_judged }) => is_judged), shows_errors = look.errors && are_judged;
    const colors = look.errors ? 'errors' : look.image ? 'image' : 'relief';
    for (const name of ['relief', 'errors', 'image']) $(name).checked = name === colors;
    for (const name of ['edges', 'smooth']) $(name).checked = look[name];
    $('exaggeration').value = String(Math.round(Math.log10(look.exaggeration) * 100));
    $('exaggeration-text').textContent = look.exaggeration === 1 ? (knows_metres ? '1 (true)' : '1') : `${Number(look.exaggeration.toPrecision(2))} ×`;
    $('azimuth').value = String(look.sun.azimuth);
    $('azimuth-text').textContent = `${look.sun.azimuth}°`;
    $('altitude').value = String(look.sun.altitude);
    $('altitude-text').textContent = `${look.sun.altitude}°`;
    $('level').value = String(this.level);
    $('level-text').textContent = `${this.level + 1} of ${levels.length}`;
    look.scale = field && are_judged ? Math.max(...shown.map(t => t.judged.max_error)) : 1;
    fill_readout($('readout'), terrain, unit, levels.includes(terrain) && levels.length === 1 ? null : terrain.name);
    [$('side-left'), $('side-right')].forEach((line, k) => {
      line.hidden = shown.length < 2;
      if (shown.length > 1) line.textContent = summarize(shown[k], unit);
    });
    $('divider').hidden = shown.length < 2;
    draw_legend({ errors: shows_errors, image: look.image && terrain.has_image, scale: look.scale, low: place.low[2], high: place.high[2], unit });
    $('map').hidden = !shows_errors;
    if (shows_errors && (this.mapped !== terrain || this.mapped_scale !== look.scale)) draw_map(terrain.judged, field, look.scale);
    [this.mapped, this.mapped_scale] = shows_errors ? [terrain, look.scale] : [];
    const notes = [...this.document.notes];
    if (is_of_tiles) notes.push('Tiles side by side on a flat map; heights are those of the tiles. What judges them is scarp tile check SET.');
    else if (!field) notes.push('Without its raster nothing can be judged here: scarp view MESH RASTER.');
    if (!knows_metres) notes.push('The units of x and y are not known: the exaggeration is true if they are those of the heights.');
    if (field && !this.live.is_there) notes.push('This page was built without the engine: the mesh is as in its file.');
    $('notes').textContent = notes.join(' ');
    const saved = shown.at(-1), command = command_of(saved, $('format').value), which = shown.length > 1 ? saved.name : '', command_note = command_notes(saved, $('format').value);
    $('save').textContent = `Download ${which}`.trim();
    $('command').parentElement.hidden = command === null;
    $('command').textContent = command;
    $('command-of').textContent = which && `${which}: `;
    $('command-note').textContent = command_note;
    $('command-note').hidden = !command_note;
    $('decoding-row').hidden = !field?.decoding;
    if (field?.decoding) $('decoding').value = field.decoding;
    $('canvas').setAttribute('aria-label', `Terrain: ${summarize(terrain, unit)}${shows_errors ? `; coloured by error, blue ${number(look.scale)} below to red above` : colors === 'image' ? '; under its image' : ''}${look.smooth ? '; smooth' : ''}`);
    if (is_drawn) this.scene.invalidate();
  }

  change(look) {
    Object.assign(this.look, look);
    this.update();
  }

  draw_overlay() {
    const { scene, look, document: { field } } = this, { azimuth, altitude, distance, target } = scene.orbit();
    draw_compass(azimuth);
    draw_bar(scene.metres_per_pixel(), this.document.knows_metres ? 'm' : 'units');
    this.measuring.draw_marks();
    if (scene.count > 1) {
      const [left] = scene.part(1), width = scene.canvas.clientWidth;
      $('divider').style.left = `${left}px`;
      $('divider').setAttribute('aria-valuenow', String(Math.round(look.divider * 100)));
      $('side-right').style.left = `${left + 20}px`;
      $('side-left').style.left = `${scene.free(0)[0] + 12}px`;
      $('side-left').style.maxWidth = `${left - scene.free(0)[0] - 40}px`;
      $('side-right').style.maxWidth = `${width - left - (innerWidth > 640 ? 90 : 30)}px`;
    }
    write_fragment(() => ({ errors: Number(look.errors), ...(this.has_image ? { image: Number(look.image) } : {}), edges: Number(look.edges), smooth: Number(look.smooth), exaggeration: look.exaggeration, azimuth: look.sun.azimuth, altitude: look.sun.altitude,
      ...(this.level ? { level: this.level } : {}), ...(field ? { samples: [field.cols, field.rows] } : {}), ...this.live.state(), view: [azimuth, altitude, distance, ...target] }));
    this.drawn = (this.drawn ?? 0) + 1;
  }

  async save_picture() {
    save([await this.scene.png()], `${this.document.name.replace(/\.[^.]*$/, '')}.png`);
  }

  wire() {
    const on = (id, event, action) => $(id).addEventListener(event, action);
    for (const name of ['relief', 'errors', 'image']) on(name, 'change', () => this.change({ errors: name === 'errors', image: name === 'image' }));
    for (const name of ['edges', 'smooth']) on(name, 'change', () => this.change({ [name]: $(name).checked }));
    on('exaggeration', 'input', () => this.change({ exaggeration: Number((10 ** ($('exaggeration').value / 100)).toPrecision(2)) }));
    for (const id of ['azimuth', 'altitude']) on(id, 'input', () => this.change({ sun: { ...this.look.sun, [id]: Number($(id).value) } }));
    on('level', 'input', () => this.choose_level(Number($('level').value)));
    on('measure', 'click', () => this.measuring.turn(!this.measuring.is_on));
    on('measured-close', 'click', () => this.measuring.turn(false));
    on('reset', 'click', () => this.reset());
    on('picture', 'click', () => this.save_picture().catch(complain));
    on('format', 'change', () => this.update());
    on('save', 'click', () => save_mesh(this.shown.at(-1), this.document.name, $('format').value));
    on('full', 'click', () => document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
    on('help', 'click', () => $('keys').showModal());
    on('fold', 'click', () => {
      const folded = document.body.classList.toggle('folded');
      $('fold').setAttribute('aria-expanded', String(!folded));
      this.scene.invalidate();
    });
    if (matchMedia('(max-width: 640px)').matches) $('fold').click();
    let pressed = null;
    on('canvas', 'pointerdown', event => { pressed = [event.clientX, event.clientY]; });
    on('canvas', 'pointerup', event => {
      const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4;
      if (still && this.measuring.is_on) this.measuring.click(event.clientX, event.clientY, this);
    });
    const divide = x => this.change({ divider: Math.min(0.95, Math.max(0.05, x)) });
    on('divider', 'pointerdown', event => $('divider').setPointerCapture(event.pointerId));
    on('divider', 'pointermove', event => { if ($('divider').hasPointerCapture(event.pointerId)) divide(event.clientX / innerWidth); });
    on('divider', 'keydown', event => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
      if (!step) return;
      event.stopPropagation();
      divide(this.look.divider + step);
    });
  }
}

async function start() {
  const page = window.scarp_page = new Page();  // before the data are there: the browser compiles meanwhile what draws
  if (document.readyState === 'loading') await new Promise(done => addEventListener('DOMContentLoaded', done));
  const data = $('scarp-data');
  if (!data) return say(HAS_ENGINE ? 'Drop a GeoTIFF, an .hgt file or a PNG tile here, or a GLB. It stays on this machine.'
    : 'This page holds no mesh: scarp view MESH RASTER makes one that does. Or drop a GLB file here.');
  await begin(page, async () => ({ document: await read_inline(JSON.parse(data.textContent)), state: read_fragment() }));
}

addEventListener('error', event => complain(event.error ?? new Error(event.message)));
addEventListener('unhandledrejection', event => complain(event.reason));
/** A frame later than the terrain: the layers over it need as long to paint. */
const show_panel = () => document.body.classList.remove('empty');
start().then(() => requestAnimationFrame(() => setTimeout(show_panel)), error => complain(error) ?? show_panel());
