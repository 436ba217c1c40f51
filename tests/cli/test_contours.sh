#!/bin/bash
# Contours as input: proven at each vertex, edges of the mesh, refused in one sentence.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need gdal_contour gdalwarp ogr2ogr python3

gdalwarp -q -t_srs EPSG:32617 -tr 120 120 -r bilinear -dstnodata -9999 "$dem" dem.tif
gdal_contour -q -a ELEV -i 50 dem.tif contours.gpkg -f GPKG
gdal_contour -q -a ELEV -3d -i 50 dem.tif solid.shp

for e in 5 20; do
  for name in "mesh$e.glb" "mesh$e.obj" "mesh$e.2dm"; do
    succeeds "$scarp" simplify contours.gpkg "$name" -e "$e" --report "$name.json"
    succeeds "$scarp" measure contours.gpkg "$name" --fail-above "$e" -q
  done
done
succeeds "$scarp" simplify contours.gpkg again.glb -e 20 -j 1
grep -q '^  lines ' "$logs/out" || fail "the summary does not count the lines"
grep -Eq 'triangles .* flat between points of equal height' "$logs/out" || fail "the summary does not tell flat triangles"
succeeds "$scarp" simplify contours.gpkg other.glb -e 20 -j 4 -q
cmp again.glb other.glb || fail "threads change the mesh"
python3 - <<'PY' || fail "the reports"
import json
fine, coarse = (json.load(open(f"mesh{e}.obj.json")) for e in (5, 20))
assert fine["input"]["lines"] > 100 and fine["loose_pieces"] == 0, fine["input"]
assert coarse["triangles"] < fine["triangles"] < 2 * fine["input"]["points"]
assert 0 < coarse["flat_triangles"] < 0.15 * coarse["triangles"], coarse["flat_triangles"]
assert coarse["max_error"] <= 20 and coarse["uncovered"] == 0 and coarse["topology"]["sound"]
PY
# Heights of the geometry, and of another attribute.
succeeds "$scarp" simplify solid.shp solid.ply -e 10 -q
succeeds "$scarp" measure contours.gpkg solid.ply --fail-above 10 -q
ogr2ogr -f GPKG named.gpkg contours.gpkg -sql "SELECT geom, ELEV AS hoehe FROM contour"
refuses 2 "have no third coordinate, and no attribute z, height" "$scarp" simplify named.gpkg x.glb -e 5
succeeds "$scarp" simplify named.gpkg named.obj -e 5 --z-field hoehe -q
cmp <(grep -v '^#' named.obj) <(grep -v '^#' mesh5.obj) || fail "the attribute's name changes the mesh"
refuses 2 "no attribute 'Z_M'" "$scarp" simplify contours.gpkg x.glb -e 5 --z-field Z_M
succeeds "$scarp" info contours.gpkg
grep -q '^  lines ' "$logs/out" || fail "info does not count the lines"

# What cannot be, in one sentence.
collection() { echo "{\"type\":\"FeatureCollection\",\"features\":[$1]}"; }
line() { echo "{\"type\":\"Feature\",\"properties\":{\"ELEV\":$1},\"geometry\":{\"type\":\"LineString\",\"coordinates\":$2}}"; }
collection "$(line 10 '[[0,0],[1,1]]'),$(line 20 '[[0,1],[1,0]]')" >crossing.geojson
collection "$(line 10 '[[0,0],[1,1]]'),$(line null '[[0,1],[0.2,1]]')" >missing.geojson
collection "$(line '"high"' '[[0,0],[1,1]]'),$(line 5 '[[0,1],[0.2,1]]')" >words.geojson
refuses 2 "crossing.geojson feature 0 and crossing.geojson feature 1 meet at" \
  "$scarp" simplify crossing.geojson x.glb -e 1 --crs source
grep -q 'heights 10 and 20: correct one of the two, or leave it out' "$logs/err" || fail "no way out is named"
refuses 2 "feature 1 has no height: its attribute ELEV is empty" "$scarp" simplify missing.geojson x.glb -e 1
refuses 2 "feature 0 has no number as its height: its attribute ELEV is 'high'" "$scarp" simplify words.geojson x.glb -e 1
gdal_contour -q -amin ELEV -p -i 200 dem.tif bands.gpkg -f GPKG
refuses 2 "holds no layer of points or lines" "$scarp" simplify bands.gpkg x.glb -e 5
refuses 2 "not a point or a line: give its contours as lines" "$scarp" simplify bands.gpkg x.glb -e 5 --layer contour
refuses 1 "--max-triangles cannot be combined with lines, and contours.gpkg holds them" \
  "$scarp" simplify contours.gpkg x.glb -t 1000
[ ! -e x.glb ] || fail "a refused run left a file"
echo "contours are simplified, judged and refused"
