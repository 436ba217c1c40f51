#!/usr/bin/env bash
# The npm package: packed, installed into an empty project, and used in Node, in Chromium and through bundlers. Its meshes and
# tiles are the program's.
source "$(dirname "$0")/../program/lib.sh"
need em++ node npm python3 gdal_translate
[ "$(node -p 'parseInt(process.versions.node) >= 18')" = true ] || skip "needs Node 18"

package=$("$SCARP_SOURCE/tools/build_npm.sh" "$SCARP_BUILD-wasm" "$PWD/dist" 2> "$logs/err") || fail "the package cannot be built"
cp "$SCARP_SOURCE"/tests/js/npm/* .
echo '{ "type": "module", "private": true }' > package.json
succeeds npm install --offline --no-audit --no-fund --ignore-scripts "$package"

# Sizes after brotli, as they go over the wire.
for limit in lite:53 scarp:260 full:336; do
  size=$(node -p 'require("node:zlib").brotliCompressSync(require("node:fs").readFileSync(process.argv[1])).length' "node_modules/scarp/${limit%:*}.wasm")
  echo "${limit%:*}.wasm: $((size / 1000)) kB after brotli"
  holds "$size <= 1000 * ${limit#*:}" || fail "${limit%:*}.wasm has grown to $size bytes after brotli, above ${limit#*:} kB"
done

# The same meshes as the program.
add() {  # NAME WIDTH HEIGHT ERROR
  local effort
  succeeds gdal_translate -q -of ENVI -ot Float32 "$1.tif" "$1.f32"
  for effort in fast normal high; do
    succeeds "$scarp" simplify "$1.tif" "$1_$effort.glb" -e "$4" --effort "$effort" --crs grid -q
    echo "$1 $2 $3 $4 $effort" >> cases
  done
}
while read -r name style cols rows range error; do
  succeeds "$scarp" generate "$style" "$cols" "$rows" "$name.tif" --range "$range" -q
  add "$name" "$cols" "$rows" "$error"
done << 'RASTERS'
fractal fractal 160 120 1000 20
smooth smooth 140 150 500 2
cliff cliff 100 100 50 1
paraboloid p 120 90 100 0.25
step x 90 110 30 1
diagonal D 64 48 20 0.5
pyramid o 65 65 200 1
parabola q 70 50 100 0.5
exact fractal 24 20 100 0
wide fractal 200 2 500 5
tall fractal 2 170 500 5
smallest fractal 2 2 10 1
RASTERS
# NAME COLS ROWS ERROR OPTIONS: of the bundled raster, integers but where they are scaled; below the sea, far above it, and flat.
while read -r name cols rows error options; do
  succeeds gdal_translate -q -srcwin $options "$dem" "$name.tif"
  add "$name" "$cols" "$rows" "$error"
done << 'CROPS'
land 200 180 8 60 60 200 180
odd 130 130 1.7 0 0 130 130 -ot Float32 -scale 0 1000 0 333.3
deep 60 70 3 300 200 60 70 -ot Float32 -scale 0 1000 -11000 -9000
high 50 40 0.25 200 20 50 40 -ot Float32 -scale 0 1000 88000 88100
strip 150 3 4 10 300 150 3
flat 40 30 1 0 0 40 30 -ot Float32 -scale 0 1000 7 7
coarse 57 49 15 0 0 403 344 -r nearest -outsize 57 49
CROPS
# A hole, an island, and a border that is no line.
python3 - > voids.asc << 'E2'
import math
print("ncols 90\nnrows 80\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999")
for row in range(80):
    print(*(-9999 if col + 2 * row < 40 + 9 * math.sin(row) or 8 < math.hypot(col - 55, row - 45) < 15 else
            round(300 + 80 * math.sin(col / 9) * math.cos(row / 7) + (col * row) % 7, 2) for col in range(90)))
E2
succeeds gdal_translate -q -ot Float32 voids.asc voids.tif
add voids 90 80 4
succeeds node same.mjs cases
[ "$(wc -l < "$logs/out")" = 60 ] || fail "not all cases were compared"

succeeds node --expose-gc api.mjs

# Its sentences print numbers as the program's do: by the fewest digits, or as C.
python3 - > numbers.json << 'E2'
import json, random, struct
float32 = lambda value: struct.unpack("f", struct.pack("f", value))[0]
random.seed(1)
values = [0.0, 1e15, 1e16, 1e-4, 1e-5, 9.9999e-5, 999999.5, 0.5, 2.5, 0.125, 1e21, 1e22, 5e-324, 1.7e308]
values += [random.uniform(-1, 1) * 10 ** random.randint(-12, 20) for _ in range(300)] + [random.randint(-10**6, 10**6) / 16 for _ in range(200)]
cases = []
for value in values:
    cases.append([value, False, "g", -1, repr(value).removesuffix(".0")])
    if 1e-30 < abs(value) < 1e30:
        small = float32(value)
        digits = next(f"{small:.{count}e}" for count in range(9) if float32(float(f"{small:.{count}e}")) == small)
        cases.append([small, True, "g", -1, repr(float(digits)).removesuffix(".0")])
    for style, precision in ("g", 2), ("g", 3), ("g", 6), ("g", 9), ("g", 12), ("f", 0), ("f", 2), ("f", 3), ("e", 5):
        cases.append([value, False, style, precision, f"{value:.{precision}{style}}"])
print(json.dumps(cases))
E2
succeeds node numbers.mjs numbers.json
holds "$(cat "$logs/out") > 5000" || fail "few numbers were compared"

# The guide's code, from top to bottom; the last block, tiles, has a module of its own.
if npm_judges three; then
  [ -e node_modules/three ] || ln -s "$js/node_modules/three" node_modules/
  block() { python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$SCARP_SOURCE/docs/guide/web.md" js "$1"; }
  for number in 0 1 2 3; do block $number; done > guide.mjs
  block 4 > tiler.mjs
  succeeds node guide.mjs
  grep -q '^true true true$' "$logs/out" && grep -q '^true usage ' "$logs/out" && [ -s tile.glb ] || fail "the guide's code does not do what it says"
  succeeds node tiler.mjs
  [ -s tile.terrain ] && [ -s layer.json ] || fail "the guide makes no tile"
  # The lines of README.md, which assume an array.
  {
    echo 'const width = 300, height = 200, heights = Float32Array.from({ length: 60000 }, (_, k) => 90 * Math.sin((k % 300) / 30) * Math.cos(k / 9000));'
    python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$SCARP_SOURCE/README.md" js
    echo 'console.log(String.fromCharCode(...glb.subarray(0, 4)));'
  } > readme_root.mjs
  succeeds node readme_root.mjs
  grep -qx glTF "$logs/out" || fail "the lines of README.md make no GLB"
fi

# The same tiles as the program.
succeeds gdal_translate -q -srcwin 0 0 150 150 -a_srs EPSG:4979 -a_ullr 9.9 10.2 10.025 10.075 "$dem" placed.tif
succeeds gdal_translate -q -of ENVI -ot Float32 placed.tif placed.f32
succeeds "$scarp" tile placed.tif set -q
succeeds node tiles.mjs degrees placed 150 150 9.9 10.075 10.025 10.2 set
read -r tiles proven < "$logs/out"
[ "$tiles" = "$(find set -name '*.terrain' | wc -l)" ] && holds "$proven > 4" || fail "not all tiles were compared"
succeeds gdal_translate -q -srcwin 0 0 120 100 -a_srs EPSG:3857 -a_ullr 1110000 5790000 1113600 5787000 "$dem" mercator.tif
succeeds gdal_translate -q -of ENVI -ot Float32 mercator.tif mercator.f32
succeeds "$scarp" tile mercator.tif mercator_set --vertical ellipsoid -q
succeeds node tiles.mjs mercator mercator 120 100 1110000 5787000 1113600 5790000 mercator_set
read -r tiles proven < "$logs/out"
[ "$tiles" = "$(find mercator_set -name '*.terrain' | wc -l)" ] && holds "$proven > 4" || fail "not all tiles of web Mercator were compared"

# GLBs, plain and compressed, as the program reads them.
succeeds node glb.mjs land 200 180 8
read -r fine plain lattice plain_bytes packed_bytes loose_bytes < "$logs/out"
for file in plain:$plain packed:$lattice loose:$plain; do
  succeeds "$scarp" measure land.tif "${file%:*}.glb" --crs grid --fail-above 8 --json
  [ "$(json "$logs/out" triangles)" = "${file#*:}" ] || fail "${file%:*}.glb has other triangles: $(cat "$logs/out")"
done
succeeds gdal_translate -q -a_srs EPSG:32611 -a_ullr 400000 5000000 400020 4999982 land.tif fine.tif
succeeds "$scarp" measure fine.tif fine.glb --crs source --fail-above 8 --json
off=$(json "$logs/out" max_error)
holds "$off - $fine < 1e-9 && $fine - $off < 1e-9"
holds "2 * $packed_bytes < $plain_bytes && $loose_bytes < $plain_bytes"

# The following needs packages of others.
told= bundles=()
npm_judges gltf-validator && succeeds node "$js/validate_glb.cjs" plain.glb packed.glb loose.glb
if npm_judges typescript delatin @mapbox/martini @loaders.gl/terrain esbuild vite webpack; then
  for installed in "$js"/node_modules/*; do [ -e "node_modules/$(basename "$installed")" ] || ln -s "$installed" node_modules/; done
  succeeds node dropins.mjs
  succeeds node node_modules/typescript/bin/tsc --noEmit --strict --module nodenext --target es2022 --lib es2022,dom --typeRoots none typed.mts
  # Without types of a browser, and as older programs search for them.
  succeeds node node_modules/typescript/bin/tsc --noEmit --strict --module nodenext --target es2022 --lib es2022 --typeRoots none plain.mts
  succeeds node node_modules/typescript/bin/tsc --noEmit --strict --module esnext --moduleResolution node10 --target es2022 --lib es2022 --typeRoots none node10.ts
  told=$(node app.mjs)
  succeeds node bundle.mjs formats
  for bundler in esbuild inline vite webpack; do succeeds node bundle.mjs "$bundler"; done
  bundles=(esbuild/index.html file:inline/index.html vite/vite.html dev:vite.html webpack/index.html)
fi
if command -v chromium > /dev/null && npm_judges playwright-core; then
  cp "$js/browser.mjs" open_page.mjs
  [ -e node_modules/playwright-core ] || ln -s "$js/node_modules/playwright-core" node_modules/
  # The blocks of bindings/wasm/README.md.
  readme=$SCARP_SOURCE/bindings/wasm/README.md
  if npm_judges three esbuild && "$SCARP_SOURCE/tools/build_viewer.sh" "$SCARP_BUILD" > viewer.log 2>&1; then
    "$js/node_modules/.bin/esbuild" "$SCARP_BUILD/viewer/node_modules/geotiff/dist-module/geotiff.js" --bundle --format=esm --log-level=error --outfile=geotiff.js
    cp -L "$data/examples/tile.png" "$data/examples/dem.tif" .
    succeeds node readme.mjs "$(command -v chromium)" "$readme"
    cat "$logs/out"
    mkdir by_readme
    (cd by_readme && ln -s ../node_modules . && echo 'import { simplify } from "scarp"; console.log(simplify);' > app.js &&
      PATH=$js/node_modules/.bin:$PATH succeeds bash -ec "$(python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$readme" sh)" && ls dist/scarp.wasm dist/app.js > /dev/null) ||
      fail "the lines for esbuild"
  fi
  succeeds node browser.mjs "$(command -v chromium)" "$told" "${bundles[@]}"
  cat "$logs/out"
  if npm_judges @deck.gl/geo-layers @loaders.gl/terrain esbuild; then
    shots=${SCARP_SHOTS:-$scratch/shots}
    mkdir -p "$shots"
    succeeds node deck_browser.mjs "$(command -v chromium)" "$shots"
    echo "deck.gl: $(grep -o '"drawn"' "$logs/out" | wc -l) pictures"
  fi
else
  echo "left out: Chromium"
fi
