// The panel: its controls, numbers and notes for the state of the page.
import { commandNotes, commandOf } from './command.js';
import { drawLegend, drawMap } from './overlay.js';
import { fillReadout, summarize } from './readout.js';
import { number } from './words.js';

const $ = id => document.getElementById(id);

function fillLook({ edges, smooth, exaggeration, sun: { azimuth, altitude } }, colors, knowsMetres) {
  for (const name of ['relief', 'errors', 'image']) $(name).checked = name === colors;
  $('edges').checked = edges;
  $('smooth').checked = smooth;
  $('exaggeration').value = String(Math.round(Math.log10(exaggeration) * 100));
  const factor = exaggeration === 1 ? (knowsMetres ? '1 (true)' : '1') : `${Number(exaggeration.toPrecision(2))} ×`;
  $('exaggeration-text').textContent = factor;
  $('azimuth').value = String(azimuth);
  $('azimuth-text').textContent = `${azimuth}°`;
  $('altitude').value = String(altitude);
  $('altitude-text').textContent = `${altitude}°`;
}

function fillLevel(level, count) {
  $('level').value = String(level);
  $('level-text').textContent = `${level + 1} of ${count}`;
}

/** A line for each of two meshes side by side. */
function fillSides(shown, unit) {
  [$('side-left'), $('side-right')].forEach((line, k) => {
    line.hidden = shown.length < 2;
    if (shown.length > 1) line.textContent = summarize(shown[k], unit);
  });
  $('divider').hidden = shown.length < 2;
}

let mapped = {}; // terrain and scale of the map from above

function fillMap(terrain, scale, showsErrors) {
  $('map').hidden = !showsErrors;
  const isDrawn = mapped.terrain === terrain && mapped.scale === scale;
  if (showsErrors && !isDrawn) drawMap(terrain.judged, terrain.field, scale);
  mapped = showsErrors ? { terrain, scale } : {};
}

/** Notes on the limits of the page. */
function fillNotes({ field, notes, knowsMetres, isOfTiles }, hasEngine) {
  const words = [...notes];
  if (isOfTiles)
    words.push(
      'Tiles side by side on a flat map; heights are those of the tiles. What judges them is scarp tile check SET.',
    );
  else if (!field) words.push('Without its raster nothing can be judged here: scarp view MESH RASTER.');
  if (!knowsMetres)
    words.push('The units of x and y are not known: the exaggeration is true if they are those of the heights.');
  if (field && !hasEngine) words.push('This page was built without the engine: the mesh is as in its file.');
  $('notes').textContent = words.join(' ');
}

/** The mesh to download, and the command that makes it. */
function fillCommand(shown) {
  const saved = shown.at(-1);
  const format = $('format').value;
  const command = commandOf(saved, format);
  const note = commandNotes(saved, format);
  const which = shown.length > 1 ? saved.name : '';
  $('save').textContent = `Download ${which}`.trim();
  $('command').parentElement.hidden = command === null;
  $('command').textContent = command;
  $('command-of').textContent = which && `${which}: `;
  $('command-note').textContent = note;
  $('command-note').hidden = !note;
}

/** Also sets the scale of the errors. */
export function fillPanel({ look, shown, level, document: made, live }) {
  const { field, unit, levels, place } = made;
  const [terrain] = shown;
  const areJudged = shown.every(({ isJudged }) => isJudged);
  const showsErrors = look.errors && areJudged;
  const colors = look.errors ? 'errors' : look.image ? 'image' : 'relief';
  look.scale = field && areJudged ? Math.max(...shown.map(({ judged }) => judged.maxError)) : 1;
  const { scale } = look;
  fillLook(look, colors, made.knowsMetres);
  fillLevel(level, levels.length);
  fillReadout($('readout'), terrain, unit, levels.includes(terrain) && levels.length === 1 ? null : terrain.name);
  fillSides(shown, unit);
  const image = look.image && terrain.hasImage;
  drawLegend({ errors: showsErrors, image, scale, low: place.low[2], high: place.high[2], unit });
  fillMap(terrain, scale, showsErrors);
  fillNotes(made, live.isThere);
  fillCommand(shown);
  $('decoding-row').hidden = !field?.decoding;
  if (field?.decoding) $('decoding').value = field.decoding;
  const byError = showsErrors && `; coloured by error, blue ${number(scale)} below to red above`;
  const words = [byError || (colors === 'image' && '; under its image'), look.smooth && '; smooth'].filter(Boolean);
  $('canvas').setAttribute('aria-label', `Terrain: ${summarize(terrain, unit)}${words.join('')}`);
}
