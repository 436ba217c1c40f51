#!/usr/bin/env bash
# view: the page and its refusals. Then a real browser opens it from disk: the numbers of measure, no request, no
# console error, axe-core, damaged files, a browser without WebAssembly. SCARP_SHOTS=FOLDER keeps the pictures.
source "$(dirname "$0")/../program/lib.sh"
need python3 node npm
"$SCARP_SOURCE/tools/build_viewer.sh" "$SCARP_BUILD" > build.log 2>&1 || skip "the viewer's page cannot be built: $(tail -1 build.log)"
[ -z "${SCARP_SHOTS-}" ] || mkdir -p "$SCARP_SHOTS"

succeeds "$scarp" simplify "$dem" plain.glb -e 20 -q
succeeds "$scarp" simplify "$dem" packed.glb -e 5 --compress --html by_simplify.html
grep -qF by_simplify.html "$logs/out" || fail "the summary does not name the page"
succeeds "$scarp" simplify "$dem" levels.glb -e 5 --lods 3:4 --html levels.html -q
succeeds "$scarp" simplify "$dem" plain.obj -e 20 --crs source -q
succeeds "$scarp" generate smooth 2 2 two.tif -q
succeeds "$scarp" simplify two.tif two.glb -e 0 -q
succeeds "$scarp" simplify "$dem" bent.glb -e 20 --crs EPSG:32616 -q

