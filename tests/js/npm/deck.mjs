// A page of deck.gl: its TerrainLayer draws a height image and web tiles with the loader named in the address.
import { Deck, MapView } from '@deck.gl/core';
import { TerrainLayer } from '@deck.gl/geo-layers';
import { TerrainLoader as Theirs } from '@loaders.gl/terrain';
import { TerrainLoader as Ours } from 'scarp/loaders';
import { hills } from './rasters.mjs';

const loaders = [location.hash === '#theirs' ? Theirs : Ours];
const side = 120;
const z = hills(side, side, 3);
const elevationDecoder = { rScaler: 256, gScaler: 1, bScaler: 1 / 256, offset: -32768 };

/// A PNG in the encoding of terrarium.
async function drawHeights() {
  const canvas = new OffscreenCanvas(side, side);
  const context = canvas.getContext('2d');
  const image = context.createImageData(side, side);
  z.forEach((value, k) => {
    const code = Math.round((value + 32768) * 256);
    image.data.set([code >> 16, (code >> 8) & 255, code & 255, 255], 4 * k);
  });
  context.putImageData(image, 0, 0);
  return URL.createObjectURL(await canvas.convertToBlob());
}

/// Draws one layer until it has its data; reports its meshes and its share of the canvas.
function draw(layer, viewState) {
  const canvas = document.querySelector('canvas');
  return new Promise((resolve, reject) => {
    const deck = new Deck({
      canvas,
      width: 500,
      height: 300,
      views: new MapView({ farZMultiplier: 10 }),
      initialViewState: viewState,
      layers: [layer],
      onError: reject,
      onAfterRender() {
        const [top] = deck.props.layers;
        if (!top.isLoaded) return;
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
        const drawn =
          data.reduce((count, value, k) => count + (k % 4 === 3 && value > 0 ? 1 : 0), 0) / (data.length / 4);
        if (drawn === 0) return void requestAnimationFrame(() => deck.redraw('its models are not there yet'));
        const meshes = top
          .getSubLayers()
          .flatMap(
            part =>
              part.state.tileset?.tiles.filter(tile => tile.isSelected).map(tile => tile.content[0]) ?? [
                part.props.mesh,
              ],
          );
        resolve({
          deck,
          drawn,
          meshes: meshes.map(
            ({
              header: {
                boundingBox: [[, , low], [, , high]],
              },
              indices,
            }) => ({ low, high, triangles: indices.value.length / 3 }),
          ),
        });
      },
    });
  });
}

async function run() {
  const picture = await drawHeights();
  const common = {
    loaders,
    elevationDecoder,
    color: [170, 160, 140],
    meshMaxError: 4,
    loadOptions: { worker: false, core: { worker: false } },
  };
  const place = { longitude: 10, latitude: 46, zoom: 11.5, pitch: 60, bearing: 20 };
  const tiles = await draw(
    new TerrainLayer({ ...common, id: 'tiles', elevationData: `${picture}#{z}/{x}/{y}` }),
    place,
  );
  tiles.deck.finalize();
  const one = await draw(
    new TerrainLayer({ ...common, id: 'one', elevationData: picture, bounds: [9.95, 45.96, 10.05, 46.04] }),
    place,
  );
  const bare = ({ drawn, meshes }) => ({ drawn, meshes });
  return { low: Math.min(...z), high: Math.max(...z), one: bare(one), tiles: bare(tiles) };
}

window.told = run().catch(error => ({ failed: `${error.message} ${error.stack}` }));
