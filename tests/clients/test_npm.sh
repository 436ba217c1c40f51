#!/usr/bin/env bash
# The npm package: packed, installed into an empty project, and used in Node. Its meshes and tiles are the program's.
# Browsers and bundlers: test_npm_bundlers.sh.
source "$(dirname "$0")/../program/lib.sh"
source "$(dirname "$0")/npm_package.sh"

# Sizes after brotli, as transferred.
for limit in lite:53 scarp:260 full:350 live:277; do
  size=$(node -p 'require("node:zlib").brotliCompressSync(require("node:fs").readFileSync(process.argv[1])).length' "node_modules/scarp/${limit%:*}.wasm")
  echo "${limit%:*}.wasm: $((size / 1000)) kB after brotli"
  holds "$size <= 1000 * ${limit#*:}" || fail "${limit%:*}.wasm has grown to $size bytes after brotli, above ${limit#*:} kB"
done

# The same meshes as the program.
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
# NAME COLS ROWS ERROR OPTIONS: from the bundled raster, integers unless scaled; below the sea, far above it, and flat.
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
# A hole, an island, and a border that is not straight.
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
for part in pools refusals; do succeeds node $part.mjs; done

# Fields that change: the cells that Python gets.
succeeds node live.mjs
library=$SCARP_BUILD/bindings/c/libscarp_c.so
if [ -e "$library" ] && "$python_program" -c 'import numpy' 2> /dev/null; then
  succeeds node live.mjs hash
  cp "$logs/out" hashes
  SCARP_LIBRARY=$library PYTHONPATH=$SCARP_SOURCE/bindings/python/src PYTHONDONTWRITEBYTECODE=1 succeeds "$python_program" live.py
  cmp "$logs/out" hashes || fail "a field that changes has other cells than in Python"
  [ "$(wc -l < hashes)" = 4 ] || fail "not all fields were compared"
else
  echo "left out: the cells of scarp.Live (needs the C library and numpy)"
fi

# Its messages print numbers like the program's: with the fewest digits, or as in C.
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

# The guide's code, from top to bottom; the last block, tiles, is a separate module.
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
if npm_judges gltf-validator; then succeeds node "$js/validate_glb.cjs" plain.glb packed.glb loose.glb; fi
