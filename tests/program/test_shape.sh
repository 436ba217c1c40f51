#!/usr/bin/env bash
# --min-angle, --max-edge, --grade: meshes for simulation keep the bound, and their angles and edges, computed here from
# the files, satisfy the goals.
source "$(dirname "$0")/lib.sh"
need python3
shape_of=$SCARP_SOURCE/tests/program/shape_of.py

# The bundled raster, in degrees, as a mesh for flow solvers, with every effort and on any number of threads.
for effort in fast normal high; do
  succeeds "$scarp" simplify "$dem" one.2dm -e 20 --min-angle 25 --effort "$effort" -j 1 --report r.json --overwrite
  succeeds "$scarp" simplify "$dem" four.2dm -e 20 --min-angle 25 --effort "$effort" -j 4 --overwrite
  cmp one.2dm four.2dm || fail "-j 4 makes another mesh with $effort effort"
  read -r count smallest shortest longest < <(python3 "$shape_of" one.2dm)
  holds "$smallest >= 25"
  [ "$(json r.json shape below)" = 0 ] || fail "triangles with smaller angles are left"
  [ "$(json r.json topology sound)" = true ] || fail "$effort effort makes an unsound mesh"
  holds "$(json r.json shape min_angle) - $smallest < 0.0001 && $smallest - $(json r.json shape min_angle) < 0.0001"
  holds "$(json r.json shape longest_edge) - $longest < 1e-6 && $longest - $(json r.json shape longest_edge) < 1e-6"
  succeeds "$scarp" measure "$dem" one.2dm --fail-above 20
  counts="${counts:-} $count"
done
read -r fast normal high <<<"$counts"
holds "$normal < $fast && $high < $normal"
python3 - r.json <<'PYTHON' || fail "the histogram is not of all triangles"
import json, sys
report = json.load(open(sys.argv[1]))
assert len(report["shape"]["histogram"]) == 12
assert sum(report["shape"]["histogram"]) == report["triangles"]
assert not any(report["shape"]["histogram"][:5])
PYTHON

# In metres; the file's edges are no longer than requested.
succeeds "$scarp" simplify "$dem" short.obj -e 20 --up z --max-edge 400
read -r count smallest shortest longest < <(python3 "$shape_of" short.obj)
holds "$longest <= 400"
succeeds "$scarp" measure "$dem" short.obj --fail-above 20
succeeds "$scarp" simplify "$dem" graded.obj -e 60 --up z --grade 0.3 --min-angle 20 --max-edge 3000
read -r count smallest shortest longest < <(python3 "$shape_of" graded.obj)
holds "$smallest >= 20"
succeeds "$scarp" measure "$dem" graded.obj --fail-above 60

# Nodata, and lines that meet below the requested angle: these are counted, all others satisfy it.
succeeds "$scarp" simplify "$dem" plain.2dm -e 20 --report r.json --overwrite
[ "$(json r.json shape)" = null ] || fail "a report of shapes that nobody asked for"
succeeds "$scarp" generate smooth 60 50 hills.tif --seed 4 -q
echo '{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[5.2, 5.4], [50.3, 40.1], [9.7, 12.3]]}},
 {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[40, 5], [10.5, 40.25]]}}]}' >lines.geojson
for effort in fast high; do
  succeeds "$scarp" simplify hills.tif river.obj -e 10 --up z --min-angle 25 --breaklines lines.geojson --effort "$effort" --report r.json --overwrite
  [ "$(json r.json topology sound)" = true ] || fail "lines and angles make an unsound mesh"
  holds "$(json r.json shape forced) > 0 && $(json r.json shape forced) <= $(json r.json shape below)"
  holds "$(json r.json shape below) < 0.01 * $(json r.json triangles)"
  succeeds "$scarp" measure hills.tif river.obj --fail-above 10
