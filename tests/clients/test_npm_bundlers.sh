#!/usr/bin/env bash
# The npm package with TypeScript, through bundlers, as a replacement of other packages, and in Chromium with the
# program's meshes.
source "$(dirname "$0")/../program/lib.sh"
source "$(dirname "$0")/npm_package.sh"

succeeds gdal_translate -q -srcwin 60 60 200 180 "$dem" land.tif
add land 200 180 8
succeeds "$scarp" generate fractal 160 120 fractal.tif --range 1000 -q
add fractal 160 120 20
succeeds "$scarp" generate fractal 200 2 wide.tif --range 500 -q
add wide 200 2 5
succeeds node same.mjs cases

told= bundles=()
if npm_judges typescript delatin @mapbox/martini @loaders.gl/terrain esbuild vite webpack; then
  for installed in "$js"/node_modules/*; do [ -e "node_modules/$(basename "$installed")" ] || ln -s "$installed" node_modules/; done
  succeeds node dropins.mjs
  succeeds node node_modules/typescript/bin/tsc --noEmit --strict --module nodenext --target es2022 --lib es2022,dom --typeRoots none typed.mts
  # Without a browser's types, and with the module resolution of older programs.
  succeeds node node_modules/typescript/bin/tsc --noEmit --strict --module nodenext --target es2022 --lib es2022 --typeRoots none plain.mts
  succeeds node node_modules/typescript/bin/tsc --noEmit --strict --module esnext --moduleResolution node10 --target es2022 --lib es2022 --typeRoots none node10.ts
  told=$(node app.mjs)
  succeeds node bundle.mjs formats
  for bundler in esbuild inline vite webpack; do succeeds node bundle.mjs "$bundler"; done
  bundles=(esbuild/index.html file:inline/index.html vite/vite.html dev:vite.html webpack/index.html)
fi
if command -v "$browser" > /dev/null && npm_judges playwright-core; then
  cp "$js/browser.mjs" open_page.mjs
  [ -e node_modules/playwright-core ] || ln -s "$js/node_modules/playwright-core" node_modules/
  # The blocks of bindings/wasm/README.md.
  readme=$SCARP_SOURCE/bindings/wasm/README.md
  if npm_judges three esbuild && "$SCARP_SOURCE/tools/build_viewer.sh" "$SCARP_BUILD" > viewer.log 2>&1; then
    "$js/node_modules/.bin/esbuild" "$SCARP_BUILD/viewer/node_modules/geotiff/dist-module/geotiff.js" --bundle --format=esm --log-level=error --outfile=geotiff.js
    cp -L "$data/examples/tile.png" "$data/examples/dem.tif" .
    succeeds node readme.mjs "$browser" "$readme"
    cat "$logs/out"
    mkdir by_readme
    (cd by_readme && ln -s ../node_modules . && echo 'import { simplify } from "scarp"; console.log(simplify);' > app.js &&
      PATH=$js/node_modules/.bin:$PATH succeeds bash -ec "$(python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$readme" sh)" && ls dist/scarp.wasm dist/app.js > /dev/null) ||
      fail "the lines for esbuild"
  fi
  succeeds node browser.mjs "$browser" "$told" "${bundles[@]}"
  cat "$logs/out"
  if npm_judges @deck.gl/geo-layers @loaders.gl/terrain esbuild; then
    shots=${SCARP_SHOTS:-$scratch/shots}
    mkdir -p "$shots"
    succeeds node deck_browser.mjs "$browser" "$shots"
    echo "deck.gl: $(grep -o '"drawn"' "$logs/out" | wc -l) pictures"
  fi
else
  echo "left out: Chromium"
fi
