// The numbers of a mesh, judged here against every sample of the raster.
import { bytes, count, number, share, withUnit } from './words.js';

/** `shown`: the mesh judged, if there are several. */
export function fillReadout(list, terrain, unit, shown) {
  const { field, judged, told } = terrain;
  const rows = shown ? [['shown', shown]] : [];
  rows.push(['triangles', count(terrain.triangles)]);
  if (field) rows.push(['of the full grid', share(terrain.triangles, field.fullTriangles)]);
  if (field?.decoding) rows.push(['heights decoded as', field.decoding]);
  if (terrain.bytes !== null) rows.push(['file', bytes(terrain.bytes)]);
  if (judged && judged.covered === 0) rows.push(['max error', 'none: no sample is covered']);
  else if (judged)
    rows.push(
      ['max error', withUnit(judged.maxError, unit)],
      ['at column, row', judged.worst.join(', ')],
      ['RMSE', withUnit(judged.rmse, unit)],
    );
  else if (field)
    rows.push(['max error', 'measuring'], ...['at column, row', 'RMSE', 'samples judged'].map(name => [name, '…']));
  else if (told?.max_error !== undefined) rows.push(['max error, its file says', withUnit(told.max_error, unit)]);
  if (judged) rows.push(['samples judged', count(judged.covered)]);
  if (judged?.uncovered) rows.push(['samples uncovered', count(judged.uncovered)]);
  if (judged?.stray) rows.push(['samples stray', count(judged.stray)]);
  list.replaceChildren(
    ...rows
      .flatMap(([name, value]) => [
        ['dt', name],
        ['dd', value],
      ])
      .map(([kind, text]) => {
        const item = document.createElement(kind);
        item.textContent = text;
        return item;
      }),
  );
}

/** The same in one line. */
export function summarize(terrain, unit) {
  const { judged } = terrain;
  const words = `${terrain.name}: ${count(terrain.triangles)} triangles`;
  return judged ? `${words}, max error ${withUnit(judged.maxError, unit)}, RMSE ${number(judged.rmse)}` : words;
}
