// The page: its contents, and the effects of its controls.
import { readInline } from './document.js';
import { acceptDrops, begin } from './drop.js';
import { readFragment, writeFragment } from './fragment.js';
import { listenToKeys } from './keys.js';
import { Live } from './live.js';
import { Measuring } from './measuring.js';
import { drawBar, drawCompass } from './overlay.js';
import { save, saveMesh } from './downloads.js';
import { fillPanel } from './panel.js';
import { Scene } from './scene.js';
import { Sentence } from './sentence.js';

const $ = id => document.getElementById(id);

/** Controls that need a mesh. */
const CONTROLS = '#controls :is(input, select, button):not(#file, #full, #help)';

/** A card in the middle, red if it reports an error; hidden without text. */
function say(text, isError = false) {
  $('notice').textContent = text;
  $('notice').classList.toggle('error', isError);
  $('notice').hidden = !text;
}

function complain(error) {
  if (!(error instanceof Sentence)) console.error(error);
  say(error instanceof Sentence ? error.message : `This page failed: ${error.message}`, true);
}

class Page {
  constructor() {
    this.look = {
      errors: false,
      image: false,
      edges: false,
      smooth: false,
      exaggeration: 1,
      sun: { azimuth: 315, altitude: 40 },
      scale: 1,
      divider: 0.5,
      covered: () => $('panel').getBoundingClientRect(),
    };
    this.scene = new Scene($('canvas'), this.look);
    this.measuring = new Measuring(this.scene);
    this.live = new Live(this);
    this.scene.onDraw(() => this.drawOverlay());
    this.wire();
    listenToKeys(this);
    acceptDrops(this);
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
    this.hasImage = document_.levels.some(terrain => terrain.hasImage);
    $('image-choice').hidden = !this.hasImage;
    this.look.image = Boolean(state.image ?? true) && this.hasImage;
    for (const name of ['edges', 'smooth']) this.look[name] = Boolean(state[name] ?? this.look[name]);
    this.look.exaggeration = state.exaggeration ?? (document_.knowsMetres ? 1 : document_.place.lowExaggeration);
    this.look.sun = { azimuth: state.azimuth ?? 315, altitude: state.altitude ?? 40 };
    this.measuring.clear();
    this.live.open(document_);
    this.show([document_.levels[this.level]]);
    this.scene.isForTwo = Boolean(state.view && state.both) && this.live.isUsable;
    if (state.view) {
      const [azimuth, altitude, distance, ...target] = state.view;
      this.scene.setOrbit({ azimuth, altitude, distance, target });
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
    for (const terrain of terrains) if (!terrain.isJudged) this.judge(terrain);
  }

  /** After the picture is drawn, since the worker occupies a processor that drawing by software needs. */
  async judge(terrain) {
    await this.scene.nextPicture();
    await terrain.judge();
    if (!this.shown.includes(terrain)) return;
    this.live.hear(terrain);
    this.update(this.look.errors);
  }

  chooseLevel(level) {
    this.level = Math.max(0, Math.min(this.document.levels.length - 1, level));
    const terrain = this.document.levels[this.level];
    this.live.leave(terrain);
    this.show([terrain]);
  }

  /** Shows the file's mesh again, in the initial view. */
  reset() {
    if (this.live.stepNow !== null) this.chooseLevel(this.level);
    this.scene.reset();
  }

  /** Updates the controls, the readout and the picture to the state. */
  update(isDrawn = true) {
    fillPanel(this);
    if (isDrawn) this.scene.invalidate();
  }

  change(look) {
    Object.assign(this.look, look);
    this.update();
  }

  drawOverlay() {
    const {
      scene,
      look,
      document: { field },
    } = this;
    const { azimuth, altitude, distance, target } = scene.orbit();
    drawCompass(azimuth);
    drawBar(scene.metresPerPixel(), this.document.knowsMetres ? 'm' : 'units');
    this.measuring.drawMarks();
    if (scene.count > 1) {
      const [left] = scene.part(1);
      const width = scene.canvas.clientWidth;
      $('divider').style.left = `${left}px`;
      $('divider').setAttribute('aria-valuenow', String(Math.round(look.divider * 100)));
      $('side-right').style.left = `${left + 20}px`;
      $('side-left').style.left = `${scene.free(0)[0] + 12}px`;
      $('side-left').style.maxWidth = `${left - scene.free(0)[0] - 40}px`;
      $('side-right').style.maxWidth = `${width - left - (innerWidth > 640 ? 90 : 30)}px`;
    }
    writeFragment(() => ({
      errors: Number(look.errors),
      ...(this.hasImage ? { image: Number(look.image) } : {}),
      edges: Number(look.edges),
      smooth: Number(look.smooth),
      exaggeration: look.exaggeration,
      azimuth: look.sun.azimuth,
      altitude: look.sun.altitude,
      ...(this.level ? { level: this.level } : {}),
      ...(field ? { samples: [field.cols, field.rows] } : {}),
      ...this.live.state(),
      view: [azimuth, altitude, distance, ...target],
    }));
    this.drawn = (this.drawn ?? 0) + 1;
  }

  async savePicture() {
    save([await this.scene.png()], `${this.document.name.replace(/\.[^.]*$/, '')}.png`);
  }

  wire() {
    const on = (id, event, action) => $(id).addEventListener(event, action);
    for (const name of ['relief', 'errors', 'image'])
      on(name, 'change', () => this.change({ errors: name === 'errors', image: name === 'image' }));
    for (const name of ['edges', 'smooth']) on(name, 'change', () => this.change({ [name]: $(name).checked }));
    on('exaggeration', 'input', () =>
      this.change({ exaggeration: Number((10 ** ($('exaggeration').value / 100)).toPrecision(2)) }),
    );
    for (const id of ['azimuth', 'altitude'])
      on(id, 'input', () => this.change({ sun: { ...this.look.sun, [id]: Number($(id).value) } }));
    on('level', 'input', () => this.chooseLevel(Number($('level').value)));
    on('measure', 'click', () => this.measuring.turn(!this.measuring.isOn));
    on('measured-close', 'click', () => this.measuring.turn(false));
    on('reset', 'click', () => this.reset());
    on('picture', 'click', () => this.savePicture().catch(complain));
    on('format', 'change', () => this.update());
    on('save', 'click', () => saveMesh(this.shown.at(-1), this.document.name, $('format').value));
    on('full', 'click', () =>
      document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen(),
    );
    on('help', 'click', () => $('keys').showModal());
    on('fold', 'click', () => {
      const folded = document.body.classList.toggle('folded');
      $('fold').setAttribute('aria-expanded', String(!folded));
      this.scene.invalidate();
    });
    if (matchMedia('(max-width: 640px)').matches) $('fold').click();
    let pressed = null;
    on('canvas', 'pointerdown', event => {
      pressed = [event.clientX, event.clientY];
    });
    on('canvas', 'pointerup', event => {
      const still = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4;
      if (still && this.measuring.isOn) this.measuring.click(event.clientX, event.clientY, this);
    });
    const divide = x => this.change({ divider: Math.min(0.95, Math.max(0.05, x)) });
    on('divider', 'pointerdown', event => $('divider').setPointerCapture(event.pointerId));
    on('divider', 'pointermove', event => {
      if ($('divider').hasPointerCapture(event.pointerId)) divide(event.clientX / innerWidth);
    });
    on('divider', 'keydown', event => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
      if (!step) return;
      event.stopPropagation();
      divide(this.look.divider + step);
    });
  }
}

async function start() {
  // Before the data arrive: the browser compiles the shaders meanwhile.
  const page = (window.scarpPage = new Page());
  if (document.readyState === 'loading') await new Promise(done => addEventListener('DOMContentLoaded', done));
  const data = $('scarp-data');
  if (!data)
    return say(
      HAS_ENGINE
        ? 'Drop a GeoTIFF, an .hgt file or a PNG tile here, or a GLB. It stays on this machine.'
        : 'This page holds no mesh: scarp view MESH RASTER makes one that does. Or drop a GLB file here.',
    );
  await begin(page, async () => ({ document: await readInline(JSON.parse(data.textContent)), state: readFragment() }));
}

addEventListener('error', event => complain(event.error ?? new Error(event.message)));
addEventListener('unhandledrejection', event => complain(event.reason));
/** A frame later than the terrain, since the layers over it need as long to draw. */
const showPanel = () => document.body.classList.remove('empty');
start().then(
  () => requestAnimationFrame(() => setTimeout(showPanel)),
  error => complain(error) ?? showPanel(),
);
