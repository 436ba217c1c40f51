#!/usr/bin/env bash
# Breaklines in tiles: edges of each tile's mesh that meet in neighbours, with the same bytes from any process.
source "$(dirname "$0")/lib.sh"
need python3 gdalinfo ogr2ogr
reader=$SCARP_SOURCE/tests/program/tiles.py

# Lines over the whole raster and beyond, including a ring, and one in UTM.
python3 - "$(gdalinfo -json "$dem")" <<'E2'
import json, math, sys
info = json.loads(sys.argv[1])
west, cell, _, north, _, down = info["geoTransform"]
at = lambda col, row: [west + cell * col, north + down * row]
lines = [[at(-50, 100), at(180, 160), at(260, 90), at(460, 300)], [at(200.5, -20), at(200.5, 400)],
         [at(120 + 60 * math.cos(k / 20), 230 + 60 * math.sin(k / 20)) for k in range(126)]]
lines[2].append(lines[2][0])
features = [{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": line}} for line in lines]
json.dump({"type": "FeatureCollection", "features": features}, open("lines.geojson", "w"))
json.dump({"type": "FeatureCollection", "features": features[:1]}, open("one.geojson", "w"))
E2
succeeds ogr2ogr -q -t_srs EPSG:32616 -nln roads utm.gpkg one.geojson
tiles() { "$scarp" tile "$dem" "$@" --vertical egm96; }
succeeds tiles lines --breaklines lines.geojson --report r.json -j 1
python3 "$reader" lines > /dev/null || fail "neighbours differ"
succeeds "$scarp" tile check lines --source "$dem" --vertical egm96
succeeds tiles plain --report plain.json -q
for z in 11 10 9 8 7 6; do
  holds "$(json r.json levels $z node_error) <= $(json r.json levels $z asked)"
  holds "$(json r.json levels $z triangles) > $(json plain.json levels $z triangles)"
done
succeeds tiles solid --of 3dtiles --breaklines lines.geojson -q
succeeds "$scarp" tile check solid --source "$dem" --vertical egm96

# A vertex on each edge between tiles of level 11 that the line along column 200.5 crosses, on both sides of the edge.
python3 - "$(gdalinfo -json "$dem")" <<'E2' || fail "the line along a meridian is no chain of edges"
import glob, gzip, json, pathlib, struct, sys
info = json.loads(sys.argv[1])
west, cell, _, north, _, down = info["geoTransform"]
longitude, side = west + cell * 200.5, 180 / 2 ** 11
x = int((longitude + 180) / side)
node = round((longitude + 180 - x * side) / side * 128)
crossed = 0
for path in map(pathlib.Path, glob.glob(f"lines/11/{x}/*.terrain")):
    data = gzip.open(path).read()
    count, = struct.unpack_from("<I", data, 88)
    columns = []
    for part in range(2):
        value, numbers = 0, []
        for code in struct.unpack_from(f"<{count}H", data, 92 + 2 * count * part):
            value += (code >> 1) ^ -(code & 1)
            numbers.append(value)
        columns.append(numbers)
    y = int(path.stem)
    top = -90 + (y + 1) * side
    if not north + 344 * down < top - side or not top < north:
        continue
    on_line = sorted(v for u, v in zip(*columns) if abs(u - node * 32767 / 128) <= 1)
    assert on_line[0] == 0 and on_line[-1] == 32767, (path, on_line)
    crossed += 1
assert crossed >= 1, crossed
E2

# Threads, shares, and a later plan make the same tiles; a layer of another CRS.
succeeds tiles threads --breaklines lines.geojson -q -j 3
diff -r lines threads || fail "3 threads make other tiles"
succeeds "$scarp" tile plan "$dem" plan.json --vertical egm96 --breaklines lines.geojson -q
for shard in 2/2 1/2; do succeeds "$scarp" tile run plan.json --shard $shard -j 2 -q; done
succeeds "$scarp" tile finish plan.json shares -q
diff -r lines shares || fail "shares make other tiles"
succeeds "$scarp" tile plan "$dem" next.json --changed-since plan.json -q
succeeds "$scarp" tile run next.json
grep -q " 0 blocks made" "$logs/out" || fail "a plan that follows has other lines"
succeeds tiles one --breaklines one.geojson --zoom 10 -q
succeeds tiles utm --breaklines utm.gpkg:roads --zoom 10 -q
python3 "$reader" utm > /dev/null || fail "neighbours differ with lines in UTM"
[ "$(find one -name '*.terrain' | wc -l)" = "$(find utm -name '*.terrain' | wc -l)" ] || fail "UTM lines make other tiles"

# A byte limit does not move lines.
succeeds tiles small --breaklines lines.geojson --max-tile-bytes 3k --zoom 10 -q
python3 "$reader" small > /dev/null || fail "neighbours differ within a limit"

refuses 1 "--breaklines cannot be combined with --grid mercator" "$scarp" tile "$dem" no --grid mercator --vertical egm96 --breaklines missing.geojson
refuses 2 "no such file" tiles no --breaklines missing.geojson
refuses 2 "has no layer 'rivers'" tiles no --breaklines utm.gpkg:rivers
