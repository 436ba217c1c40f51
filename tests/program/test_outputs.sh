#!/usr/bin/env bash
# Other outputs: Scape's TIN, drawings of the edges, the approximation and the errors as rasters, a rendering.
source "$(dirname "$0")/lib.sh"
need python3 gdalinfo gdal_translate

# TIN: one line per triangle, readable by the judge.
succeeds "$scarp" simplify "$dem" m.tin -e 20 --report s.json
[ "$(grep -c '^t ' m.tin)" = "$(json s.json triangles)" ] || fail "not one line for each triangle"
succeeds "$scarp" measure "$dem" m.tin --fail-above 20 -q

# Drawings: every edge once, whatever names the format.
succeeds "$scarp" simplify "$dem" m.svg -e 20
succeeds "$scarp" simplify "$dem" other.name -e 20 --of SVG
cmp m.svg other.name || fail "--of svg and .svg differ"
python3 - m.svg <<'PYTHON'
import sys, xml.dom.minidom
assert xml.dom.minidom.parse(sys.argv[1]).documentElement.tagName == "svg"
PYTHON
succeeds "$scarp" simplify "$dem" m.eps -e 20
head -n 1 m.eps | grep -q '^%!PS-Adobe-.* EPSF-' || fail "m.eps is no EPS"

# The approximation as a raster is within the bound of the original, at the same place.
values() {
  case $1 in
    *.pgm) python3 -c 'import struct, sys; d = open(sys.argv[1], "rb").read()[-2 * 403 * 344:]; print(*struct.unpack(f">{403 * 344}H", d))' "$1" ;;
    *) gdal_translate -q -of AAIGrid -co FORCE_CELLSIZE=YES -co DECIMAL_PRECISION=6 "$1" values.asc && grep -v '[a-zA-Z]' values.asc ;;
  esac
}
values "$dem" > original
for output in a.tif a.TIFF a.pgm; do
  succeeds "$scarp" simplify "$dem" $output -e 20 --error-raster err.tif --overwrite
  values $output > approximation
  python3 - original approximation $output <<'PYTHON'
import sys
a, b = ([float(v) for v in open(f).read().split()] for f in sys.argv[1:3])
bound = 20.5 if sys.argv[3].endswith("pgm") else 20.00001
worst = max(abs(x - y) for x, y in zip(a, b, strict=True))
assert bound - 1.5 < worst <= bound, worst
PYTHON
done
for place in Origin 'Pixel Size'; do
  [ "$(gdalinfo a.tif | grep "$place")" = "$(gdalinfo "$dem" | grep "$place")" ] || fail "the approximation lies elsewhere"
done
succeeds "$scarp" simplify "$dem" raster -e 20 --of dem
gdalinfo raster | grep -q 'Type=Float32' || fail "--of dem is no GeoTIFF"

# The error raster, mesh minus sample, from either command.
succeeds "$scarp" simplify "$dem" e.glb -e 20 --error-raster e1.tif --report s.json --overwrite
succeeds "$scarp" measure "$dem" e.glb --error-raster e2.tif
[ "$(gdalinfo -checksum e1.tif | grep Checksum)" = "$(gdalinfo -checksum e2.tif | grep Checksum)" ] || fail "the error rasters differ"
python3 - s.json "$(gdalinfo -mm e1.tif | grep 'Computed Min/Max')" <<'PYTHON'
import json, sys
worst = max(abs(float(v)) for v in sys.argv[2].split("=")[1].split(","))
assert abs(worst - json.load(open(sys.argv[1]))["max_error"]) < 1e-3, worst
assert [o["format"] for o in json.load(open(sys.argv[1]))["outputs"]] == ["glb", "tif"]
PYTHON

# The rendering has one pixel per sample.
succeeds "$scarp" simplify "$dem" r.glb -e 20 --render r.png
gdalinfo r.png | grep -q 'Size is 403, 344' || fail "the rendering has another size"

refuses 1 "cannot tell the format from out.xyz" "$scarp" simplify "$dem" out.xyz -e 20
refuses 1 "--of tif is unknown: choose glb, obj, ply" "$scarp" simplify "$dem" out.glb -e 20 --of tif
for output in out.svg out.eps out.tif; do
  refuses 1 "--base makes a solid" "$scarp" simplify "$dem" $output -e 20 --base 0
done
refuses 1 "does not end in .tif" "$scarp" simplify "$dem" out.glb -e 20 --error-raster e.png
refuses 1 "does not end in .png" "$scarp" simplify "$dem" out.glb -e 20 --render e.tif
refuses 1 "does not end in .tif" "$scarp" measure "$dem" e.glb --error-raster e.png
refuses 1 "same file" "$scarp" simplify "$dem" out.glb -e 20 --render p.png --preview p.png
refuses 1 "is an input file" "$scarp" simplify e1.tif e1.tif -e 20 --overwrite
refuses 4 "exists already" "$scarp" measure "$dem" e.glb --error-raster e2.tif
for output in s.stl s.tin s.svg s.tif; do
  succeeds "$scarp" simplify "$dem" $output -e 100 --normals
  grep -q 'has no place for vertex normals' "$logs/err" || fail "no word about lost normals in $output"
done
refuses 1 "--normals cannot be combined with --image" "$scarp" simplify "$dem" out.glb -e 20 --image --normals
# A raster's approximation is on the raster's grid; drawings follow --crs.
for output in crs.tif crs.pgm; do
  succeeds "$scarp" simplify "$dem" $output -e 100 --crs EPSG:32616
  grep -q "the raster's own grid, whatever --crs is" "$logs/err" || fail "no word that --crs does nothing to $output"
done
succeeds "$scarp" simplify "$dem" crs.svg -e 100 --crs EPSG:32616
[ ! -s "$logs/err" ] || fail "a wrong word about --crs in crs.svg"
# A folder that accepts no files is detected before the work, and not reported as missing.
if [ -d /proc ]; then
  refuses 4 "x.tif cannot be written: " "$scarp" simplify missing.tif out.glb -e 20 --error-raster /proc/x.tif
  if grep -q 'not exist\|no folder' "$logs/err"; then fail "/proc is said not to exist"; fi
fi
# PGM cannot store negative heights: nothing is written.
make_raster deep.tif '-col'
refuses 4 "" "$scarp" simplify deep.tif out.pgm -e 20
echo "every output holds the approximation"
