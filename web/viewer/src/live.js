// The engine in the background: meshes for the slider's max error, and for the view side by side. Its controls are
// hidden without it.
import SOURCE from 'worker-source';
import { watchLock } from './alive.js';
import { terrainOfEngine } from './document.js';
import { Sentence } from './sentence.js';
import { withUnit } from './words.js';

const $ = id => document.getElementById(id);
const STEPS_AN_OCTAVE = 8;

/** Rounds to four digits, so that a printed error can be requested again. */
const tidy = error => Number(error.toPrecision(4));

/** A worker that holds the raster and answers one request at a time; of waiting requests, the latest. */
class Helper {
  constructor(field) {
    this.field = field;
  }

  start() {
    const worker = new Worker((this.address ??= URL.createObjectURL(new Blob([SOURCE], { type: 'text/javascript' }))));
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

  /** A computing worker receives no messages: it is terminated, and a new one starts with the next request. */
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
    this.isThere = SOURCE !== '';
    this.meshes = new Map();
    $('error').addEventListener('input', () => this.choose(Number($('error').value)));
    $('error').addEventListener('change', () => this.finish());
    $('both').addEventListener('change', () => this.turnBoth($('both').checked));
    $('same').addEventListener('change', () => this.both && this.finish());
  }

  get isUsable() {
    return this.isThere && Boolean(this.page.document?.field);
  }

  open(document) {
    for (const helper of [this.quick, this.slow]) helper?.end();
    this.meshes.clear();
    this.both = false;
    this.stepNow = null;
    $('slider-row').hidden = $('both-row').hidden = !this.isUsable;
    this.label(null);
    if (!this.isUsable) return;
    const { field, unit } = document;
    const relief = Math.max(field.high - field.low, 1e-9);
    this.quick = new Helper(field);
    this.slow = new Helper(field);
    this.largest = relief / 2;
    this.most = Math.ceil(12 * STEPS_AN_OCTAVE);
    this.unit = unit;
    $('error').max = String(this.most);
  }

  /** Begins with the settings of the address. Without an error there, the slider is set to that of the mesh, once
   * known. */
  begin({ error, both, count }) {
    if (!this.isUsable) return;
    const first = error ?? this.page.document.levels[0].goal?.maxError;
    $('same').value = count ? 'count' : 'error';
    this.hears = () => {
      this.hears = null;
      this.follow(first ?? this.page.shown[0].judged.maxError);
      if (both) this.turnBoth(true);
      else if (error !== undefined) this.chooseAndFinish(this.stepOf(error));
    };
    if (first !== undefined || this.page.shown[0].isJudged) this.hears();
  }

  /** A mesh of the file has been judged. */
  hear(terrain) {
    if (!this.isUsable || this.stepNow !== null) return;
    if (this.hears) this.hears();
    else this.follow(terrain.judged.maxError);
  }

  /** The first mesh of a raster, for a max error of this share of the relief: {mesh, judged, goal}. */
  makeFirst(field, share) {
    const helper = (this.first = new Helper(field));
    const goal = { maxError: tidy((field.high - field.low) * share) };
    return new Promise((done, failed) =>
      helper.ask({ kind: 'finish', goal, effort: 'fast', order: 'greedy' }, answer => {
        helper.end();
        if (answer.error) failed(new Sentence(`${field.name}: ${answer.error}`));
        else done({ ...answer, goal });
      }),
    );
  }

  /** Cancels requests when another file is opened. */
  cancelFirst() {
    this.first?.settle({ error: 'another file was opened' });
    this.first = null;
  }

  errorOf(step) {
    return tidy(this.largest / 2 ** (step / STEPS_AN_OCTAVE));
  }

  stepOf(error) {
    return Math.max(
      0,
      Math.min(this.most, Math.round(Math.log2(this.largest / Math.max(error, 1e-12)) * STEPS_AN_OCTAVE)),
    );
  }

  /** Sets the slider to the error of the displayed mesh. */
  follow(error) {
    $('error').value = String(this.stepOf(error));
    this.label(error);
  }

