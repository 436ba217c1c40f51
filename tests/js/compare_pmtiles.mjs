// Reads a PMTiles archive of terrain with the reference reader: node compare_pmtiles.mjs ARCHIVE FOLDER
// Fails unless it has each z/x/y.terrain of the folder, at zoom z + 1 (Mercator: z) with y from the north; prints their
// number.
import fs from 'node:fs';
import zlib from 'node:zlib';
import { PMTiles } from 'pmtiles';

class File {
  constructor(path) {
    this.path = path;
    this.fd = fs.openSync(path);
  }
  getKey() {
    return this.path;
  }
  async getBytes(offset, length) {
    const bytes = Buffer.alloc(length);
    const count = fs.readSync(this.fd, bytes, 0, length, offset);
    return { data: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + count) };
  }
}

const [archive, folder] = process.argv.slice(2);
const tiles = new PMTiles(new File(archive));
const header = await tiles.getHeader();
const metadata = await tiles.getMetadata();
const more = { geographic: 1, mercator: 0 }[metadata.grid];
if (!header.clustered || metadata.zoom_offset !== more) throw new Error('no clustered archive of terrain');
if (metadata.files['layer.json'] !== fs.readFileSync(`${folder}/layer.json`, 'utf8')) throw new Error('layer.json');
let count = 0;
for (const name of fs.readdirSync(folder, { recursive: true })) {
  const found = /^(\d+)\/(\d+)\/(\d+)\.terrain$/.exec(name);
  if (!found) continue;
  const [z, x, y] = found.slice(1).map(Number);
  const tile = await tiles.getZxy(z + more, x, 2 ** z - 1 - y);
  const want = zlib.gunzipSync(fs.readFileSync(`${folder}/${name}`));
  if (!tile || !want.equals(Buffer.from(tile.data))) throw new Error(`${name} differs`);
  ++count;
}
if (count !== header.numAddressedTiles) throw new Error('tiles that the folder does not have');
console.log(count);
