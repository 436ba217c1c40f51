// A GLB file dropped on the page is shown in place of the mesh, and judged if it lies where the raster does.
import { fits, make_document } from './document.js';
import { Sentence } from './sentence.js';

const MOST_BYTES = 2 ** 30;

/** What a drop does; `page.load` for who brings files in another way. */
async function open_files(page, files) {
  const wrong = files.find(file => !/\.glb$/i.test(file.name));
  if (wrong) throw new Sentence(`${wrong.name} is no GLB file: drop a mesh that Scarp or another program wrote as .glb.`);
  const large = files.find(file => file.size > MOST_BYTES);
  if (large) throw new Sentence(`${large.name} is too large for this page, which takes 1 GiB.`);
  const read = await Promise.all(files.map(async file => ({ name: file.name, bytes: file.size, buffer: await file.arrayBuffer() })));
  const old = page.document, field = old?.field ?? null, opened = await make_document(read, null);
  page.open(field && fits(field, opened) ? await make_document(read, field, old.place.metres, old.unit) : opened);
}

export function accept_drops(page, complain) {
  page.load = files => open_files(page, files);
  addEventListener('dragover', event => event.preventDefault());
  addEventListener('drop', event => {
    event.preventDefault();
    document.getElementById('notice').hidden = true;
    const files = [...event.dataTransfer.files];
    if (files.length) page.load(files).catch(complain);
  });
}
