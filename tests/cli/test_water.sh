#!/usr/bin/env bash
# --water: each lake is flat in the mesh, its shore is there, and the bound holds against the raster as it is then.
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
  succeeds "$scarp" simplify "$dem" lake.obj -e 20 --effort "$effort" --water lakes.geojson --crs grid --report lake.json --overwrite
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
refuses 1 "--vertices free" "$scarp" simplify "$dem" x.glb -e 20 --effort high --vertices free --water lakes.geojson
refuses 1 "--max-triangles" "$scarp" simplify "$dem" x.glb -t 100 --water lakes.geojson
refuses 1 "--water-percentile" "$scarp" simplify "$dem" x.glb -e 20 --water lakes.geojson --water-percentile 101
refuses 1 "--water" "$scarp" simplify "$dem" x.glb -e 20 --water-percentile 10
refuses 2 "nothing.gpkg" "$scarp" simplify "$dem" x.glb -e 20 --water nothing.gpkg
