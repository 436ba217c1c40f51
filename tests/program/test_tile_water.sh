#!/usr/bin/env bash
# scarp tile --water, --rivers: lakes and rivers in the nodes, equal in all tiles, levels and processes.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate
reader=$SCARP_SOURCE/tests/program/tiles.py
# The tiles of levels 10 and 5 that contain the middle of the lake.
lake_tiles() {
  python3 - "$1" <<'PYTHON'
step = 180 / 2 ** 18
col, row = 128 * 8 * 34 - 201 + 200, 128 * 8 * 17 - 171 + 130
for z in (10, 5):
    side = 128 << (11 - z)
    print(f"{z}/{col // side}/{2 ** z - 1 - row // side}")
PYTHON
}
export PYTHONPATH=$SCARP_SOURCE/tests/program

# A raster whose samples are the nodes of level 11, and a lake across the corner of four tiles of every level from 8 on.
python3 - > places <<'PYTHON'
import json
step = 180 / 2 ** 18
col, row = 128 * 8 * 34 - 201, 128 * 8 * 17 - 171
west, north = col * step - 180, 90 - row * step
def at(x, y):
    return [west + (x + 0.31) * step, north - (y + 0.17) * step]
def write(name, kind, *shapes):
    features = [{"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": shape}} for shape in shapes]
    json.dump({"type": "FeatureCollection", "features": features}, open(name, "w"))
lake = [(90.24, 120.54), (200.9, 90.38), (310.68, 130.35), (290.32, 240.33), (200.81, 200.84), (120.9, 250.79), (90.24, 120.54)]
island = [(190.26, 150.46), (230.12, 150.81), (210.06, 180.32), (190.26, 150.46)]
write("lake.geojson", "Polygon", [[at(*p) for p in lake], [at(*p) for p in island]])
write("other.geojson", "Polygon", [[at(x + 20, y) for x, y in lake], [at(*p) for p in island]])
write("river.geojson", "LineString", [at(20, 20), at(100, 60), at(150, 140)], [at(280, 200), at(330, 260), at(380, 330)])
write("ring.geojson", "Polygon", [[[-150, 80], [-50, 80], [50, 80], [150, 80], [-150, 80]]])
print(repr(west - step / 2), repr(north + step / 2), repr(west + 402.5 * step), repr(north - 343.5 * step))
PYTHON
read -r west north east south < places
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr "$west" "$north" "$east" "$south" "$dem" land.tif
gdal_translate -q -of XYZ land.tif land.xyz

# The water level equals that of the same lake in a mesh, and every node is within the bound of the tiles.
succeeds "$scarp" simplify land.tif mesh.glb -e 20 --water lake.geojson --report mesh.json -q
succeeds "$scarp" tile land.tif globe --water lake.geojson --report r.json -j 1
grep -q "water          1 lake at" "$logs/out" || fail "the summary does not tell the lake"
level=$(json r.json water lakes 0 level)
holds "($level - $(json mesh.json water 0 level)) ^ 2 < 1e-8"
python3 "$reader" globe > /dev/null || fail "neighbours differ over the lake"
succeeds python3 "$SCARP_SOURCE/tests/program/tile_water.py" globe land.xyz lake.geojson "$level" 3

# Rivers: the same set by threads, shares, and a served plan; the checker finds water through the plan.
both=(--water lake.geojson --rivers river.geojson)
succeeds "$scarp" tile land.tif both "${both[@]}" -j 3
grep -q "2 rivers" "$logs/out" || fail "the summary does not tell the rivers"
python3 "$reader" both > /dev/null || fail "neighbours differ over the rivers"
diff -rq globe both > /dev/null && fail "the rivers change nothing"
succeeds "$scarp" tile plan land.tif a.json "${both[@]}" -q
for share in 3/3 1/3 2/3; do succeeds "$scarp" tile run a.json --shard $share -q; done
succeeds "$scarp" tile finish a.json parts -q
diff -r both parts || fail "three shares make another set"
succeeds "$scarp" tile check both --source a.json
try "$scarp" tile check both --source land.tif -q
[ "$code" = 3 ] || fail "the land without water has the same nodes: $code"
python3 - a.json <<'PYTHON'
import base64, json, struct, sys
plan = json.load(open(sys.argv[1]))
waters = plan["pyramid"]["waters"]
level = waters["lakes"][0]["level"]
assert len(waters["rivers"]) == 2 and plan["waters"]["rivers"][0].startswith("/")
for river in waters["rivers"]:
    course = list(struct.iter_unpack("<3d", base64.b64decode(river["course"])))
    heights = [z for _, _, z in course]
    assert len(course) > 5 and heights == sorted(heights, reverse=heights[0] > heights[-1])
# The first river flows into the lake, the second out of it.
assert {level} == {min(abs(z - level) for _, _, z in struct.iter_unpack("<3d", base64.b64decode(r["course"]))) + level
                   for r in waters["rivers"]}
PYTHON

