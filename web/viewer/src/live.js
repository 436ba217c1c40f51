// The engine in the background: meshes for the slider's max error, and side by side. Without it there are no controls.
import SOURCE from 'worker-source';
import { watchLock } from './alive.js';
import { terrain_of_engine } from './document.js';
import { Sentence } from './sentence.js';
import { with_unit } from './words.js';

const $ = id => document.getElementById(id);
const STEPS_AN_OCTAVE = 8;

/** Four digits, so that an error can be printed, and asked for again. */
const tidy = error => Number(error.toPrecision(4));

/** A worker that holds the raster and answers one question at a time; of those that wait, the latest. */
class Helper {
  constructor(field) {
    this.field = field;
  }

  start() {
    const worker = new Worker(this.address ??= URL.createObjectURL(new Blob([SOURCE], { type: 'text/javascript' })));
    const lose = why => {
      if (worker !== this.worker) return;
      worker.terminate();
      this.worker = null;
      this.settle({ error: `the engine's worker ended (${why})` });
    };
    worker.onmessage = ({ data }) => {
      if (data.lock === undefined) this.settle(data);
      else if (data.lock) watchLock(data.lock, () => lose('the browser stopped it, most likely for lack of memory'));
    };
    worker.onerror = event => {
      event.preventDefault();
      lose(event.message || 'it was stopped');
    };
    this.worker = worker;
    const { samples, cols, rows, affine } = this.field;
    this.worker.postMessage({ field: { samples, cols, rows, affine } });
  }

  ask(question, answer) {
    if (this.busy) {
      this.next = [question, answer];
      return;
    }
    if (!this.worker) this.start();
    this.busy = answer;
    this.worker.postMessage(question);
  }

  settle(data) {
    const { busy, next } = this;
    this.busy = this.next = null;
    if (next) this.ask(...next);
    busy?.(data, Boolean(next));
  }

  /** A worker in the middle of a computation hears nothing: it is ended, and a new one begins with the next question. */
  cancel() {
    if (this.busy) this.end();
  }

  end() {
    this.worker?.terminate();
    this.worker = this.busy = this.next = null;
  }
}

export class Live {
  constructor(page) {
    this.page = page;
    this.is_there = SOURCE !== '';
    this.meshes = new Map();
    $('error').addEventListener('input', () => this.choose(Number($('error').value)));
    $('error').addEventListener('change', () => this.finish());
    $('both').addEventListener('change', () => this.turn_both($('both').checked));
    $('same').addEventListener('change', () => this.both && this.finish());
  }

  get is_usable() {
    return this.is_there && Boolean(this.page.document?.field);
  }

  open(document) {
    for (const helper of [this.quick, this.slow]) helper?.end();
    this.meshes.clear();
    this.both = false;
    this.step_now = null;
    $('slider-row').hidden = $('both-row').hidden = !this.is_usable;
    this.label(null);
    if (!this.is_usable) return;
    const { field, unit } = document, relief = Math.max(field.high - field.low, 1e-9);
    this.quick = new Helper(field);
    this.slow = new Helper(field);
    this.largest = relief / 2;
    this.most = Math.ceil(12 * STEPS_AN_OCTAVE);
    this.unit = unit;
    $('error').max = String(this.most);
  }

  /** Begins with the settings of the address. If it names no error the slider stands at that of the mesh, once it is
   * known. */
  begin({ error, both, count }) {
    if (!this.is_usable) return;
    const first = error ?? this.page.document.levels[0].goal?.maxError;
    $('same').value = count ? 'count' : 'error';
    this.hears = () => {
      this.hears = null;
      this.follow(first ?? this.page.shown[0].judged.max_error);
      if (both) this.turn_both(true);
      else if (error !== undefined) this.choose(this.step_of(error)), this.finish();
    };
    if (first !== undefined || this.page.shown[0].is_judged) this.hears();
  }

  /** A mesh of the file has been judged. */
  hear(terrain) {
    if (!this.is_usable || this.step_now !== null) return;
    if (this.hears) this.hears();
    else this.follow(terrain.judged.max_error);
  }

  /** The first mesh of a raster, for a max error of that share of the relief: {mesh, judged, goal}. */
  make_first(field, share) {
    const helper = this.first = new Helper(field), goal = { maxError: tidy((field.high - field.low) * share) };
    return new Promise((done, failed) => helper.ask({ kind: 'finish', goal, effort: 'fast', order: 'greedy' }, answer => {
      helper.end();
      if (answer.error) failed(new Sentence(`${field.name}: ${answer.error}`));
      else done({ ...answer, goal });
    }));
  }

