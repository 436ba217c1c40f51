#!/usr/bin/env bash
# --water: each lake is flat in the mesh, its shore is an edge, and the bound holds against the modified raster.
source "$(dirname "$0")/lib.sh"
need python3

python3 - <<'PYTHON'
import json
def layer(name, polygons):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": p}} for p in polygons]}, open(name, "w"))
west = [[[-84.38, 36.22], [-84.33, 36.21], [-84.31, 36.26], [-84.36, 36.27], [-84.38, 36.22]],
        [[-84.35, 36.235], [-84.34, 36.235], [-84.345, 36.245], [-84.35, 36.235]]]
layer("lakes.geojson", [west, [[[-84.2, 36.3], [-84.15, 36.31], [-84.17, 36.34], [-84.2, 36.3]]]])
layer("away.geojson", [[[[1, 1], [2, 1], [2, 2], [1, 1]]]])
PYTHON
for effort in fast normal high max; do
  succeeds "$scarp" simplify "$dem" lake.obj -e 20 --up z --effort "$effort" --water lakes.geojson --crs grid --report lake.json --overwrite
  holds "$(json lake.json max_error) <= 20"
  [ "$(json lake.json topology sound)" = true ] || fail "lakes and $effort effort make an unsound mesh"
  python3 - <<'PYTHON' || fail "a lake is not flat with $effort effort"
import json
report = json.load(open("lake.json"))
assert len(report["water"]) == 2 and all(lake["edited_samples"] > 300 for lake in report["water"]), report["water"]
vertices, faces = [], []
for line in open("lake.obj"):
    words = line.split()
    if words[:1] == ["v"]: vertices.append(tuple(map(float, words[1:4])))
    if words[:1] == ["f"]: faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
column = lambda lon: (lon + 84.41375) / 0.000833333333333 - 0.5
line = lambda lat: 343 - ((36.44625 - lat) / 0.000833333333333 - 0.5)
west = [(-84.38, 36.22), (-84.33, 36.21), (-84.31, 36.26), (-84.36, 36.27)]
island = [(-84.35, 36.235), (-84.34, 36.235), (-84.345, 36.245)]
def side(ring, x, y, margin):
    points = [(column(a), line(b)) for a, b in ring]
    least = min(((qx - px) * (y - py) - (qy - py) * (x - px)) / ((qx - px) ** 2 + (qy - py) ** 2) ** 0.5
                for (px, py), (qx, qy) in zip(points, points[1:] + points[:1]))
    return least > margin
flat = 0
for face in faces:
    x, y = (sum(vertices[v][k] for v in face) / 3 for k in (0, 1))
    if side(west, x, y, 0.02) and not side(island, x, y, -0.02):
        assert all(vertices[v][2] == report["water"][0]["level"] for v in face), [vertices[v] for v in face]
        flat += 1
assert flat > 0
PYTHON
done
succeeds "$scarp" simplify "$dem" one.glb -e 20 --water lakes.geojson -j 1
succeeds "$scarp" simplify "$dem" two.glb -e 20 --water lakes.geojson -j 2
cmp one.glb two.glb || fail "-j 2 makes another mesh"
succeeds "$scarp" simplify "$dem" high.glb -e 20 --water lakes.geojson --water-percentile 50 --report high.json
holds "$(json high.json water 0 level) > $(json lake.json water 0 level)"
succeeds "$scarp" simplify "$dem" away.glb -e 20 --water away.geojson
grep -q "no lake in the raster" "$logs/err" || fail "no warning that a lake lies beside the raster"

# Unchanged flat areas, and rivers that never rise: followed in the file.
# Their courses pass every sample at more than the distance of moved vertices.
cat > courses.py <<'PYTHON'
courses = [[(20.3, 293.1), (80.3, 53.1), (200.3, 113.1)], [(200.3, 113.1), (260.3, 233.1), (310.3, 283.1)]]
PYTHON
python3 - <<'PYTHON'
import json
from courses import courses
lon = lambda column: -84.41375 + (column + 0.5) * 0.000833333333333
lat = lambda line: 36.44625 - (343 - line + 0.5) * 0.000833333333333
def river(points): return {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [(lon(x), lat(y)) for x, y in points]}}
json.dump({"type": "FeatureCollection", "features": [
    river(points) for points in courses]},
    open("rivers.geojson", "w"))
PYTHON
for effort in fast normal high; do
  succeeds "$scarp" simplify "$dem" river.obj -e 20 --up z --effort "$effort" --detect-flats 12 --rivers rivers.geojson --crs grid \
    --report river.json --overwrite
  holds "$(json river.json max_error) <= 20"
  python3 - <<'PYTHON' || fail "a river rises with $effort effort"
