#!/usr/bin/env bash
# --roi and --tolerance of scattered points: each point has its own bound, judged here by brute force.
source "$(dirname "$0")/lib.sh"
need awk python3 gdal_translate

awk 'BEGIN { srand(3); print "x,y,z"
  for (i = 0; i < 2500; i++) { x = rand() * 1000; y = rand() * 800
    printf "%.2f,%.2f,%.3f\n", 500000 + x, 4000000 + y, 300 + 30 * sin(x / 90) * cos(y / 70) + rand() } }' >survey.csv
echo EPSG:32616 >survey.prj
python3 - <<'PY'
import json
def layer(name, kind, coordinates):
    json.dump({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32616"}}, "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": coordinates}}]}, open(name, "w"))
ring = lambda x0, y0, x1, y1: [[x, y] for x, y in [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]]
place = lambda x, y: [500000 + x, 4000000 + y]
layer("site.geojson", "Polygon", [ring(*place(200, 200), *place(500, 500)), ring(*place(300, 300), *place(400, 400))])
layer("road.geojson", "LineString", [place(0, 650), place(1000, 650)])
layer("edge.geojson", "Polygon", [ring(*place(50, 50), *place(950, 750))])
layer("away.geojson", "Polygon", [ring(*place(5000, 0), *place(6000, 100))])
# Tolerances of 0.2 and 0.6 in two halves of a raster that ends at 500 m; one pixel has no value.
rows = ["ncols 5", "nrows 8", f"xllcorner {place(0, 0)[0]}", f"yllcorner {place(0, 0)[1]}", "cellsize 100", "NODATA_value -9999"]
rows += [" ".join("-9999" if (row, col) == (0, 4) else "0.2" if col < 3 else "0.6" for col in range(5)) for row in range(8)]
open("accuracy.asc", "w").write("\n".join(rows) + "\n")
open("minus.asc", "w").write("\n".join(rows[:-1] + ["-1 1 1 1 1"]) + "\n")
PY
gdal_translate -q -a_srs EPSG:32616 accuracy.asc accuracy.tif
gdal_translate -q -a_srs EPSG:32616 minus.asc minus.tif
gdal_translate -q -a_srs EPSG:32617 accuracy.asc elsewhere.tif
gdal_translate -q -b 1 -b 1 accuracy.tif stack.tif

cat >judge.py <<'PY'
import math, sys
bound_of = {
    "roi": lambda x, y: 0.1 if in_site(x, y) else 2,
    "falloff": lambda x, y: min(0.1 + 1.9 * min(1, to_site(x, y) / 150), 0.5 + 1.5 * min(1, abs(y - 650) / 150)),
    "tolerance": lambda x, y: 2 if x >= 500 or (x >= 400 and y >= 700) else 0.2 if x < 300 else 0.6,
}[sys.argv[2]]
in_site = lambda x, y: 200 <= x <= 500 and 200 <= y <= 500 and not (300 < x < 400 and 300 < y < 400)
def to_box(x, y, low, high): return math.hypot(max(low - x, 0, x - high), max(low - y, 0, y - high))
def to_site(x, y):
    if in_site(x, y): return 0
    return min(x - 300, 400 - x, y - 300, 400 - y) if 300 < x < 400 and 300 < y < 400 else to_box(x, y, 200, 500)
lines = [line.split() for line in open(sys.argv[1])]
places = {int(w[1]): tuple(map(float, w[2:5])) for w in lines if w and w[0] == "ND"}
faces = [tuple(places[int(k)] for k in w[2:5]) for w in lines if w and w[0] == "E3T"]
buckets = {}
for face in faces:
    columns, rows = ([int(p[k] // 50) for p in face] for k in (0, 1))
    for column in range(min(columns), max(columns) + 1):
        for row in range(min(rows), max(rows) + 1): buckets.setdefault((column, row), []).append(face)
points = [tuple(map(float, line.split(","))) for line in open("survey.csv").readlines()[1:]]
few, largest, judged = 0, 0, 0
for x, y, z in points:
    error = None
    for a, b, c in buckets.get((int(x // 50), int(y // 50)), ()):
        whole = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / whole
        v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / whole
        if min(u, v, 1 - u - v) >= -1e-9: error = max(error or 0, abs(u * a[2] + v * b[2] + (1 - u - v) * c[2] - z))
    if error is None: continue
    judged += 1
    bound = bound_of(x - 500000, y - 4000000)
    assert error <= bound + 1e-6, (x, y, error, bound)
    few += bound < 2
    largest = max(largest, error)
assert few > 100 and largest > 1 and judged >= int(sys.argv[3]), (few, largest, judged)
PY
for effort in fast normal high; do
  succeeds "$scarp" simplify survey.csv roi.2dm -e 2 --roi site.geojson=0.1 --effort "$effort" --report roi.json --overwrite
  python3 judge.py roi.2dm roi 2500 || fail "--roi with $effort effort"
  succeeds "$scarp" simplify survey.csv falloff.2dm -e 2 --roi site.geojson=0.1,falloff=150 --roi road.geojson=0.5 --effort "$effort" --overwrite
  python3 judge.py falloff.2dm falloff 2500 || fail "falloff with $effort effort"
  succeeds "$scarp" simplify survey.csv tolerance.2dm -e 2 --tolerance accuracy.tif --effort "$effort" --overwrite
  python3 judge.py tolerance.2dm tolerance 2500 || fail "--tolerance with $effort effort"
done
grep -q 'tolerances    1[0-9]* points, all kept' "$logs/out" || fail "the summary does not count points with tolerances"
[ "$(json roi.json strategy roi)" = '["site.geojson=0.1"]' ] || fail "the report does not name the region"
holds "$(json roi.json with_tolerance) > 150"
for unit in 10cm,falloff=150m 100e-3m,falloff=15000cm; do
  succeeds "$scarp" simplify survey.csv units.2dm -e 2 --roi site.geojson=$unit --roi road.geojson=0.5m --overwrite
  python3 judge.py units.2dm falloff 2500 || fail "units of a region: $unit"
done
awk -F, 'NR == 1 { print; next } { printf "%s,%s,%.9f\n", $1, $2, $3 / 0.3048 }' survey.csv >feet.csv
cp survey.prj feet.prj
succeeds "$scarp" simplify feet.csv in_feet.2dm -e 2m --z-unit ft --roi site.geojson=10cm
succeeds "$scarp" measure feet.csv in_feet.2dm --z-unit ft --fail-above 2m --roi site.geojson=10cm
try "$scarp" measure feet.csv in_feet.2dm --z-unit ft --fail-above 2m --roi site.geojson=1cm
[ "$code" = 3 ] || fail "a region in feet"
sed 's/,/ /g; 1d' survey.csv >bare.xyz
refuses 1 "--roi falloff 150m is a length, and the unit of x and y is unknown: give a number in that unit" \
  "$scarp" simplify bare.xyz x.2dm -e 2 --columns enz --roi site.geojson=0.1,falloff=150m
# With lines, a boundary and angles.
succeeds "$scarp" simplify survey.csv cut.2dm -e 2 --roi site.geojson=0.1 --boundary edge.geojson --breaklines road.geojson,soft
python3 judge.py cut.2dm roi 1900 || fail "--roi with a boundary and lines"
succeeds "$scarp" simplify survey.csv angles.2dm -e 2 --roi site.geojson=0.1 --min-angle 20
python3 judge.py angles.2dm roi 2500 || fail "--roi with --min-angle"

succeeds "$scarp" measure survey.csv roi.2dm --roi site.geojson=0.1 --fail-above 2 --json
grep -q '"over_tolerance": 0' "$logs/out" || fail "measure does not count points above their tolerance"
succeeds "$scarp" measure survey.csv tolerance.2dm --tolerance accuracy.tif
succeeds "$scarp" simplify survey.csv plain.2dm -e 2
refuses 3 "points is above the tolerance there, such as 1." "$scarp" measure survey.csv plain.2dm --roi site.geojson=0.1 -q
refuses 3 "a tolerance of 0 cannot be kept" "$scarp" simplify survey.csv x.glb -e 2 --roi site.geojson=0
succeeds "$scarp" simplify survey.csv exact.ply -e 2 --roi site.geojson=0 --double
succeeds "$scarp" measure survey.csv exact.ply --fail-above 2 --roi site.geojson=0
grep -q 'verdict             keeps 2 and the tolerances' "$logs/out" || fail "measure does not say that tolerances are kept"
refuses 3 "is above the tolerance there" "$scarp" measure survey.csv plain.2dm --tolerance accuracy.tif -q
succeeds "$scarp" simplify survey.csv away.2dm -e 2 --roi away.geojson=0.1
grep -q "lowers the error of no point: none lies in it" "$logs/err" || fail "no warning of a region without points"
cmp <(grep -E '^(ND|E3T)' away.2dm) <(grep -E '^(ND|E3T)' plain.2dm) || fail "a region without points changes the mesh"
refuses 1 "--roi of points needs --max-error, the error of all others" "$scarp" simplify survey.csv x.glb --roi site.geojson=0.1
succeeds "$scarp" simplify survey.csv budget.2dm -e 0.2 -t 500 --tolerance accuracy.tif --report budget.json
[ "$(json budget.json triangles)" -le 500 ] || fail "a budget with tolerances: $(json budget.json triangles)"
grep -q "points, all kept times $(printf %.2s "$(json budget.json tolerance_factor)")" "$logs/out" || fail "no factor of the tolerances"
refuses 2 "gdalwarp -t_srs EPSG:32616 elsewhere.tif" "$scarp" simplify survey.csv x.glb -e 2 --tolerance elsewhere.tif
succeeds "$scarp" simplify survey.csv stack.2dm -e 2 --tolerance stack.tif
grep -q 'stack.tif: has 2 bands, and its first alone is taken for the values' "$logs/err" || fail "a band is chosen without a word"
refuses 2 "minus.tif: the tolerance -1 in column 0, row 7 is negative" "$scarp" simplify survey.csv x.glb -e 2 --tolerance minus.tif
refuses 2 "accuracy.asc" "$scarp" simplify survey.csv x.glb -e 2 --tolerance nowhere/accuracy.asc
