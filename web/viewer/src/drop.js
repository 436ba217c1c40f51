// Files dropped on the page or selected: a GLB replaces the mesh, and is judged if it lies at the raster's position; a
// raster is simplified in the page. Nothing is sent from the page.
import { documentOfRaster, fits, makeDocument } from './document.js';
import { readFragment } from './fragment.js';
import { Sentence } from './sentence.js';

const MOST_BYTES = 2 ** 30;
const RASTERS = /\.(tiff?|hgt|png)$/i;
const FIRST_SHARE = 0.02; // max error of the first mesh, as a share of the relief

/** The document of a raster: {document, decode}; decode() rereads it. Null if another file has been
 * opened meanwhile. */
async function readDocument(page, file, isLast, decoding) {
  if (!HAS_ENGINE)
    throw new Sentence(`${file.name} is a raster, and this page was built without the engine that makes a mesh of it.`);
  const { readRaster } = await import('./rasters.js');
  const raster = await readRaster(file, decoding);
  if (!isLast()) return null;
  const document = documentOfRaster(raster, await page.live.makeFirst(raster.field, FIRST_SHARE));
  return { document, decode: other => begin(page, last => readDocument(page, file, last, other)) };
}

/** The last opened file counts: results and messages of earlier ones are discarded. */
export async function begin(page, read) {
  const turn = (page.turn = (page.turn ?? 0) + 1);
  const isLast = () => turn === page.turn;
  page.live.cancelFirst();
  page.say('');
  try {
    const found = await read(isLast);
    if (!isLast()) return;
    page.open(found.document, found.state ?? stateOfFirst(page, found.document));
    page.decode = found.decode ?? page.decode;
  } catch (error) {
    if (isLast()) page.complain(error);
  }
}

/** An initially empty page shows its first file with the address's settings, unless these name other dimensions. */
function stateOfFirst(page, { field }) {
  const state = page.document ? {} : readFragment();
  const [cols, rows] = state.samples ?? [];
  return cols === undefined || (field?.cols === cols && field.rows === rows) ? state : {};
}

/** Handles a drop. */
async function readFiles(page, files, isLast) {
  const large = files.find(file => file.size > MOST_BYTES);
  const wrong = files.find(file => !/\.glb$/i.test(file.name) && !RASTERS.test(file.name));
  if (wrong)
    throw new Sentence(
      `${wrong.name} is no file that this page reads: .glb${HAS_ENGINE ? ', .tif, .hgt or .png' : ''}.`,
    );
  if (large) throw new Sentence(`${large.name} is too large for this page, which takes 1 GiB.`);
  if (files.length > 1) throw new Sentence('One file at a time, please.');
  const [file] = files;
  if (RASTERS.test(file.name)) return readDocument(page, file, isLast, null);
  const read = [{ name: file.name, bytes: file.size, buffer: await file.arrayBuffer() }];
  const old = page.document;
  const field = old?.field ?? null;
  const opened = await makeDocument(read, null);
  return {
    document: field && fits(field, opened) ? await makeDocument(read, field, old.place.metres, old.unit) : opened,
  };
}

/** `page.load` serves other sources of files. */
export function acceptDrops(page) {
  page.load = files => begin(page, isLast => readFiles(page, files, isLast));
  const decoding = document.getElementById('decoding');
  decoding.addEventListener('change', () => page.decode(decoding.value));
  addEventListener('dragover', event => event.preventDefault());
  addEventListener('drop', event => {
    event.preventDefault();
    const files = [...event.dataTransfer.files];
    if (files.length) page.load(files);
  });
  document.getElementById('file').addEventListener('change', ({ target }) => {
    if (target.files.length) page.load([...target.files]);
    target.value = '';
  });
}