  label(error) {
    $('error-text').textContent = error === null ? '…' : withUnit(error, this.unit);
    $('error').setAttribute('aria-valuetext', $('error-text').textContent);
  }

  say(text) {
    $('progress').textContent = text;
    $('progress').hidden = !text;
  }

  state() {
    return this.stepNow === null
      ? {}
      : {
          error: this.errorOf(this.stepNow),
          ...(this.both ? { both: 1, count: Number($('same').value === 'count') } : {}),
        };
  }

  /** Hides the engine's state for a mesh of the file. */
  leave(terrain) {
    if (this.isUsable && terrain.isJudged) this.follow(terrain.judged.maxError);
    this.slow?.cancel();
    this.say('');
    this.stepNow = null;
    this.both = $('both').checked = false;
  }

  /** Positive: a larger error, or the next level without an engine. */
  step(by) {
    if (!this.isUsable) return this.page.chooseLevel(this.page.level + by);
    this.choose(Math.max(0, Math.min(this.most, Number($('error').value) - by)));
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.finish(), 400);
  }

  toggleBoth() {
    if (this.isUsable) this.turnBoth(!this.both);
  }

  turnBoth(both) {
    this.both = both;
    $('both').checked = both;
    if (both) return this.chooseAndFinish(this.stepNow ?? Number($('error').value));
    this.slow.cancel();
    this.show();
  }

  /** Makes a mesh of this error at once by inserting the worst samples: the program's greedy mesh, except for x and y
   * offsets beyond float32. */
  choose(step) {
    this.stepNow = step;
    $('error').value = String(step);
    const error = this.errorOf(step);
    this.label(error);
    this.slow.cancel();
    this.say('');
    const key = `greedy ${step}`;
    if (this.meshes.has(key)) return this.show();
    const goal = ['local', 'grid'].includes(this.page.document.levels[0].extras.crs_option)
      ? { maxError: error }
      : null;
    this.quick.ask({ kind: 'refine', error }, answer => {
      if (!this.take(answer, key, 'greedy', goal) || step !== this.stepNow) return;
      this.show();
      if (this.wantsFinish) this.finish();
    });
  }

  chooseAndFinish(step) {
    this.choose(step);
    this.finish();
  }

  take({ error, mesh, judged }, key, name, goal) {
    if (error) {
      this.say(`No mesh: ${error}`);
      return false;
    }
    const { field, place, levels } = this.page.document;
    this.meshes.set(
      key,
      terrainOfEngine(name, mesh, { judged, goal, extras: levels[0].extras }, field, place, levels[0]),
    );
    return true;
  }

  keys() {
    const greedy = `greedy ${this.stepNow}`;
    return [
      greedy,
      this.both && $('same').value === 'count' ? `high, same triangles as ${greedy}` : `high ${this.stepNow}`,
    ];
  }

  /** Makes a mesh with effort high in the background. */
  finish() {
    if (this.stepNow === null) return;
    const [greedy, high] = this.keys();
    const step = this.stepNow;
    this.wantsFinish = !this.meshes.has(greedy);
    if (this.wantsFinish) return;
    if (this.meshes.has(high)) return this.show();
    this.say('Preview; effort high is at work …');
    this.show();
    const goal =
      this.both && $('same').value === 'count'
        ? { maxTriangles: this.meshes.get(greedy).triangles }
        : { maxError: this.errorOf(step) };
    this.slow.cancel();
    this.slow.ask({ kind: 'finish', goal, effort: 'high' }, answer => {
      if (!this.take(answer, high, 'high', goal) || this.keys()[1] !== high) return;
      this.say('');
      this.show();
    });
  }

  show() {
    if (this.stepNow === null) return;
    const [greedy, high] = this.keys().map(key => this.meshes.get(key));
    if (this.both && greedy) this.page.show([greedy, high ?? greedy]);
    else if (high ?? greedy) this.page.show([high ?? greedy]);
  }
}
