#!/usr/bin/env bash
# --cutline, --inset and --mask-outside with --memory: polygons cross strips whose samples stay in their file, and the
# remaining surface is the same as in memory.
source "$(dirname "$0")/lib.sh"
need python3 ogrinfo

succeeds "$scarp" generate smooth 1000 800 hills.tif --seed 3 -q
python3 - <<'PYTHON'
import json, math
def collection(name, *polygons):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring + ring[:1] for ring in rings]}}
        for rings in polygons]}, open(name, "w"))
star = [[550 + r * math.cos(a), 400 + 0.85 * r * math.sin(a)] for k in range(14) for a, r in [(k * math.pi / 7, 430 if k % 2 else 260)]]
hole = [[460.3, 330.2], [640.1, 370.7], [520.6, 530.4]]
# Along whole rows and columns of samples, and where strips may meet.
blocks = [[[[10, y], [110, y], [110, y + h], [10, y + h]]] for y, h in [(20, 80), (125, 125), (266, 1), (532, 250)]]
collection("star.geojson", [star, hole], *blocks)
collection("away.geojson", [[[-90, -90], [-80, -90], [-80, -80]]])
collection("line.geojson", [[[500, 100], [600, 100.5], [550.5, 330], [500, 700.25]]])
PYTHON

small=76M # the samples alone are 3 MB, so they stay in their file, and strips are low
cut=(--cutline star.geojson)
succeeds "$scarp" simplify hills.tif held.obj -e 12 --up z --effort fast "${cut[@]}" --report held.json
for effort in fast normal high max; do
  by_threads hills.tif cut1.obj -e 12 --up z --effort "$effort" "${cut[@]}" --memory "$small"
  holds "$(json r.json max_error) <= 12"
  agree r.json held.json "cutline samples_outside"
  python3 "$SCARP_SOURCE/tests/program/walk_lines.py" cut1.obj star.geojson 1000 800 100 || fail "rings are not in the mesh of $effort effort"
  python3 - <<'PYTHON' || fail "the mesh of $effort effort has another area than OGR says"
import json, subprocess
vertices, area = [], 0
for line in open("cut1.obj"):
    words = line.split()
    if words[:1] == ["v"]: vertices.append(tuple(map(float, words[1:3])))
    if words[:1] == ["f"]:
        a, b, c = (vertices[int(w.split("/")[0]) - 1] for w in words[1:])
        area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
said = subprocess.run(["ogrinfo", "-q", "-sql", "SELECT SUM(OGR_GEOM_AREA) AS area FROM star", "star.geojson"], capture_output=True, text=True).stdout
wanted = float(said.split("area (Real) =")[1])
rings = [ring for f in json.load(open("star.geojson"))["features"] for ring in f["geometry"]["coordinates"]]
length = sum(((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) ** 0.5 for ring in rings for p, q in zip(ring, ring[1:]))
assert abs(area - wanted) < length / 512, (area, wanted)
PYTHON
done

succeeds "$scarp" measure hills.tif cut1.obj "${cut[@]}" --fail-above 12 --memory "$small" --json
mv "$logs/out" streamed.json
succeeds "$scarp" measure hills.tif cut1.obj "${cut[@]}" --fail-above 12 --json
mv "$logs/out" measured.json
agree streamed.json measured.json max_error rmse samples "cutline samples_outside"

# With breaklines, moved inwards, with flats and angle goals, and with an empty result.
succeeds "$scarp" simplify hills.tif lines.obj -e 12 --up z "${cut[@]}" --breaklines line.geojson --inset 3 --memory "$small" --report lines.json
succeeds "$scarp" measure hills.tif lines.obj "${cut[@]}" --inset 3 --fail-above 12 --memory "$small"
holds "$(json lines.json cutline samples_outside) > $(json held.json cutline samples_outside)"
succeeds "$scarp" simplify hills.tif shape.obj -e 12 --up z "${cut[@]}" --min-angle 20 --memory 80M
succeeds "$scarp" measure hills.tif shape.obj "${cut[@]}" --fail-above 12 --memory "$small"
succeeds "$scarp" simplify hills.tif flats.obj -e 12 --up z "${cut[@]}" --detect-flats 20 --memory 80M
succeeds "$scarp" measure hills.tif flats.obj "${cut[@]}" --fail-above 12.5 --memory "$small"
refuses 2 "beside the raster" "$scarp" simplify hills.tif x.obj -e 12 --up z --memory "$small" \
  --cutline away.geojson

# Along cells of the grid: nodata as in memory.
succeeds "$scarp" simplify hills.tif mask1.obj -e 12 --up z --effort fast "${cut[@]}" --mask-outside --memory "$small" --report mask1.json
succeeds "$scarp" simplify hills.tif mask2.obj -e 12 --up z --effort fast "${cut[@]}" --mask-outside --report mask2.json
agree mask1.json mask2.json "cutline samples_outside" samples "input valid" "input min" "input max"
succeeds "$scarp" measure hills.tif mask1.obj "${cut[@]}" --mask-outside --fail-above 12 --memory "$small"
succeeds "$scarp" measure hills.tif mask2.obj "${cut[@]}" --mask-outside --fail-above 12 --memory "$small"