# Masks are drawn from the polygons on every level.
masked=(--water lake.geojson --watermask)
succeeds "$scarp" tile land.tif masks "${masked[@]}" -j 2 -q
succeeds python3 "$SCARP_SOURCE/tests/program/tile_masks.py" masks lake.geojson $(lake_tiles masks)
read -r lands waters both_kinds < "$logs/out"
holds "$lands > 20 && $waters >= 0 && $both_kinds > 10"
succeeds "$scarp" tile check masks
python3 "$reader" masks > /dev/null || fail "neighbours with masks differ"
succeeds "$scarp" tile plan land.tif m.json "${masked[@]}" -q
for share in 2/2 1/2; do succeeds "$scarp" tile run m.json --shard $share -q; done
succeeds "$scarp" tile finish m.json masks2 -q
diff -r masks masks2 || fail "two shares draw other masks"
python3 - masks <<'PYTHON'
import gzip, pathlib, sys
path = sorted(pathlib.Path(sys.argv[1]).glob("11/*/*.terrain"))[0]
data = gzip.decompress(path.read_bytes())
path.write_bytes(gzip.compress(data + b"\2\3\0\0\0abc"))
PYTHON
try "$scarp" tile check masks
[ "$code" = 3 ] && grep -q "water mask of 3 bytes" "$logs/out" || fail "a mask of 3 bytes passes"
sed -i 's/"octvertexnormals"/"octvertexnormals", "watermask"/' globe/layer.json
try "$scarp" tile check globe
[ "$code" = 3 ] && grep -q "has no water mask" "$logs/out" || fail "masks that are announced and missing pass"

# A changed file is refused; the follow-up plan makes only the changed blocks, and the set equals one from the new file.
few=(--cells 16 --effort fast --zoom 15)
cp lake.geojson now.geojson
succeeds "$scarp" tile plan land.tif b.json --water now.geojson "${few[@]}" -q
succeeds "$scarp" tile run b.json -q
sleep 0.01
cp other.geojson now.geojson
refuses 2 "now.geojson has changed" "$scarp" tile run b.json
succeeds "$scarp" tile plan land.tif c.json --changed-since b.json -q
succeeds "$scarp" tile run c.json
read -r made same < <(sed -n 's/.*: \([0-9]*\) blocks\? made.* before, \([0-9]*\) of the same nodes.*/\1 \2/p' "$logs/out")
holds "$made > 0 && $same > 0"
succeeds "$scarp" tile finish c.json c.pmtiles -q
succeeds "$scarp" tile land.tif anew.pmtiles --water other.geojson "${few[@]}" -q
cmp c.pmtiles anew.pmtiles || fail "a lake that moved makes another set"

# 3D Tiles, and heights above the sea: the lake follows the geoid.
succeeds "$scarp" tile land.tif land3 --of 3dtiles --vertical none --zoom 9 "${both[@]}" --report land3.json -q
succeeds "$scarp" tile check land3
succeeds gdal_translate -q -a_srs EPSG:4326 land.tif sea.tif
succeeds "$scarp" tile sea.tif sea --vertical egm96 --water lake.geojson --zoom 9 --report sea.json -q
holds "($(json sea.json water lakes 0 level) - $(json land3.json water lakes 0 level)) ^ 2 < 1e-4"

# Across the antimeridian: a lake in one piece and one that continues beyond 180 degrees are the same.
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 179.9 10.2 180.24 9.9 "$dem" date.tif
ring() {
  printf '{"type":"Polygon","coordinates":[[[179.953,10.12],[%s,10.15],[%s,10.03],[179.962,9.96],[179.953,10.12]]]}' "$1" "$2"
}
ring 180.131 180.147 > beyond.geojson
ring -179.869 -179.853 > short.geojson
for lake in beyond short; do
  succeeds "$scarp" tile date.tif "$lake" --water "$lake.geojson" --zoom 10 --report "$lake.json" -q
done
python3 "$reader" beyond > /dev/null || fail "at the antimeridian"
diff -r beyond short || fail "a lake across the antimeridian is another one"
holds "$(json beyond.json water lakes 0 level) > 200"

# A user's mistakes.
for other in "--zoom 12" "--zoom 9 --grid mercator"; do
  succeeds "$scarp" tile land.tif others $other -e 30 --effort fast -q
  refuses 1 "give the plan that the tiles are made by" "$scarp" tile check others --source a.json -q
  rm -r others
done
refuses 2 "nothing.gpkg" "$scarp" tile land.tif no --water nothing.gpkg
refuses 1 "--water percentile 101 is above 100" "$scarp" tile land.tif no --water lake.geojson --water-percentile 101
refuses 1 "needs --water" "$scarp" tile land.tif no --water-percentile 5
refuses 1 "--watermask needs --water" "$scarp" tile land.tif no --watermask
refuses 1 "--of 3dtiles cannot be combined with --watermask" "$scarp" tile land.tif no --of 3dtiles "${masked[@]}"
refuses 1 "goes around a pole" "$scarp" tile land.tif no --water ring.geojson
succeeds "$scarp" tile land.tif away --water beyond.geojson --zoom 8
grep -q "names no lake in the raster" "$logs/err" || fail "a lake elsewhere is not told"
