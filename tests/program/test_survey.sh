#!/bin/bash
# A survey: efforts and budgets on points, breaklines, a boundary of polygons, and the surface as a raster.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need awk python3

awk 'BEGIN { srand(7); print "x,y,z"
  for (i = 0; i < 4000; i++) { x = rand() * 1000; y = rand() * 800
    printf "%.2f,%.2f,%.3f\n", 500000 + x, 4649000 + y, 300 + 40 * sin(x / 90) * cos(y / 70) + rand() / 4 } }' >survey.csv
count() { python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))["triangles"])' "$1"; }
error() { python3 -c 'import json,sys; print(json.load(open(sys.argv[1]))["max_error"])' "$1"; }

# Higher efforts need fewer triangles for the same error, and reach a smaller error with the same triangles.
for effort in fast normal high; do
  succeeds "$scarp" simplify survey.csv "$effort.glb" -e 1 --effort "$effort" --report "$effort.json" -q
  succeeds "$scarp" measure survey.csv "$effort.glb" --fail-above 1 -q
  succeeds "$scarp" simplify survey.csv "b$effort.glb" -t 800 --effort "$effort" --report "b$effort.json" -q
  holds "$(count "b$effort.json") <= 800" || fail "the budget with $effort"
done
holds "$(count normal.json) < 0.8 * $(count fast.json)" || fail "normal: $(count normal.json) of $(count fast.json)"
holds "$(count high.json) < 0.75 * $(count normal.json)" || fail "high: $(count high.json) of $(count normal.json)"
holds "$(error bnormal.json) < $(error bfast.json)" || fail "the error of a budget with normal"
holds "$(error bhigh.json) < $(error bnormal.json)" || fail "the error of a budget with high"
succeeds "$scarp" simplify survey.csv samples.glb -e 1 --effort high --vertices samples --report samples.json -q
holds "$(count samples.json) < $(count normal.json)" || fail "high on samples"
succeeds "$scarp" simplify survey.csv free.glb -e 1 --vertices free --report free.json -q
succeeds "$scarp" measure survey.csv free.glb --fail-above 1 -q
holds "$(count free.json) < $(count normal.json)" || fail "free vertices of normal effort: $(count free.json)"
[ "$(json free.json strategy vertices) $(json normal.json strategy vertices)" = '"free" "samples"' ] || fail "the report does not name the places of vertices"
for threads in 1 3; do
  succeeds "$scarp" simplify survey.csv "t$threads.ply" -e 0.5 --effort high -j "$threads" -q
done
cmp <(sed 's/-j [13]//; s/t[13].ply//' t1.ply) <(sed 's/-j [13]//; s/t[13].ply//' t3.ply) || fail "threads change the mesh"