# An image over it: red in the north-west, green, blue, yellow in the south-east.
python3 - << 'E2'
import struct, zlib
width, height = 403, 344
colors = {(0, 0): (220, 40, 40), (0, 1): (40, 200, 40), (1, 0): (40, 40, 230), (1, 1): (220, 200, 40)}
pixels = b"".join(b"\0" + bytes(c for col in range(width) for c in colors[row * 2 // height, col * 2 // width]) for row in range(height))
chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
open("quarters.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                                chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))
E2
succeeds "$scarp" simplify "$dem" image.glb -e 20 --drape quarters.png --drape-format png --normals --html image.html -q
succeeds "$scarp" simplify "$dem" packed_image.glb -e 20 --drape quarters.png --drape-format jpeg --compress -q
succeeds "$scarp" simplify "$dem" places.glb -e 20 --uvs -q

# The page: next to the mesh, or at -o's path; nothing is replaced.
succeeds "$scarp" view plain.glb "$dem"
grep -q '^plain.html: .* open it in a browser$' "$logs/out" || fail "the page is not named: $(cat "$logs/out")"
refuses 4 'plain.html' "$scarp" view plain.glb "$dem"
succeeds "$scarp" view plain.glb "$dem" --overwrite -q
[ ! -s "$logs/out" ] || fail "-q is not quiet"
succeeds "$scarp" view plain.glb -o alone.html
succeeds "$scarp" view two.glb two.tif
succeeds "$scarp" view plain.obj "$dem" -o obj.html
succeeds "$scarp" view levels_lod0.glb "$dem"
succeeds "$scarp" view bent.glb "$dem"
grep -q 'holds no raster' "$logs/err" || fail "a raster that is left out is not told"
succeeds "$scarp" view plain.glb "$dem" -o - -q
cmp "$logs/out" plain.html || fail "standard output holds another page"
mkdir tools
printf '#!/bin/sh\nprintf "%%s" "$1" > opened\n' > tools/xdg-open
chmod +x tools/xdg-open
PATH=$PWD/tools:$PATH succeeds "$scarp" view plain.glb -o opened.html --open
[ "$(cat opened)" = "$PWD/opened.html" ] || fail "another page was opened: $(cat opened)"
printf '#!/bin/sh\nexit 3\n' > tools/xdg-open
PATH=$PWD/tools:$PATH try "$scarp" view plain.glb -o opened.html --open --overwrite
[ "$code" = 4 ] && grep -q 'open it in a browser' "$logs/err" || fail "a browser that does not open is not told"
# A raster elsewhere: measure's message, and no page.
succeeds gdal_translate -q -a_ullr 10 50 10.5 49.6 "$dem" elsewhere.tif
try "$scarp" measure elsewhere.tif plain.glb
[ "$code" = 3 ] && cp "$logs/err" measured.txt || fail "measure takes a raster elsewhere"
refuses 3 'plain.glb: it covers no sample of elsewhere.tif' "$scarp" view plain.glb elsewhere.tif -o x.html
diff <(sed 's/^[^:]*: //' measured.txt) <(sed 's/^[^:]*: //' "$logs/err") || fail "view and measure differ in their sentence"
refuses 1 '(--band), and no RASTER' "$scarp" view plain.glb --band 2 -o x.html
refuses 2 'no_such.glb' "$scarp" view no_such.glb
refuses 2 'no_such.tif' "$scarp" view plain.glb no_such.tif -o x.html
refuses 1 '--html cannot be combined with --solid' "$scarp" simplify "$dem" x.stl -e 20 --solid size=100mm --html x.html
# Tilesets: the finest levels of a folder or file.
succeeds "$scarp" tile "$dem" set --vertical egm96 -e 20 -q
succeeds "$scarp" tile "$dem" set.3tz --of 3dtiles --vertical egm96 -e 20 -q
succeeds "$scarp" view set/
! grep -q 'not whole' "$logs/err" || fail "a whole set is said not to be: $(cat "$logs/err")"
[ -s set.html ] || fail "the page of a folder is elsewhere"
succeeds "$scarp" view set.3tz -o archive.html
succeeds "$scarp" generate fractal 150 150 no_place.tif -q
succeeds "$scarp" tile no_place.tif plane --grid local --cell-size 90 -e 20 -q
succeeds "$scarp" view plane
# With the same four colours, which do not cover tiles at the border.
make_image quarters.tif '220 if (col < 202) == (row < 172) else 40' '200 if col >= 202 else 40' '230 if col < 202 and row >= 172 else 40'
succeeds "$scarp" tile "$dem" draped --of 3dtiles --vertical egm96 --zoom 10 --drape quarters.tif --drape-format jpeg -q
succeeds "$scarp" view draped
refuses 1 "tile check set --source $dem" "$scarp" view set "$dem" -o x.html
printf 'x,y,z\n1,2,3\n' > survey.csv
refuses 2 "survey.csv holds points" "$scarp" view plain.glb survey.csv -o x.html
mkdir folder
refuses 2 'folder is a folder without layer.json or tileset.json' "$scarp" view folder -o x.html
cp -r set damaged
tile=$(find damaged -path "*/$(ls set | grep -E '^[0-9]+$' | sort -n | tail -1)/*.terrain" | sort | head -1)
head -c 200 "$tile" > cut
cp cut "$tile"
refuses 2 'damaged: ' "$scarp" view damaged -o x.html
head -c 9000000 /dev/zero > "$tile"
succeeds "$scarp" view damaged -o large.html
grep -q "the finest level of the page is 10 of 11.* 'scarp serve damaged'" "$logs/err" || fail "a level that is left out is not told: $(cat "$logs/err")"
rm "$tile"
succeeds "$scarp" view damaged -o thin.html
grep -q "damaged is not whole: .* is announced, but missing; 'scarp tile check damaged'" "$logs/err" || fail "a missing tile is not told: $(cat "$logs/err")"
# A program elsewhere without the page: the message explains how to build it.
mkdir -p other/bin
cp "$scarp" other/bin/
refuses 2 "'make viewer'" other/bin/scarp view plain.glb -o x.html
# Only text: the contents of a name start no script.
cp plain.glb '<!--<script>.glb'
succeeds "$scarp" view '<!--<script>.glb' -o name.html
if grep -qF '<!--<script>' name.html; then fail "a name begins a script"; fi

# From Python: the same mesh and raster.
library=$SCARP_BUILD/bindings/c/libscarp_c.so
if [ -e "$library" ] && /usr/bin/python3 -c 'import numpy, rasterio' 2> /dev/null; then
  PATH=$SCARP_BUILD/bin:$PATH PYTHONPATH=$SCARP_SOURCE/bindings/python/src PYTHONDONTWRITEBYTECODE=1 SCARP_LIBRARY=$library succeeds /usr/bin/python3 -c '
import numpy, os, scarp, sys
mesh = scarp.simplify(sys.argv[1], 20)
page = mesh.view(sys.argv[1], "python.html", open=False)
assert page == "python.html", page
try:
    mesh.view(numpy.ones((9, 9)), "x.html", open=False, transform=(5e6, 30, 0, 4e6, 0, -30))
    raise SystemExit("a raster elsewhere is shown")
except scarp.PromiseError as error:
    assert "it covers no sample" in str(error) and "--" not in str(error), error
    assert not os.path.exists("x.html")
open("notebook.html", "w").write("<!doctype html><meta charset=utf-8><title>notebook</title>" + page._repr_html_())' "$dem"
else
  echo "left out: Mesh.view() of Python (needs the C library, numpy and rasterio)"
fi

# With the engine of the npm package, if it was built.
if [ -e "$SCARP_BUILD-wasm/npm/inline-data.js" ]; then
  succeeds node "$SCARP_BUILD/viewer/build.mjs" other/share/scarp/viewer.html "$SCARP_BUILD-wasm/npm"
  grep -q 'with the engine' "$logs/out" || fail "the page has no engine"
  succeeds other/bin/scarp view plain.glb "$dem" -o live.html
  succeeds "$scarp" simplify "$dem" scaled.glb -e 60 --z-scale 3 --te -84.4 36.2 -84.2 36.4 --crs grid -q
  succeeds other/bin/scarp view scaled.glb "$dem" --te -84.4 36.2 -84.2 36.4 -o scaled.html
  cp other/share/scarp/viewer.html try.html
  cp "$dem" dem.tif
  cp "$dem" .
  head -c 3000 "$dem" > cut.tif
  succeeds gdal_translate -q -ot Float32 -srcwin 0 0 60 50 -scale 0 10000 7 7 -a_nodata 7 "$dem" void.tif
  succeeds gdal_translate -q -srcwin 0 0 1 150 "$dem" column.tif
  # A name that a shell must not interpret; samples without a cell; a colour picture; heights in feet; more samples than
  # a page accepts.
  succeeds gdal_translate -q -srcwin 0 0 60 50 "$dem" "; touch x \$(touch y) 'q' .tif"
  printf 'ncols 9\nnrows 8\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9\n' > stray.asc
  for row in 0 1 2 3 4 5 6 7; do
    [ $row -lt 5 ] && echo "3 4 7 1 5 9 2 6 5" || { [ $row = 6 ] && echo "-9 -9 -9 8 -9 -9 -9 7 -9" || echo "-9 -9 -9 -9 -9 -9 -9 -9 -9"; }
  done >> stray.asc
  succeeds gdal_translate -q -a_srs EPSG:32616 stray.asc stray.tif
  # Flat steps, whose mesh is exact.
  sed -n 1,5p stray.asc > terraces.asc
  for row in 1 2 3 4 5 6 7 8; do echo "0.1 0.1 0.1 0.1 0.7 0.7 0.7 0.7 0.7"; done >> terraces.asc
  succeeds gdal_translate -q -a_srs EPSG:32616 terraces.asc terraces.tif
  sed '6d; s/-9/-9999/g' stray.asc > unsaid.asc
  succeeds gdal_translate -q -a_srs EPSG:32616 -a_nodata none unsaid.asc unsaid.tif
  succeeds gdal_translate -q -srcwin 0 0 80 61 -ot Byte -scale 236 1076 0 255 -b 1 -b 1 -b 1 -co PHOTOMETRIC=RGB "$dem" colour.tif
  succeeds gdal_translate -q -srcwin 0 0 80 61 -a_srs EPSG:2264 -a_ullr 1000 9000 1802.5 8390 "$dem" feet.tif
  succeeds gdal_translate -q -srcwin 0 0 3 3 -outsize 4200 4100 -r bilinear -co COMPRESS=DEFLATE -co PROFILE=BASELINE "$dem" thinned.tif
  cp column.tif no_tile.png
  printf 'x' > wrong.xyz
  printf 'x' > broken.png
  head -c 22 "$dem" > thin.hgt
  head -c 5 "$dem" > head.tif
  python3 "$SCARP_SOURCE/tests/program/dropped_rasters.py"
  # GDAL before 3.10.1 misreads it.
  succeeds "$scarp" info grey16.png --json
  highest=$(json "$logs/out" input max)
  try "$scarp" info interlaced.png --json
  [ "$code" = 2 ] && grep -q 'interlaced PNG of 16 bits' "$logs/err" || [ "$(json "$logs/out" input max)" = "$highest" ] || fail "an interlaced PNG is misread"
  mkdir geotiffs
  cd geotiffs
  succeeds python3 "$SCARP_SOURCE/tests/program/dropped_geotiffs.py" "$dem" "$scarp" node "$SCARP_SOURCE/tests/js/geotiffs.mjs" "$SCARP_BUILD/viewer/src" "$SCARP_BUILD-wasm/npm"
  cat "$logs/out"
  cd ..
  cp geotiffs/mask_deflate.tif masked.tif
  cp geotiffs/LERC_ZSTD_Float64_LITTLE.tif doubles.tif
  sed "s/ 'wasm-unsafe-eval'//" live.html > no_wasm.html
else
  echo "left out: live meshes in the page (make npm builds their engine)"
fi

need "$browser"
npm_judges playwright-core axe-core || skip "npm could not fetch playwright-core and axe-core"
for name in plain packed; do
  succeeds "$scarp" measure "$dem" $name.glb --json
  cp "$logs/out" $name.json
done
succeeds "$scarp" measure "$dem" levels_lod2.glb --json
cp "$logs/out" level2.json

# Damaged files to drop: truncated, not a GLB, a vertex that is NaN, a triangle with an invalid vertex.
head -c 4000 plain.glb > cut.glb
head -c 4000 "$dem" > other.glb
cp "$dem" raster.xyz
python3 - << 'E2'
import json, struct
plain = bytearray(open("plain.glb", "rb").read())
length = struct.unpack_from("<I", plain, 12)[0]
binary = 20 + length + 8
views = json.loads(plain[20:20 + length])["bufferViews"]
broken = bytearray(plain)
struct.pack_into("<f", broken, binary + 12 * 17, float("nan"))
open("nan.glb", "wb").write(broken)
broken = bytearray(plain)
struct.pack_into("<H", broken, binary + views[1]["byteOffset"], 65535)
open("index.glb", "wb").write(broken)

# Lines in addition to the triangles.
words = json.loads(plain[20:20 + length])
primitives = words["meshes"][0]["primitives"]
primitives.append({**primitives[0], "mode": 1})
text = json.dumps(words).encode()
text += b" " * (-len(text) % 4)
open("lines.glb", "wb").write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(plain) - 20 - length, len(text), 0x4E4F534A) + text + plain[20 + length:])

# Images that are damaged, or elsewhere.
whole = open("image.glb", "rb").read()
length = struct.unpack_from("<I", whole, 12)[0]
document, binary = json.loads(whole[20:20 + length]), whole[20 + length:]
open("image_damaged.glb", "wb").write(whole.replace(b"IHDR", b"IHDX"))
document["images"] = [{"uri": "elsewhere.png"}]
text = json.dumps(document).encode()
text += b" " * (-len(text) % 4)
open("image_elsewhere.glb", "wb").write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(binary), len(text), 0x4E4F534A) + text + binary)
E2

python3 "$SCARP_SOURCE/tests/browsers/view_pages.py" jobs > jobs.json
succeeds node "$js/viewer.mjs" jobs.json "${SCARP_SHOTS-}" "$browser"
cp "$logs/out" answers.json
python3 "$SCARP_SOURCE/tests/browsers/view_pages.py"
