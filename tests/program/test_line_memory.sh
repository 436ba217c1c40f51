#!/usr/bin/env bash
# --breaklines and --rivers with --memory: lines cross strips whose samples stay in their file, and are chains of edges.
# The bound holds, any number of threads gives the same bytes, and the memory of lines counts.
source "$(dirname "$0")/lib.sh"
need python3

succeeds "$scarp" generate smooth 1300 1000 hills.tif --seed 3 -q
python3 - <<'PYTHON'
import json, math
def collection(name, lines):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": points}}
        for points in lines]}, open(name, "w"))
def spiral(turns, z):
    return [[650 + t * math.cos(t / 9), 500 + 0.7 * t * math.sin(t / 9)] + z for t in range(40, turns)]
collection("soft.geojson", [spiral(600, []), [[5.3, 7.1], [1290.7, 933.2]], [[-50, 512], [1400, 512]], [[300, 980], [300, 10.5]]])
collection("hard.geojson", [spiral(300, [900])])
collection("rivers.geojson", [[[100, 900], [400.5, 300], [900, 120.25]]])
PYTHON

small=76M # the samples alone are 5 MB, so they stay in their file, and strips are low
for lines in soft hard; do
  for effort in fast normal high; do
    by_threads hills.tif "$lines.obj" -e 12 --up z --effort "$effort" --breaklines "$lines.geojson" --memory "$small"
    python3 "$SCARP_SOURCE/tests/program/walk_lines.py" "$lines.obj" "$lines.geojson" 1300 1000 21 || fail "$lines lines are not in the mesh of $effort effort"
    holds "$(json r.json max_error) <= 12"
    if [ "$lines" = soft ]; then
      succeeds "$scarp" measure hills.tif soft.obj --fail-above 12
    else
      holds "$(json r.json breaklines largest_edit) >= 0"
    fi
  done
done
succeeds "$scarp" simplify hills.tif rivers.obj -e 12 --up z --rivers rivers.geojson --memory "$small" --report r.json --overwrite
holds "$(json r.json rivers 0 source) > $(json r.json rivers 0 mouth)"
holds "$(json r.json max_error) <= 12"

# Lines count: 300 bytes a vertex.
python3 -c "
import json
json.dump({'type': 'LineString', 'coordinates': [[i % 1300, i // 1300] for i in range(90000)]}, open('long.geojson', 'w'))"
refuses 1 "--memory $small is too little" "$scarp" simplify hills.tif x.obj -e 12 --up z --memory "$small" --breaklines long.geojson