import json
report = json.load(open("river.json"))
assert len(report["rivers"]) == 2 and len(report["water"]) > 0, report["rivers"]
assert all(r["source"] >= r["mouth"] and r["deepest_cut"] > 0 for r in report["rivers"])
assert all(lake["edited_samples"] == 0 for lake in report["water"])
vertices, edges = [], set()
for line in open("river.obj"):
    words = line.split()
    if words[:1] == ["v"]: vertices.append(tuple(map(float, words[1:4])))
    if words[:1] == ["f"]:
        face = [int(w.split("/")[0]) - 1 for w in words[1:]]
        edges |= {tuple(sorted((face[k], face[k - 1]))) for k in range(3)}
from courses import courses
for river, places in zip(report["rivers"], courses):
    if river["turned"]: places.reverse()
    heights = []
    for (px, py), (qx, qy) in zip(places, places[1:]):
        length2 = (qx - px) ** 2 + (qy - py) ** 2
        near = []
        for v, (x, y, z) in enumerate(vertices):
            along = ((x - px) * (qx - px) + (y - py) * (qy - py)) / length2
            across = abs((qx - px) * (y - py) - (qy - py) * (x - px)) / length2 ** 0.5
            if across < 0.0061 and -1e-4 < along < 1 + 1e-4: near.append((along, v))
        near.sort()
        assert len(near) > 1 and all(tuple(sorted((a, b))) in edges for (_, a), (_, b) in zip(near, near[1:])), near[:5]
        heights += [vertices[v][2] for _, v in near]
    assert all(a >= b for a, b in zip(heights, heights[1:])), heights
    assert heights[0] == river["source"] and heights[-1] == river["mouth"], (heights[0], heights[-1], river)
PYTHON
done
succeeds "$scarp" simplify "$dem" both.glb -e 20 --water lakes.geojson --rivers rivers.geojson
refuses 1 "--water" "$scarp" simplify "$dem" x.glb -e 20 --water lakes.geojson --detect-flats 12
refuses 1 "--water flats 2 is not a whole number of at least 3" "$scarp" simplify "$dem" x.glb -e 20 --detect-flats 2

# Two lakes of different levels with a common shore are a conflict, named with a remedy.
python3 - <<'PYTHON'
import json
def lake(x): return {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [
    [[x, 36.25], [x + 0.03, 36.25], [x + 0.03, 36.28], [x, 36.28], [x, 36.25]]]}}
json.dump({"type": "FeatureCollection", "features": [lake(-84.30), lake(-84.27)]}, open("side.geojson", "w"))
json.dump({"type": "FeatureCollection", "features": [lake(-84.30), lake(-84.30)]}, open("twice.geojson", "w"))
PYTHON
refuses 2 "side.geojson feature 0 has the height" "$scarp" simplify "$dem" x.glb -e 20 --water side.geojson
succeeds "$scarp" simplify "$dem" side.glb -e 20 --water side.geojson --line-conflict highest
succeeds "$scarp" simplify "$dem" twice.glb -e 20 --water twice.geojson

refuses 1 "--vertices free" "$scarp" simplify "$dem" x.glb -e 20 --effort high --vertices free --water lakes.geojson
refuses 1 "--water percentile 101 is above 100" "$scarp" simplify "$dem" x.glb -e 20 --water lakes.geojson --water-percentile 101
refuses 1 "--water" "$scarp" simplify "$dem" x.glb -e 20 --water-percentile 10
refuses 2 "nothing.gpkg" "$scarp" simplify "$dem" x.glb -e 20 --water nothing.gpkg

# The stream of the examples follows its valley; a line over a spur is reported with a remedy that works.
succeeds "$scarp" simplify "$dem" stream.glb -e 20 --rivers "$data/examples/streams.geojson" --report stream.json
! grep -q "below the raster, for" "$logs/err" || fail "the stream of the examples crosses higher ground"
python3 -c 'import json; assert max(r["deepest_cut"] for r in json.load(open("stream.json"))["rivers"]) < 20' ||
  fail "the stream of the examples cuts into the raster"
cmp "$data/examples/streams.geojson" <(python3 "$SCARP_SOURCE/tools/make_example_stream.py") || fail "the stream is another"
python3 - <<'PYTHON'
import json
json.dump({"type": "Feature", "properties": {}, "geometry": {"type": "LineString",
    "coordinates": [[-84.24667, 36.3625], [-84.2825, 36.385], [-84.25917, 36.34833]]}}, open("spur.geojson", "w"))
PYTHON
succeeds "$scarp" simplify "$dem" spur.obj -e 5 --rivers spur.geojson
grep -Eq "warning: --rivers: spur.geojson feature 0 runs up to [0-9.]+ below the raster, for it crosses higher ground" "$logs/err" ||
  fail "a river through a spur is not told"
succeeds "$scarp" simplify "$dem" spur.obj -e 5 --breaklines spur.geojson --soft-breaklines --overwrite
[ ! -s "$logs/err" ] || fail "a line on the raster is warned of"