done
succeeds "$scarp" simplify hills.tif river.obj -e 10 --up z --min-angle 25 --overwrite
grep -q "shape .*smallest angle .*asked 25" "$logs/out" || fail "the summary does not tell the smallest angle"

# Water stays flat up to its shore.
echo '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
 {"type": "Polygon", "coordinates": [[[10.3, 10.2], [30.6, 8.1], [33.2, 25.7], [15.4, 29.9], [10.3, 10.2]]]}}]}' >lake.geojson
for effort in fast normal high; do
  succeeds "$scarp" simplify hills.tif lake.obj -e 10 --up z --min-angle 25 --max-edge 3 --water lake.geojson --effort "$effort" \
    --report r.json --overwrite
  python3 - "$(json r.json water 0 level)" <<'PYTHON' || fail "a lake is not flat with $effort effort"
import sys
level, ring = float(sys.argv[1]), [(10.3, 10.2), (30.6, 8.1), (33.2, 25.7), (15.4, 29.9)]
nodes, wet = [], 0
for line in open("lake.obj"):
    word = line.split()
    if word and word[0] == "v":
        nodes.append(tuple(map(float, word[1:4])))
    elif word and word[0] == "f":
        t = [nodes[int(v.split("/")[0]) - 1] for v in word[1:4]]
        x, y = (sum(p[k] for p in t) / 3 for k in (0, 1))
        if all((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) > 0.2 for a, b in zip(ring, ring[1:] + ring[:1])):
            assert all(p[2] == level for p in t), t
            wet += 1
assert wet > 50, wet
PYTHON
done

# Samples next to a long shore leave few places to split it.
succeeds "$scarp" generate smooth 1200 60 flat.tif --seed 1 -q
echo '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",
 "coordinates": [[[57.7, 15.8], [1172.1, 9.4], [1137.5, 38.7], [41.8, 43.6], [57.7, 15.8]]]}}]}' >long.geojson
succeeds "$scarp" simplify flat.tif long.obj -e 10 --up z --max-edge 60 --water long.geojson --effort fast
read -r count smallest shortest longest < <(python3 "$shape_of" long.obj)
holds "$longest <= 60"

# Edges below the requested length are counted and reported.
succeeds "$scarp" simplify hills.tif short.obj -e 10 --up z --min-edge 3 --max-edge 20 --report r.json --overwrite
[ "$(json r.json shape asked_min_edge)" = 3.0 ] || fail "the report does not tell the shortest edge that was asked for"
holds "$(json r.json shape shorter) > 0 && $(json r.json shape longest_edge) <= 20"
grep -q 'shape .* shorter than 3 (.* for the max error)' "$logs/out" || fail "short edges are not told"
succeeds "$scarp" measure hills.tif short.obj --fail-above 10
succeeds "$scarp" simplify hills.tif short.obj -e 10 --up z --min-edge 3 --grade 0.2 --report r.json --overwrite
holds "$(json r.json shape shorter) > 0"
grep -q 'warning: --min-edge 3: .* for the max error or grade)' "$logs/err" || fail "no warning of edges that the grade makes short"

# Conflicting goals: angles have priority over the shortest edge, lines over angles. Violations are counted and warned
# about.
for effort in fast normal high; do
  succeeds "$scarp" simplify "$dem" both.2dm -e 20 --crs local --min-angle 25 --min-edge 150 --effort "$effort" --report r.json --overwrite
  read -r count smallest shortest longest < <(python3 "$shape_of" both.2dm)
  holds "$smallest >= 25 && $shortest < 150 && $(json r.json shape shorter) > 0 && $(json r.json shape below) == 0"
  tr -d , <"$logs/err" | grep -q "warning: --min-edge 150: $(json r.json shape shorter) edges left shorter down to" || fail "no warning of short edges"
  python3 - r.json <<'PYTHON' || fail "the report has no warning of short edges alone"
