#!/usr/bin/env bash
# --breaklines: every line is a chain of edges of the mesh, hard ones at their own heights, and the bound holds against
# the raster modified by the lines.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

succeeds "$scarp" generate smooth 160 120 hills.tif --seed 3 -q
python3 - <<'PYTHON'
import json, math
def collection(name, features):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"level": level}, "geometry": {"type": kind, "coordinates": points}}
        for kind, points, level in features]}, open(name, "w"))
soft = [("LineString", [[5.3, 7.1], [120.7, 33.2], [150.2, 110.9]], 1), ("LineString", [[20, 110], [140.5, 3.25]], 2),
        ("LineString", [[-50, 60], [300, 61]], 3)]
collection("soft.geojson", soft)
spiral = [[80 + 0.5 * t * math.cos(t / 3), 60 + 0.4 * t * math.sin(t / 3), 2000 + t] for t in range(80)]
collection("hard.geojson", [("LineString", spiral, 0)])
collection("ring.geojson", [("Polygon", [[[30.2, 20, 7], [70, 25, 7], [60, 70.5, 7], [30.2, 20, 7]]], 0)])
collection("cross.geojson", [("LineString", [[10, 10, 100], [50, 50, 100]], 0), ("LineString", [[10, 50, 300], [50, 10, 300]], 0)])
collection("ugly.geojson", [("LineString", [[10, 10], [50, 50], [10, 50], [50, 10], [10, 10], [50, 50]], 0),
                            ("LineString", [[30, 10], [30, 10], [30, 90], [30, 20]], 0),
                            ("Polygon", [[[5, 5], [60, 60], [60, 5], [5, 60], [5, 5]]], 0),
                            ("LineString", [[-900, -800], [-700, -900]], 0)])
PYTHON

for lines in soft hard ring ugly; do
  for effort in fast normal high; do
    for threads in 1 2; do
      succeeds "$scarp" simplify hills.tif "$lines$threads.obj" -e 12 --up z --effort "$effort" --breaklines "$lines.geojson" \
        -j "$threads" --report r.json --overwrite
    done
    cmp "${lines}1.obj" "${lines}2.obj" || fail "-j 2 makes another mesh with $lines lines and $effort effort"
    python3 "$SCARP_SOURCE/tests/program/walk_lines.py" "${lines}1.obj" "$lines.geojson" 160 120 || fail "$lines lines are not in the mesh of $effort effort"
    holds "$(json r.json max_error) <= 12"
    [ "$(json r.json topology sound)" = true ] || fail "$lines lines and $effort effort make an unsound mesh"
    # A soft line does not change the raster.
    if [ "$lines" = soft ]; then
      [ "$(json r.json breaklines edited_samples)" = 0 ] || fail "soft lines change samples"
      succeeds "$scarp" measure hills.tif soft1.obj --fail-above 12
    fi
  done
done
succeeds "$scarp" simplify hills.tif ring.glb -e 12 --breaklines ring.geojson --soft-breaklines
succeeds "$scarp" measure hills.tif ring.glb --fail-above 12
succeeds "$scarp" simplify hills.tif level.obj -e 12 --up z --breaklines soft.geojson --breakline-z level --line-conflict mean
succeeds "$scarp" simplify hills.tif both.glb -e 12 --breaklines soft.geojson --breaklines ring.geojson --report r.json --overwrite
[ "$(json r.json breaklines laid)" = 4 ] || fail "not all lines of two files are inserted"