  /** For what another opening overtakes. */
  cancel_first() {
    this.first?.settle({ error: 'another file was opened' });
    this.first = null;
  }

  error_of(step) {
    return tidy(this.largest / 2 ** (step / STEPS_AN_OCTAVE));
  }

  step_of(error) {
    return Math.max(0, Math.min(this.most, Math.round(Math.log2(this.largest / Math.max(error, 1e-12)) * STEPS_AN_OCTAVE)));
  }

  /** The slider stands at the error of what is shown. */
  follow(error) {
    $('error').value = String(this.step_of(error));
    this.label(error);
  }

  label(error) {
    $('error-text').textContent = error === null ? '…' : with_unit(error, this.unit);
    $('error').setAttribute('aria-valuetext', $('error-text').textContent);
  }

  say(text) {
    $('progress').textContent = text;
    $('progress').hidden = !text;
  }

  state() {
    return this.step_now === null ? {} : { error: this.error_of(this.step_now), ...(this.both ? { both: 1, count: Number($('same').value === 'count') } : {}) };
  }

  /** For a mesh of the file. */
  leave(terrain) {
    if (this.is_usable && terrain.is_judged) this.follow(terrain.judged.max_error);
    this.slow?.cancel();
    this.say('');
    this.step_now = null;
    this.both = $('both').checked = false;
  }

  /** Positive: a larger error, or the next level where there is no engine. */
  step(by) {
    if (!this.is_usable) return this.page.choose_level(this.page.level + by);
    this.choose(Math.max(0, Math.min(this.most, Number($('error').value) - by)));
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.finish(), 400);
  }

  toggle_both() {
    if (this.is_usable) this.turn_both(!this.both);
  }

  turn_both(both) {
    this.both = both;
    $('both').checked = both;
    if (both) return this.choose(this.step_now ?? Number($('error').value)), this.finish();
    this.slow.cancel();
    this.show();
  }

  /** A mesh of this error at once, by the engine that inserts the worst sample: the program's greedy mesh, but where x and y are no offsets that float32 holds. */
  choose(step) {
    this.step_now = step;
    $('error').value = String(step);
    const error = this.error_of(step);
    this.label(error);
    this.slow.cancel();
    this.say('');
    const key = `greedy ${step}`;
    if (this.meshes.has(key)) return this.show();
    const goal = ['local', 'grid'].includes(this.page.document.levels[0].extras.crs_option) ? { maxError: error } : null;
    this.quick.ask({ kind: 'refine', error }, answer => {
      if (!this.take(answer, key, 'greedy', goal) || step !== this.step_now) return;
      this.show();
      if (this.wants_finish) this.finish();
    });
  }

  take({ error, mesh, judged }, key, name, goal) {
    if (error) {
      this.say(`No mesh: ${error}`);
      return false;
    }
    const { field, place, levels } = this.page.document;
    this.meshes.set(key, terrain_of_engine(name, mesh, { judged, goal, extras: levels[0].extras }, field, place, levels[0]));
    return true;
  }

  keys() {
    const greedy = `greedy ${this.step_now}`;
    return [greedy, this.both && $('same').value === 'count' ? `high, same triangles as ${greedy}` : `high ${this.step_now}`];
  }

  /** Effort high, in the background. */
  finish() {
    if (this.step_now === null) return;
    const [greedy, high] = this.keys(), step = this.step_now;
    this.wants_finish = !this.meshes.has(greedy);
    if (this.wants_finish) return;
    if (this.meshes.has(high)) return this.show();
    this.say('Preview; effort high is at work …');
    this.show();
    const goal = this.both && $('same').value === 'count' ? { maxTriangles: this.meshes.get(greedy).triangles } : { maxError: this.error_of(step) };
    this.slow.cancel();
    this.slow.ask({ kind: 'finish', goal, effort: 'high' }, answer => {
      if (!this.take(answer, high, 'high', goal) || this.keys()[1] !== high) return;
      this.say('');
      this.show();
    });
  }

  show() {
    if (this.step_now === null) return;
    const [greedy, high] = this.keys().map(key => this.meshes.get(key));
    if (this.both && greedy) this.page.show([greedy, high ?? greedy]);
    else if (high ?? greedy) this.page.show([high ?? greedy]);
  }
}