# A boundary with a hole, and lines with and without heights.
python3 - <<'PY'
import json
def write(path, geometry):
    json.dump({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": g} for g in geometry]},
              open(path, "w"))
at = lambda x, y, *z: [500000 + x, 4649000 + y, *z]
write("site.geojson", [{"type": "Polygon", "coordinates": [
    [at(100, 100), at(900, 150), at(850, 700), at(120, 650), at(100, 100)],
    [at(400, 300), at(400, 400), at(500, 400), at(500, 300), at(400, 300)]]}])
write("dike.geojson", [{"type": "LineString", "coordinates": [at(50, 200, 350), at(600, 210, 352), at(950, 260, 351)]}])
write("path.geojson", [{"type": "LineString", "coordinates": [at(150, 600), at(500, 560), at(800, 640)]}])
write("far.geojson", [{"type": "Polygon", "coordinates": [[[0, 0], [10, 0], [10, 10], [0, 0]]]}])
write("wide.geojson", [{"type": "Polygon", "coordinates": [[at(-60, 100), at(900, 150), at(850, 700), at(-60, 100)]]}])
PY
# GeoJSON has no other CRS than degrees; the points of a text have none.
options=(--breaklines dike.geojson --breaklines path.geojson --boundary site.geojson)
for effort in fast normal high; do
  succeeds "$scarp" simplify survey.csv cut.glb -e 1 --effort "$effort" "${options[@]}" --report cut.json --overwrite
  grep -q 'boundary      site.geojson: [0-9]* corners, [0-9,]* points outside' "$logs/out" || fail "the summary of the boundary"
  succeeds "$scarp" measure survey.csv cut.glb --fail-above 1 -q
done
python3 - <<'PY' || fail "the report of a boundary"
import json
r = json.load(open("cut.json"))
assert r["input"]["boundary"] == "site.geojson" and r["input"]["lines"] == 2, r["input"]
cut = r["input"]["boundary_cut"]
assert 10 <= cut["corners"] < 200 and cut["corners_beyond"] == 0 and 1500 < cut["points_outside"] < 3000, cut
assert r["max_error"] <= 1 and r["uncovered"] == 0 and r["topology"]["sound"] and r["topology"]["border_loops"] == 2, r
PY
succeeds "$scarp" simplify survey.csv site.obj -e 1 --boundary site.geojson --crs source --report site.json -q
succeeds "$scarp" measure survey.csv site.obj --boundary site.geojson --json
cp "$logs/out" judged.json
python3 - <<'PY' || fail "the report counts corners of the boundary as points"
import json
import math
made, judged = json.load(open("site.json")), json.load(open("judged.json"))
assert all(made[key] == judged[key] for key in ("samples", "max_error", "p95")), (made, judged)
assert made["input"]["points"] == judged["input"]["points"] and math.isclose(made["rmse"], judged["rmse"]), (made, judged)
PY
succeeds "$scarp" simplify survey.csv wide.glb -e 1 --boundary wide.geojson
grep -q '1 corner of --boundary lie up to 60' "$logs/err" || fail "no warning of a corner beyond the points"
refuses 2 "needs polygons" "$scarp" simplify survey.csv x.glb -e 1 --boundary dike.geojson
refuses 2 "no point lies within --boundary far.geojson" "$scarp" simplify survey.csv x.glb -e 1 --boundary far.geojson
for effort in fast normal high; do
  succeeds "$scarp" simplify survey.csv dike.glb -t 1500 --breaklines dike.geojson --effort $effort --report dike.json --overwrite
  holds "$(count dike.json) <= 1500 && $(count dike.json) > 1400" || fail "a budget with lines: $(count dike.json)"
done
refuses 1 "the lines and the outline of the points alone need" "$scarp" simplify survey.csv x.glb -t 9 --breaklines dike.geojson

# The surface as a raster.
succeeds "$scarp" simplify survey.csv dem.tif -e 1 --cell-size 10 -q
succeeds "$scarp" info dem.tif --no-suggest
grep -Eq '10[01] columns x 8[01] rows' "$logs/out" || fail "the size of the raster: $(cat "$logs/out")"
succeeds "$scarp" simplify survey.csv spaced.tif -e 0 --effort fast
grep -q 'cell size  *10$' "$logs/out" || fail "no cell size by the points' distance: $(cat "$logs/out")"
refuses 1 "no cell of 3000 has its centre on the surface" "$scarp" simplify survey.csv x.tif -e 1 --cell-size 3000
refuses 1 "no cell of 3000 has its centre on the surface" "$scarp" tile survey.csv x --cell-size 3000
# Tiles of points are those of that raster.
succeeds "$scarp" tile survey.csv at_once -e 1 --cells 32 --report at_once.json
grep -q 'points  *[0-9,]*, as a raster of cells 10 wide' "$logs/out" || fail "no word on the points: $(cat "$logs/out")"
succeeds "$scarp" tile spaced.tif in_steps -e 1 --cells 32
rm at_once/tileset.json in_steps/tileset.json # they name the input
diff -r at_once in_steps || fail "tiles of points differ from those of their raster"
[ "$(json at_once.json points cell_size)" = 10.0 ] || fail "the report lacks the cell size"
succeeds "$scarp" tile survey.csv west -e 1 --cells 32 --cell-size 25 --te 500000 4649000 500500 4649800 -q
refuses 1 "--band is for rasters, and survey.csv holds points" "$scarp" tile survey.csv x --band 2
refuses 1 "--class is for scattered points, and dem.tif is read as a raster" "$scarp" tile dem.tif x --class ground
refuses 2 "make one of them first" "$scarp" tile plan survey.csv x.json
refuses 1 "--cell-size is for rasters, and survey.csv holds points" "$scarp" simplify survey.csv x.glb -e 1 --cell-size 5
refuses 1 "choose larger" "$scarp" simplify survey.csv x.tif -e 1 --cell-size 1e-9

# Several files are one set of points.
head -n 1501 survey.csv >west.csv
{ head -n 1 survey.csv; tail -n +1502 survey.csv; } >east.csv
succeeds "$scarp" simplify west.csv east.csv both.ply -e 1 -q
succeeds "$scarp" simplify survey.csv whole.ply -e 1 -q
cmp <(sed '1,/end_header/d' both.ply) <(sed '1,/end_header/d' whole.ply) || fail "two files give another mesh than one"
succeeds "$scarp" measure west.csv east.csv both.ply --fail-above 1 -q
echo EPSG:32631 >east.prj
refuses 2 "east.csv has another CRS than west.csv: EPSG:32631 and none" "$scarp" simplify west.csv east.csv x.glb -e 1
refuses 1 "rasters are joined, and so are points, but not both" "$scarp" simplify west.csv "$dem" x.glb -e 1

# A rectangle of the points, which the judge remembers.
succeeds "$scarp" simplify survey.csv part.glb -e 1 --te 500100 4649100 500600 4649500
grep -q ' outside the rectangle left out' "$logs/out" || fail "the summary of a rectangle: $(cat "$logs/out")"
succeeds "$scarp" measure survey.csv part.glb --fail-above 1 -q
refuses 2 "none of its 4000 points lies in the rectangle of --te" "$scarp" simplify survey.csv x.glb -e 1 --te 0 0 1 1

# Shapes of triangles, also along a boundary and lines.
for effort in fast normal high; do
  succeeds "$scarp" simplify survey.csv shape.glb -e 1 --min-angle 25 --max-edge 90 --effort "$effort" "${options[@]}" \
    --report shape.json --overwrite -q
  succeeds "$scarp" measure survey.csv shape.glb --fail-above 1 -q
  python3 - <<'PY' || fail "shapes with $effort: $(python3 -c 'import json; print(json.load(open("shape.json"))["shape"])')"
import json
shape = json.load(open("shape.json"))["shape"]
assert shape["longest_edge"] <= 90 and shape["below"] < 20, shape
PY
done
succeeds "$scarp" simplify survey.csv shape.glb -t 1500 --min-angle 20 --report shape.json --overwrite
holds "$(count shape.json) <= 1500 && $(count shape.json) > 1400 && $(json shape.json shape below) <= 4" || fail "a budget with angles: $(count shape.json)"

# Outliers are dropped on request, and the judge remembers.
{ cat survey.csv; printf '500100.5,4649100.5,900\n500300.5,4649300.5,-200\n'; } >birds.csv
succeeds "$scarp" simplify birds.csv birds.glb -e 1 --duplicates first,despike=60
grep -q 'points *4000 (2 as outliers left out)' "$logs/out" || fail "the summary of outliers: $(cat "$logs/out")"
succeeds "$scarp" measure birds.csv birds.glb --fail-above 1 -q
refuses 3 "max error" "$scarp" measure birds.csv birds.glb --fail-above 1 -q --despike 1000
succeeds "$scarp" simplify birds.csv birds.glb -e 1 --despike 60 --report birds.json -q --overwrite
[ "$(python3 -c 'import json; print(json.load(open("birds.json"))["input"]["spikes"])')" = 2 ] || fail "the report of outliers"

# Files besides the mesh: picture, page, contours, the error of each point, and levels of detail.
succeeds "$scarp" simplify survey.csv all.glb -e 1 --preview all.png --html all.html --contours-out all.geojson,interval=10 \
  --error-raster all.csv --lods 3:2 --report all.json --boundary site.geojson
for level in 0 1 2; do succeeds "$scarp" measure survey.csv all_lod$level.glb --fail-above $((1 << level)) -q; done
succeeds "$scarp" measure survey.csv all_lod2.glb --error-raster judged.csv --json
cp "$logs/out" judged.json
python3 - <<'PY' || fail "files of points"
import csv, json
assert open("all.png", "rb").read(4) == b"\x89PNG" and b"all_lod2.glb" in open("all.html", "rb").read()
heights = {f["properties"]["elev"] for f in json.load(open("all.geojson"))["features"]}
assert len(heights) >= 7 and all(z % 10 == 0 for z in heights), heights
report = json.load(open("all.json"))
levels = report["levels"]
assert [level["asked"] for level in levels] == [1, 2, 4] and levels[0]["triangles"] > levels[1]["triangles"] > levels[2]["triangles"], levels
for table, largest, points in (("all.csv", report["max_error"], report["samples"]),
                               ("judged.csv", json.load(open("judged.json"))["max_error"], None)):
    rows = list(csv.DictReader(open(table)))
    errors = [abs(float(row["error"])) for row in rows if row["error"]]
    assert points is None or len(errors) == points, (len(errors), points)
    assert abs(max(errors) - largest) < 1e-6 * largest, (table, max(errors), largest)
given = {tuple(map(float, line.split(","))) for line in open("survey.csv").read().split()[1:]}
assert sum(tuple(float(row[k]) for k in "xyz") in given for row in csv.DictReader(open("judged.csv"))) > 1000
PY
refuses 1 "--error-raster x.tif: survey.csv holds points, whose errors are a table: name it .csv" \
  "$scarp" simplify survey.csv x.glb -e 1 --error-raster x.tif
refuses 4 "judged.csv exists already" "$scarp" measure survey.csv all_lod2.glb --error-raster judged.csv

# A text declares its CRS in a file next to it; volumes compare files in a local frame with others.
echo EPSG:32631 >survey.prj
succeeds "$scarp" simplify survey.csv utm.gpkg -e 1 --report utm.json -q
[ "$(python3 -c 'import json; print(json.load(open("utm.json"))["frame"]["crs"])')" = EPSG:32631 ] || fail "the declared CRS"
succeeds "$scarp" simplify survey.csv utm.ply -e 1 --crs source -q
succeeds "$scarp" simplify survey.csv local.glb -e 1 -q
succeeds "$scarp" measure utm.ply local.glb --volume
rm survey.prj
succeeds "$scarp" simplify survey.csv plain.xml -e 1 -q
succeeds "$scarp" simplify survey.csv plain.glb -e 1 -q
succeeds "$scarp" measure plain.xml plain.glb --volume
echo "surveys become terrain models"