import json, sys
report = json.load(open(sys.argv[1]))
assert [w for w in report["warnings"] if w.startswith("--min-edge 150: ")] and not [w for w in report["warnings"] if "--min-angle 25: " in w]
PYTHON
done
echo '{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[5.2, 5.4], [50.3, 40.1], [9.7, 12.3]]}},
 {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[5.21, 5.45], [50.31, 40.2]]}}]}' >near.geojson
succeeds "$scarp" simplify hills.tif near.obj -e 10 --up z --min-angle 20 --breaklines near.geojson --report r.json --overwrite
holds "$(json r.json shape below) > $(json r.json shape forced) && $(json r.json shape below_beside_lines) > 0"
grep -q "warning: --min-angle 20: smaller angles are left in .* triangles, down to .* degrees (.* where lines or outline leave no room" "$logs/err" ||
  fail "no warning of small angles"
grep -q "no vertex could be added" "$logs/out" && fail "the summary still blames vertices that could not be added"

# More effort never needs more triangles, for all goals.
counts=
for effort in normal high; do
  succeeds "$scarp" simplify "$dem" graded.2dm -e 20 --crs local --min-angle 25 --max-edge 1500 --grade 0.3 --effort "$effort" --report r.json --overwrite
  counts="$counts $(json r.json triangles)"
  [ "$(json r.json strategy effort)" = "\"$effort\"" ] || fail "$effort effort is reported as another"
done
read -r normal high <<<"$counts"
holds "$high <= $normal"

# A coast moved inwards by far less than a sample has no edges far shorter than its own.
python3 - <<'PYTHON'
import json, math
ring = [[30 + (20 + math.sin(9 * a) + math.sin(53 * a) / 4) * math.cos(a), 25 + (18 + math.sin(7 * a) + math.sin(41 * a) / 4) * math.sin(a)]
        for a in (2 * math.pi * k / 300 for k in range(300))]
json.dump({"type": "Polygon", "coordinates": [ring + ring[:1]]}, open("coast.geojson", "w"))
PYTHON
counts=
for inset in 0 0.02; do
  succeeds "$scarp" simplify hills.tif coast.obj -e 10 --up z --min-angle 25 --cutline coast.geojson --inset "$inset" --report r.json --overwrite
  counts="$counts $(json r.json triangles)"
done
read -r whole moved <<<"$counts"
holds "$moved < 1.1 * $whole"

# Impossible requests are refused by name.
refuses 1 "--min-angle" "$scarp" simplify hills.tif x.obj -e 10 --min-angle 40
refuses 1 "--min-angle" "$scarp" simplify hills.tif x.obj -e 10 --min-angle some
refuses 1 "--max-edge" "$scarp" simplify hills.tif x.obj -e 10 --max-edge 0
refuses 1 "max edge" "$scarp" simplify hills.tif x.obj -e 10 --max-edge 0.01
refuses 1 "--min-edge 2 is more than half of --max-edge 3" "$scarp" simplify hills.tif x.obj -e 10 --max-edge 3 --min-edge 2
refuses 1 "--min-edge 0 is not above 0" "$scarp" simplify hills.tif x.obj -e 10 --min-edge 0
refuses 1 "--cliff cannot be combined with --min-edge" "$scarp" simplify hills.tif x.obj -e 10 --min-edge 2 --cliff 5
refuses 1 "--grade" "$scarp" simplify hills.tif x.obj -e 10 --grade -1
refuses 1 "the angles and edges alone need" "$scarp" simplify hills.tif x.obj -t 1 --min-angle 20
refuses 1 "--edges" "$scarp" simplify hills.tif x.obj -e 10 --edges data --min-angle 20
refuses 1 "--nodata-policy outline" "$scarp" simplify hills.tif x.obj -e 10 --outline-tolerance 2 --min-angle 20
refuses 1 "regular" "$scarp" simplify "$dem" x.obj -e 20 --crs EPSG:3857 --min-angle 20
