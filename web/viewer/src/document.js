// The contents of the page: levels of a mesh and, if known, their raster.
import { Field, placeMesh } from './field.js';
import { readGlb } from './glb.js';
import { Sentence } from './sentence.js';
import { Place, Terrain } from './terrain.js';

function decodeBase64(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let k = 0; k < raw.length; ++k) bytes[k] = raw.charCodeAt(k);
  return bytes.buffer;
}

function readField({ samples, type, nodata = null, ...rest }) {
  const bytes = decodeBase64(samples);
  const values = type === 'int16' ? new Float32Array(new Int16Array(bytes)) : new Float32Array(bytes);
  if (nodata !== null) for (let k = 0; k < values.length; ++k) if (values[k] === nodata) values[k] = NaN;
  if (values.length !== rest.cols * rest.rows)
    throw new Sentence('The raster in this page is damaged: it has not as many samples as it says.');
  return new Field({ ...rest, samples: values });
}

/** `data`: {name, meshes: [{name, bytes, glb}], field, metres, unit}, as `scarp view` writes it. */
export async function readInline(data) {
  const files = data.meshes.map(({ name, bytes, glb }) => ({ name, bytes, buffer: decodeBase64(glb) }));
  return {
    ...(await makeDocument(files, data.field ? readField(data.field) : null, data.metres, data.unit)),
    name: data.name,
  };
}

/** `metres` for each unit of x, y, z; null: from the first file's metadata. */
export async function makeDocument(files, field, metres = null, unit = null) {
  const parts = [];
  const notes = [];
  for (const { name, bytes, buffer } of files) {
    const { levels, extras, notes: told } = await readGlb(buffer, name);
    notes.push(...told);
    const error = extras.error ?? {};
    levels.forEach((level, k) =>
      parts.push({
        name: levels.length > 1 ? `${name}, level ${k}` : name,
        bytes: k === 0 ? bytes : null,
        told: k === 0 ? error : null,
        extras,
        ...level,
      }),
    );
  }
  const frame = parts[0].extras.crs_option;
  const known = metres !== null || frame === 'local' || frame === 'enu';
  const place = new Place(parts[0].positions, metres ?? [1, 1, 1]);
  const terrains = parts.map(part => new Terrain(part, place, field));
  return {
    name: files[0].name,
    levels: terrains,
    place,
    field,
    unit: unit ?? parts[0].extras.unit ?? '',
    knowsMetres: known,
    isOfTiles: parts[0].extras.tile_level !== undefined,
    notes,
  };
}

/** The raster itself, with the engine's mesh of it. */
export function documentOfRaster(
  { field, frame: { metres, extras, knowsMetres }, unit, notes },
  { mesh, judged, goal },
) {
  const corners = [0, 1, 2, 3].flatMap(k => [
    ...field.toPlace(k & 1 && field.cols - 1, k & 2 && field.rows - 1),
    k < 2 ? field.low : field.high,
  ]);
  const place = new Place(corners, metres);
  return {
    name: field.name,
    levels: [terrainOfEngine('greedy', mesh, { judged, goal, extras }, field, place)],
    place,
    field,
    unit,
    knowsMetres,
    notes,
  };
}

/** A mesh of the engine, in the field's frame; `known`: {judged, goal, extras}. With the image of `shown`, if any. */
export function terrainOfEngine(name, { positions, indices, origin }, known, field, place, shown = null) {
  const placed = placeMesh({ positions, origin });
  const inImage = shown?.placing;
  const uvs = inImage ? new Float32Array((placed.length / 3) * 2) : null;
  for (let v = 0; uvs && v < uvs.length; v += 2) uvs.set(inImage(placed[1.5 * v], placed[1.5 * v + 1]), v);
  return new Terrain(
    {
      name,
      positions: placed,
      indices: Uint32Array.from(indices),
      ...known,
      uvs,
      ...(uvs && { sheets: [{ ...shown.sheets[0], start: 0, count: indices.length }] }),
    },
    place,
    field,
  );
}

/** True if a mesh lies at the raster's position, so that it can be judged. */
export function fits(field, document) {
  const corners = [field.toPlace(0, 0), field.toPlace(field.cols - 1, field.rows - 1)];
  const { low, high } = document.place;
  return [0, 1].every(
    k => Math.min(corners[0][k], corners[1][k]) <= high[k] && Math.max(corners[0][k], corners[1][k]) >= low[k],
  );
}
