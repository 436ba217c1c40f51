#!/usr/bin/env bash
# Images inside a GLB: every pixel in its place for any grid and CRS of the image; normals of the full raster.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalbuildvrt gdalinfo gdalwarp

make_image chess.tif '255 if (col // 13 + row // 13) % 2 else 0' '(col * 255) // 402' '(row * 255) // 343'
glb() { python3 "$SCARP_SOURCE/tests/program/glb.py" "$@"; }

# pixels FILE IMAGE: writes the image's RGB bytes to `raw` and its size to `size`.
pixels() {
  glb "$1" image "$2" image.bin
  gdal_translate -q -of ENVI -co INTERLEAVE=BIP image.bin raw
  size=$(gdalinfo -json image.bin | python3 -c 'import json, sys; print(*json.load(sys.stdin)["size"])')
}

# One pixel per sample: at each vertex the image has the colour of the vertex's sample.
succeeds "$scarp" simplify "$dem" a.glb -e 20 --effort normal --crs grid --drape chess.tif --drape-format png -q
pixels a.glb 0
[ "$size" = "403 344" ] || fail "the image has $size pixels"
PYTHONPATH=$SCARP_SOURCE/tests/program python3 - <<'PYTHON'
import glb
document, binary = glb.load("a.glb")
attributes = document["meshes"][0]["primitives"][0]["attributes"]
shift = document["nodes"][0]["translation"]
image = open("raw", "rb").read()
for (x, _, z), (u, v) in zip(*(glb.floats(document, binary, attributes[name]) for name in ("POSITION", "TEXCOORD_0")), strict=True):
    col, row = round(x + shift[0]), round(z + shift[2] + 343)
    assert abs(u - (col + 0.5) / 403) < 1e-6 and abs(v - (row + 0.5) / 344) < 1e-6, (col, row, u, v)
    at = 3 * (int(v * 344) * 403 + int(u * 403))
    assert tuple(image[at:at + 3]) == (255 if (col // 13 + row // 13) % 2 else 0, col * 255 // 402, row * 255 // 343), (col, row)
PYTHON

# Another CRS and grid: the middle of each square has not moved.
agrees() {
  python3 - $size <<'PYTHON'
import sys
width, height = map(int, sys.argv[1:])
image = open("raw", "rb").read()
for row in range(6, 344, 13):
    for col in range(6, 403, 13):
        at = 3 * (int((row + 0.5) / 344 * height) * width + int((col + 0.5) / 403 * width))
        want = (255 if (col // 13 + row // 13) % 2 else 0, col * 255 // 402, row * 255 // 343)
        assert all(abs(a - b) <= 2 for a, b in zip(image[at:at + 3], want)), (col, row, want, *image[at:at + 3])
PYTHON
}
gdalwarp -q -t_srs EPSG:32617 -r bilinear -dstalpha chess.tif utm.tif
for image in utm chess; do
  succeeds "$scarp" simplify "$dem" b.glb -e 20 --drape $image.tif --drape-size 806 --drape-format png -q --overwrite
  pixels b.glb 0
  [[ $size = "806 688" || ( $image = utm && $size = *" 806" ) ]] || fail "the image of $image.tif has $size pixels"
  agrees
done

for format in jpeg webp; do
  gdalinfo --formats | grep -qi "^ *$format " || continue
  succeeds "$scarp" simplify "$dem" $format.glb -e 20 --drape chess.tif --drape-format $format --compress -q
  glb $format.glb json > g.json
  [ "$(json g.json images 0 mimeType)" = "\"image/$format\"" ] || fail "mime type of $format"
  succeeds "$scarp" measure "$dem" $format.glb --fail-above 20 -q
done

# Half an image, a palette, an image without a place over a raster without one.
gdal_translate -q -srcwin 0 0 200 344 chess.tif half.tif
succeeds "$scarp" simplify "$dem" d.glb -e 20 --drape half.tif
grep -q 'covers 49.6 % of the raster: the rest is white' "$logs/err" || fail "no word about the missing half"
"$scarp" generate fractal 64 48 flat.pgm -q
printf 'P6 4 3 255\n%s' "$(head -c 36 /dev/zero | tr '\0' 'a')" > flat.ppm
succeeds "$scarp" simplify flat.pgm e.glb -e 500 --drape flat.ppm -q

# An image without a place over a raster of equal size with one is treated as if it had that place.
gdal_translate -q -of PNG chess.tif twin.png
rm -f twin.png.aux.xml
succeeds "$scarp" simplify "$dem" twin.glb -e 20 --drape twin.png --drape-format png
grep -q 'twin.png has no place, and as many pixels as the raster has samples' "$logs/err" || fail "no word about the place"
succeeds "$scarp" simplify "$dem" chess.glb -e 20 --drape chess.tif --drape-format png -q
pixels twin.glb 0
mv raw twin.raw
pixels chess.glb 0
cmp raw twin.raw || fail "an image of equal size is not laid pixel by pixel"

usage() { refuses 1 "$1" "$scarp" simplify "$dem" "${@:2}"; }
usage '--drape puts an image into a GLB, and OUTPUT is OBJ' x.obj -e 20 --drape chess.tif
usage '--drape-size needs --drape' x.glb -e 20 --drape-size 100
usage '--drape format gif is unknown' x.glb -e 20 --drape chess.tif,format=gif
usage '--drape cannot be combined with --texture' x.glb -e 20 --drape chess.tif --texture chess.tif
usage '--memory cannot be combined with --drape' x.glb -e 20 --drape chess.tif --memory 500M
usage '--normal-map cannot be combined with --normals' x.glb -e 20 --normal-map 100 --normals
usage '--normal-map 0 is' x.glb -e 20 --normal-map 0
input() { refuses 2 "$1" "$scarp" simplify "$dem" x.glb -e 20 --drape "${@:2}"; }
input 'none.tif: no such file' none.tif
input 'band 1 holds Int16' "$dem"
input 'has no place, and the raster has one: give it a place first (gdal_translate -a_srs EPSG:CODE -a_ullr WEST NORTH EAST SOUTH flat.ppm NEW.tif), or an image of 403 x 344 pixels' flat.ppm
gdal_translate -q -a_ullr 10 10 11 9 chess.tif away.tif
input 'away.tif: does not lie on the raster' away.tif

# Slopes of 3 in 4 towards east and north: normals (-0.6, 0, 0.8) and (0, -0.6, 0.8).
for slope in 'col 51 128' '-row 128 51'; do
  set -- $slope
  make_raster slope.tif "0.75 * $1"
  succeeds "$scarp" simplify slope.tif n.glb -e 1 --crs grid --normal-map 100 -q --overwrite
  pixels n.glb 0
  [ "$size" = "100 85" ] || fail "the normal map has $size pixels"
  python3 - "$2" "$3" <<'PYTHON'
import sys
data = open("raw", "rb").read()
want = bytes([int(sys.argv[1]), int(sys.argv[2]), 230]) * 8500
assert len(data) == len(want) and all(abs(a - b) <= 1 for a, b in zip(data, want)), data[:12]
PYTHON
done

# Points: each vertex has the colour of the image at its place, in degrees and in metres, of the same points.
gdal_translate -q -of XYZ "$dem" samples.xyz
awk 'BEGIN { print "lon lat height" } NR % 97 == 1' samples.xyz > degrees.csv
echo EPSG:4326 > degrees.prj
gdalwarp -q -t_srs EPSG:32617 -r near chess.tif metres.tif
tail -n +2 degrees.csv | gdaltransform -s_srs EPSG:4326 -t_srs EPSG:32617 | awk 'BEGIN { print "x y z" } { print $1, $2, $3 }' > metres.csv
echo EPSG:32617 > metres.prj
for points in degrees metres; do
  succeeds "$scarp" simplify $points.csv $points.glb -e 20 --drape metres.tif,size=2000,format=png
  pixels $points.glb 0
  PYTHONPATH=$SCARP_SOURCE/tests/program python3 - $points $size <<'PYTHON' || fail "the image does not lie on $points"
import glb, sys
name, width, height = sys.argv[1], *map(int, sys.argv[2:])
document, binary = glb.load(name + ".glb")
west, across, _, south, _, up = document["asset"]["extras"]["to_source"]
attributes = document["meshes"][0]["primitives"][0]["attributes"]
shift = document["nodes"][0]["translation"]
image = open("raw", "rb").read()
numbers = lambda file: [[float(word) for word in line.split()] for line in list(open(file))[1:]]
digits = 6 if name == "degrees" else 1
cells = {(round(x, digits), round(y, digits)): (round((lon + 84.41375) / 0.000833333333333 - 0.5), round((36.44625 - lat) / 0.000833333333333 - 0.5))
         for (x, y, *_), (lon, lat, *_) in zip(numbers(name + ".csv"), numbers("degrees.csv"), strict=True)}
count = 0
for (x, _, z), (u, v) in zip(*(glb.floats(document, binary, attributes[key]) for key in ("POSITION", "TEXCOORD_0")), strict=True):
    cell = cells.get((round(west + across * (x + shift[0]), digits), round(south + up * -(z + shift[2]), digits)))
    if cell is None or not 2 < cell[0] < 400 or not 2 < cell[1] < 341:
        continue
    at = 3 * (min(height - 1, int(v * height)) * width + min(width - 1, int(u * width)))
    want = (cell[0] * 255 / 402, cell[1] * 255 / 343)
    assert all(abs(a - b) <= 2 for a, b in zip(image[at + 1:at + 3], want)), (cell, want, *image[at:at + 3])
    count += 1
assert count > 100, count
PYTHON
done
