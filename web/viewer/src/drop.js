// Files dropped on the page or chosen: a GLB takes the place of the mesh, and is judged if it lies where the raster does;
// a raster is simplified here. Nothing leaves the page.
import { document_of_raster, fits, make_document } from './document.js';
import { Sentence } from './sentence.js';

const MOST_BYTES = 2 ** 30;
const RASTERS = /\.(tiff?|hgt|png)$/i;
const FIRST_SHARE = 0.02;  // max error of the first mesh, of the relief

async function open_raster(page, file, decoding = null) {
  if (!HAS_ENGINE) throw new Sentence(`${file.name} is a raster, and this page was built without the engine that makes a mesh of it.`);
  const { read_raster } = await import('./rasters.js');
  const raster = await read_raster(file, decoding);
  page.open(document_of_raster(raster, await page.live.make_first(raster.field, FIRST_SHARE)));
  page.decode = other => open_raster(page, file, other);
}

/** What a drop does; `page.load` for who brings files in another way. */
async function open_files(page, files) {
  const large = files.find(file => file.size > MOST_BYTES), wrong = files.find(file => !/\.glb$/i.test(file.name) && !RASTERS.test(file.name));
  if (wrong) throw new Sentence(`${wrong.name} is no file that this page reads: .glb${HAS_ENGINE ? ', .tif, .hgt or .png' : ''}.`);
  if (large) throw new Sentence(`${large.name} is too large for this page, which takes 1 GiB.`);
  if (files.length > 1) throw new Sentence('One file at a time, please.');
  const [file] = files;
  if (RASTERS.test(file.name)) return open_raster(page, file);
  const read = [{ name: file.name, bytes: file.size, buffer: await file.arrayBuffer() }];
  const old = page.document, field = old?.field ?? null, opened = await make_document(read, null);
  page.open(field && fits(field, opened) ? await make_document(read, field, old.place.metres, old.unit) : opened);
}

export function accept_drops(page, complain) {
  page.load = files => {
    document.getElementById('notice').hidden = true;
    return open_files(page, files).catch(complain);
  };
  const decoding = document.getElementById('decoding');
  decoding.addEventListener('change', () => page.decode(decoding.value).catch(complain));
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