# Lines without heights: reported with their number and a remedy that works.
python3 - <<'PYTHON'
import json
def line(points): return {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": points}}
json.dump({"type": "FeatureCollection", "features": [line([[10.3, 10.2, 2000], [50.1, 50.7, 2000]]),
    line([[70.4, 20.3, 0], [120.6, 80.2, 0]])]}, open("zero.geojson", "w"))
PYTHON
succeeds gdal_translate -q -a_scale 1 -a_offset 660 hills.tif high.tif
for limit in "" "--memory 100M"; do
  succeeds "$scarp" simplify high.tif zero.obj -e 12 --breaklines zero.geojson --report zero.json --overwrite $limit
  grep -Eq "warning: --breaklines: zero.geojson feature 1 lies up to [0-9.]+ from the raster, and all its heights are 0: .*--breaklines soft" \
    "$logs/err" || fail "a line at height 0 cuts a trench without a word"
  [ "$(json zero.json breaklines farthest_is_at_zero)" = true ] || fail "the report does not tell lines at 0"
  holds "$(json zero.json breaklines farthest) > 660"
  python3 -c 'import json; assert any("all its heights are 0" in w for w in json.load(open("zero.json"))["warnings"])' ||
    fail "the report does not warn of lines at 0"
done
succeeds "$scarp" simplify high.tif zero.obj -e 12 --breaklines zero.geojson --soft-breaklines --overwrite
! grep -q "from the raster" "$logs/err" || fail "a line on the raster is warned of"
succeeds "$scarp" measure high.tif zero.obj --fail-above 12 -q

# Impossible requests are refused by name.
refuses 2 "cross.geojson" "$scarp" simplify hills.tif x.glb -e 12 --breaklines cross.geojson
for rule in first mean highest; do
  succeeds "$scarp" simplify hills.tif "$rule.obj" -e 12 --up z --breaklines cross.geojson --line-conflict "$rule"
done
refuses 1 "--breaklines conflict odd is unknown" "$scarp" simplify hills.tif x.glb -e 12 --breaklines cross.geojson,conflict=odd
refuses 1 "--breaklines" "$scarp" simplify hills.tif x.glb -e 12 --line-conflict mean
refuses 1 "--breaklines" "$scarp" simplify hills.tif x.glb -e 12 --edges data --breaklines soft.geojson
refuses 1 "--importance cannot be combined with --breaklines" "$scarp" simplify hills.tif x.glb -e 12 --importance local --breaklines soft.geojson
# Zeros may lie close to low land.
succeeds gdal_translate -q -ot Float32 -scale 0 1000 4 4.8 hills.tif low.tif
succeeds "$scarp" simplify low.tif low.obj -e 0.5 --breaklines zero.geojson --soft-breaklines
[ ! -s "$logs/err" ] || fail "lines without heights are warned of"
python3 - <<'PYTHON'
import json
lines = json.load(open("zero.geojson"))
del lines["features"][0]
json.dump(lines, open("low.geojson", "w"))
PYTHON
succeeds "$scarp" simplify low.tif low.obj -e 0.5 --breaklines low.geojson --overwrite
grep -Eq "warning: --breaklines: low.geojson feature 0 lies up to 4[0-9.]* from the raster, and all its heights are 0" "$logs/err" ||
  fail "a line at height 0 on low land cuts a trench without a word"

# A height that no float32 holds; lines far from the raster, which are reported; a file that declares its CRS undefined.
python3 - <<'PYTHON'
import json
def line(name, points):
    json.dump({"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": points}}, open(name, "w"))
line("sky.geojson", [[10, 10, 5], [50, 50, 1e300]])
line("far.geojson", [[1000, 10], [1500, 50]])
PYTHON
refuses 2 "sky.geojson feature 0 has the height 1e+300" "$scarp" simplify hills.tif x.glb -e 12 --breaklines sky.geojson
succeeds "$scarp" simplify hills.tif sky.glb -e 12 --breaklines sky.geojson --soft-breaklines
succeeds "$scarp" simplify hills.tif far.glb -e 12 --breaklines far.geojson
grep -q "warning: --breaklines: no line lies on the raster's surface" "$logs/err" || fail "lines beside the raster are not told"
if command -v ogr2ogr > /dev/null && command -v gdal_translate > /dev/null; then
  succeeds gdal_translate -q -a_srs EPSG:32611 hills.tif utm.tif
  succeeds ogr2ogr -f GPKG undefined.gpkg soft.geojson -a_srs None
  succeeds "$scarp" simplify utm.tif undefined.glb -e 12 --breaklines undefined.gpkg --report undefined.json
  [ "$(json undefined.json breaklines laid)" = 3 ] || fail "a GeoPackage of undefined CRS is not taken for the raster's"
  grep -q "undefined.gpkg has no CRS" "$logs/err" || fail "an undefined CRS is not told"
fi

refuses 2 "missing.gpkg" "$scarp" simplify hills.tif x.glb -e 12 --breaklines missing.gpkg

# Lines are not straight on a curved grid: the option and the remedy are named.
python3 - <<'PYTHON'
import json
line = {"type": "LineString", "coordinates": [[-84.40, 36.20], [-84.10, 36.40]]}
json.dump({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": line}]},
          open("road.geojson", "w"))
ring = {"type": "Polygon", "coordinates": [[[-84.30, 36.25], [-84.25, 36.25], [-84.25, 36.30], [-84.30, 36.25]]]}
json.dump({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": ring}]},
          open("lake.geojson", "w"))
PYTHON
succeeds "$scarp" simplify "$dem" same.glb -e 50 --crs EPSG:4326 --breaklines road.geojson
refuses 1 "gdalwarp -t_srs EPSG:32616 -r bilinear -ot Float32 -dstnodata -9999 $dem" "$scarp" simplify "$dem" x.glb -e 50 --crs EPSG:32616 --breaklines road.geojson
refuses 1 "--water cannot be combined with --crs EPSG:32616" "$scarp" simplify "$dem" x.glb -e 50 --crs EPSG:32616 --water lake.geojson
