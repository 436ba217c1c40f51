#!/usr/bin/env bash
# --water with --rivers, and --detect-flats, with --memory: the lakes equal those of a raster in memory and are level
# across all strips. Any number of threads gives the same bytes, and the memory of lakes counts.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

succeeds "$scarp" generate smooth 1100 1000 smooth.tif --seed 3 --range 300 -q
# Integer heights, and a sea over low land.
gdal_translate -q -ot Byte -scale 100 355 0 255 -a_nodata none smooth.tif sea.tif
python3 - <<'PYTHON'
import json
def layer(name, kind, geometries):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": g}} for g in geometries]}, open(name, "w"))
west = [[[60.3, 80.2], [420.7, 60.4], [380.2, 930.1], [100.6, 905.5], [60.3, 80.2]],
        [[200.4, 400.3], [260.2, 410.6], [230.8, 500.9], [200.4, 400.3]]]
layer("lakes.geojson", "Polygon", [west, [[[900, 300], [1200, 350], [1000, 700], [900, 300]]], [[[5, 5], [8, 5], [8, 9], [5, 5]]],
                                   [[[2000, 5], [2100, 5], [2000, 90], [2000, 5]]]])
layer("rivers.geojson", "LineString", [[[20.3, 990.2], [250.6, 700.4], [700.2, 500.7], [1090.8, 20.3]]])
PYTHON

small=76M # the samples stay in their file, and strips are low
check() { # check NAME RASTER EFFORT OPTION...: runs with --memory, and compares the report with that of a run without
  local name=$1 raster=$2 effort=$3
  shift 3
  [ -e "$name.held" ] || succeeds "$scarp" simplify "$raster" held.obj -e 6 --up z --effort fast "$@" --report "$name.held" --overwrite
  by_threads "$raster" "$name.obj" -e 6 --up z --effort "$effort" "$@" --memory "$small"
  mv r.json "$name.json"
  holds "$(json "$name.json" max_error) <= 6"
  agree "$name.json" "$name.held" input water rivers
}

for effort in fast normal high; do
  check lakes smooth.tif "$effort" --water lakes.geojson --rivers rivers.geojson
  python3 - lakes.json lakes.obj <<'PYTHON' || fail "a lake is not flat with $effort effort"
import json, sys
lakes = json.load(open(sys.argv[1]))["water"]
assert len(lakes) == 3 and lakes[0]["edited_samples"] > 200000, lakes
level, vertices, flat = lakes[0]["level"], [], 0
for line in open(sys.argv[2]):
    words = line.split()
    if words[:1] == ["v"]: vertices.append(tuple(map(float, words[1:4])))
    if words[:1] != ["f"]: continue
    corners = [vertices[int(w.split("/")[0]) - 1] for w in words[1:]]
    x, y = (sum(c[k] for c in corners) / 3 for k in (0, 1))
    is_island = 195 < x < 265 and 395 < y < 505
    if 105 < x < 375 and 90 < y < 900 and not is_island:
        assert all(c[2] == level for c in corners), corners
        flat += 1
assert flat > 10, flat
PYTHON
  check flats sea.tif "$effort" --detect-flats 5000
  [ "$(json flats.json water 0 level)" = 0.0 ] || fail "the sea is no flat area"
  succeeds "$scarp" measure sea.tif flats.obj --fail-above 6
done
check voids sea.tif normal --nodata 0 --water lakes.geojson

# Shores count: 300 bytes a vertex, and 100 a sample.
python3 -c "
import json
ring = [[i % 1000 + i / 90000, i // 1000 * 5 + 3.5 * (i % 2)] for i in range(90000)]
json.dump({'type': 'Polygon', 'coordinates': [ring + ring[:1]]}, open('long.geojson', 'w'))"
refuses 1 "--memory $small is too little: " "$scarp" simplify smooth.tif x.obj -e 6 --up z --memory "$small" --water long.geojson
refuses 1 "--memory $small is too little: flat areas and their shores take" "$scarp" simplify sea.tif x.obj -e 6 --up z \
  --memory "$small" --detect-flats 3
