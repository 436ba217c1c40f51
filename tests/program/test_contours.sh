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
grep -Eq 'triangles .* [0-9]+ \([0-9.]+ %\) flat between points of equal height' "$logs/out" || fail "the summary does not tell flat triangles"
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
ogr2ogr -f GPKG named.gpkg contours.gpkg -sql "SELECT geom, ELEV AS niveau FROM contour"
refuses 2 "have no third coordinate, and no attribute z, height" "$scarp" simplify named.gpkg x.glb -e 5
succeeds "$scarp" simplify named.gpkg named.obj -e 5 --z-field niveau -q
cmp <(grep -v '^#' named.obj) <(grep -v '^#' mesh5.obj) || fail "the attribute's name changes the mesh"
refuses 2 "no attribute 'Z_M'" "$scarp" simplify contours.gpkg x.glb -e 5 --z-field Z_M
succeeds "$scarp" info contours.gpkg
grep -q '^  lines ' "$logs/out" || fail "info does not count the lines"

# Impossible requests, with one message each.
collection() { echo "{\"type\":\"FeatureCollection\",\"features\":[$1]}"; }
line() { echo "{\"type\":\"Feature\",\"properties\":{\"ELEV\":$1},\"geometry\":{\"type\":\"LineString\",\"coordinates\":$2}}"; }
collection "$(line 10 '[[0,0],[1,1]]'),$(line 20 '[[0,1],[1,0]]')" >crossing.geojson
collection "$(line 10 '[[0,0],[1,1]]'),$(line null '[[0,1],[0.2,1]]')" >missing.geojson
collection "$(line '"high"' '[[0,0],[1,1]]'),$(line 5 '[[0,1],[0.2,1]]')" >words.geojson
refuses 2 "crossing.geojson feature 0 and crossing.geojson feature 1 meet at" \
  "$scarp" simplify crossing.geojson x.glb -e 1 --crs source
grep -q 'heights 10 and 20: correct one of the two, or leave it out' "$logs/err" || fail "no way out is named"
[ "$(grep -o 'crossing.geojson' "$logs/err" | wc -l)" -le 2 ] || fail "the file is named again and again"
refuses 2 "feature 1 has no height: its attribute ELEV is empty" "$scarp" simplify missing.geojson x.glb -e 1
refuses 2 "feature 0 has no number as its height: its attribute ELEV is 'high'" "$scarp" simplify words.geojson x.glb -e 1
collection "$(line 10 '[[0,0,250],[900,0,260],[900,900,270]]'),$(line 20 '[[0,100,300],[800,100],[800,800,340]]')" >flat.geojson
sed 's/"properties":{[^}]*}/"properties":{}/g' flat.geojson > partly.geojson
succeeds "$scarp" info partly.geojson --crs source
grep -q 'warning: partly.geojson: 1 point has exactly the height 0, far below all others (250 to 340): if it has none, --nodata 0 leaves it out' \
  "$logs/err" || fail "a height that is not there is taken for 0 without a word"
collection "$(line 10 '[[0,0],[1,1]]'),{\"type\":\"Feature\",\"properties\":{\"ELEV\":4},\"geometry\":null},$(line 20 '[[0,3],[1,4]]')" >none.geojson
succeeds "$scarp" info none.geojson --z-field ELEV --crs source
grep -q 'warning: 1 feature of none.geojson has no point and was left out' "$logs/err" || fail "one feature is several"
# The number in the refusal of -e 0 can be kept.
ogr2ogr -t_srs EPSG:4326 degrees.gpkg contours.gpkg
refuses 3 "a max error of 0 cannot be kept" "$scarp" simplify degrees.gpkg exact.obj -e 0
least=$(sed -n 's/.*ask for at least \([^,]*\), or split.*/\1/p' "$logs/err")
[ -n "$least" ] || fail "no error that can be kept is named"
succeeds "$scarp" simplify degrees.gpkg exact.obj -e "$least"
gdal_contour -q -amin ELEV -p -i 200 dem.tif bands.gpkg -f GPKG
refuses 2 "holds polygons, not points or lines" "$scarp" simplify bands.gpkg x.glb -e 5
refuses 2 "not a point or a line: if their rings are contours, make lines of them first" "$scarp" simplify bands.gpkg x.glb -e 5 --layer contour
refuses 1 "the lines and the outline of the points alone need" "$scarp" simplify contours.gpkg x.glb -t 9
[ ! -e x.glb ] || fail "a refused run left a file"

# Contours of a mesh: GDAL reads them, and their points lie on the mesh at their height.
succeeds "$scarp" simplify dem.tif lines.obj -e 20 --crs source --contours-out lines.geojson,interval=50
heights=$(ogr2ogr -f CSV /vsistdout/ lines.geojson -select elev | tail -n +2 | tr -d '"' | sort -nu | xargs)
[[ "$heights" == *"400 450 500 550"* ]] || fail "the heights are $heights"
ogrinfo -so lines.geojson lines | grep -q 'ID\["EPSG",32617\]' || fail "the contours have not the CRS of the raster"
succeeds "$scarp" measure lines.geojson lines.obj --z-field elev --json
holds "$(grep -oP '"max_error": \K[^,]*' "$logs/out" | head -n 1) < 1e-6"
succeeds "$scarp" simplify dem.tif lines.obj -e 20 --contours-out some.geojson --overwrite
count=$(ogr2ogr -f CSV /vsistdout/ some.geojson -select elev | tail -n +2 | sort -u | wc -l)
holds "$count > 8 && $count <= 20"
refuses 1 "--contours-out interval 0 is not above 0" "$scarp" simplify dem.tif x.obj -e 20 --contours-out x.geojson,interval=0
succeeds "$scarp" simplify contours.gpkg again.obj -e 20 --contours-out again.geojson,interval=100
echo "contours are simplified, judged, drawn and refused"
