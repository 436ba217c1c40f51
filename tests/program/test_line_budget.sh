#!/usr/bin/env bash
# Budgets of meshes with lines, water, walls and cutlines: they are kept, and the mesh is that of the error found. Too
# small a budget is refused with the least sufficient one.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

succeeds "$scarp" generate smooth 120 90 hills.tif --seed 3 -q
python3 - <<'PYTHON'
import json
def collection(name, features):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": points}}
        for kind, points in features]}, open(name, "w"))
collection("soft.geojson", [("LineString", [[5.3, 7.1], [90.7, 33.2], [110.2, 80.9]]), ("LineString", [[20, 80], [100.5, 3.25]])])
collection("lake.geojson", [("Polygon", [[[30, 20], [45, 22], [40, 36], [30, 20]]])])
collection("river.geojson", [("LineString", [[5, 60], [60, 55], [110, 70]])])
collection("ring.geojson", [("Polygon", [[[10.2, 5], [110, 15.5], [90, 70], [60, 80.5], [10.2, 5]]])])
# A rotated house with two storeys.
rows = []
for y in range(60):
    rows.append(" ".join(str(20 + 0.02 * (x * y % 17) if abs(x - 30 + 0.3 * y) < 12 and 10 < y < 50 else 2 + 0.3 * ((x * x + 3 * y * y) % 7)) for x in range(60)))
open("house.asc", "w").write("ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + "\n".join(rows) + "\n")
PYTHON

# check RASTER OPTIONS...: 400 triangles are kept on any number of threads; fast effort's mesh is that of its error.
check() {
  local raster=$1 effort
  shift
  for effort in fast normal; do
    succeeds "$scarp" simplify "$raster" one.obj -t 400 --effort "$effort" "$@" -j 1 --report r.json --overwrite
    succeeds "$scarp" simplify "$raster" two.obj -t 400 --effort "$effort" "$@" -j 2 --overwrite
    cmp one.obj two.obj || fail "-j 2 makes another mesh with $* and $effort effort"
    holds "$(json r.json triangles) <= 400"
    [ "$(json r.json stopped_by)" = '"max_triangles"' ] || fail "$* $effort: stopped by $(json r.json stopped_by)"
    [ "$(json r.json topology sound)" = true ] || fail "$* and $effort effort make an unsound mesh"
    eval "error_$effort=$(json r.json max_error)"
  done
  # shellcheck disable=SC2154
  holds "$error_normal <= $error_fast"
  refuses 1 "1 triangle is too few: the lines and the outline of the valid data alone need" "$scarp" simplify "$raster" x.obj -t 1 "$@"
  least=$(sed 's/.* need \([0-9]*\);.*/\1/' "$logs/err")
  refuses 1 "alone need $least;" "$scarp" simplify "$raster" x.obj -t $((least - 1)) "$@"
  succeeds "$scarp" simplify "$raster" least.obj -t "$least" "$@" --report r.json --overwrite
  [ "$(json r.json triangles)" = "$least" ] || fail "$*: $(json r.json triangles) triangles instead of $least"
}
check hills.tif --breaklines soft.geojson
check hills.tif --water lake.geojson
check hills.tif --rivers river.geojson
check hills.tif --cutline ring.geojson
check house.asc --cliff 3
holds "$(json r.json cliffs walls) >= 1"
check hills.tif --breaklines soft.geojson --rivers river.geojson --cutline ring.geojson

# Vertices are counted as well, and a feasible max error is a goal.
succeeds "$scarp" simplify hills.tif points.obj -p 300 --breaklines soft.geojson --report r.json --overwrite
holds "$(json r.json vertices) <= 300"
succeeds "$scarp" simplify hills.tif error.obj -t 5000 -e 40 --breaklines soft.geojson --report r.json --overwrite
[ "$(json r.json stopped_by)" = '"max_error"' ] || fail "an error that fits is not reached"
holds "$(json r.json max_error) <= 40"

# Samples with individual bounds.
gdal_translate -q -ot Float32 -scale 0 300 1 4 hills.tif bounds.tif
for bounds in --mask --tolerance; do
  succeeds "$scarp" simplify hills.tif bounded.obj -t 1000 $bounds bounds.tif --breaklines soft.geojson --report r.json --overwrite
  holds "$(json r.json triangles) <= 1000"
done
holds "1 < $(json r.json weighted_max_error) && $(json r.json weighted_max_error) <= $(json r.json tolerance_factor)"
succeeds "$scarp" simplify hills.tif x.stl -t 1000 --breaklines soft.geojson --solid size=90mm --split 2x1 --report r.json --overwrite
holds "$(json r.json triangles) <= 1000"
