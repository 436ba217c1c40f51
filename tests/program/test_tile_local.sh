#!/usr/bin/env bash
# scarp tile --grid local: tiles on a plane whose nodes are the samples, judged by Python from their bytes alone.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalwarp gdaltransform
judge=$SCARP_SOURCE/tests/program/tile_plane.py
export GDAL_PAM_ENABLED=NO

# samples RASTER OUT: writes float32, nodata as NaN.
samples() {
  succeeds gdal_translate -q -of ENVI -ot Float32 "$1" raw.img
  python3 - "$2" << 'E'
import array
import sys
samples = array.array("f", open("raw.img", "rb").read())
open(sys.argv[1], "wb").write(array.array("f", [float("nan") if z == -9999 else z for z in samples]).tobytes())
E
}

# A projected raster with nodata edges, since it is rotated in its CRS; every sample against the triangles.
succeeds gdalwarp -q -t_srs EPSG:32616 -r bilinear -dstnodata -9999 -ot Float32 "$dem" utm.tif
samples utm.tif utm.f32
read -r cols rows cell < <(gdalinfo utm.tif | sed -n 's/^Size is \(.*\), \(.*\)/\1 \2/p; s/^Pixel Size = (\([^,]*\),.*/\1/p' | xargs)
succeeds "$scarp" tile utm.tif city --grid local --cells 64 --report r.json -j 1
grep -q "local, 3D Tiles: $cols x $rows samples" "$logs/out" || fail "the summary does not tell of the grid"
background=$(json city/tileset.json asset extras scarp background)
python3 "$judge" city utm.f32 "$cols" "$rows" "$background" "$cell" > judged
[ "$(wc -l < judged)" = 4 ] || fail "other levels than 0 to 3"
for z in 0 1 2 3; do
  holds "$(json r.json levels $z node_error) <= $(json r.json levels $z asked)"
  holds "$(json r.json levels $z source_error) <= $(json r.json levels $z node_error) * 1.000001"
done
succeeds "$scarp" tile check city --source utm.tif --json
cp "$logs/out" check.json
# Scarp's check measures the same as Python.
python3 - << 'E'
import json
check = json.load(open("check.json"))["levels"]
for level, line in zip(check, open("judged"), strict=True):
    tiles, triangles, worst, bound = map(float, line.split())
    assert (level["tiles"], level["triangles"]) == (tiles, triangles)
    assert abs(level["node_error"] - worst) < 1e-9 and level["distance"] < worst + 1e-9, (level, worst)
    assert abs(worst - bound) < 1e-9, "the bound is not what the file's numbers say"
E

# The plane's place: exact at the centre; elsewhere the deviation is at most the reported one, and close to it.
python3 - "$cols" "$rows" "$cell" > places << 'E'
import sys
cols, rows, cell = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
for col, north in [((cols - 1) // 2, (rows - 1) // 2), (0, 0), (cols - 1, 0), (0, rows - 1), (cols - 1, rows - 1)]:
    print(col - (cols - 1) // 2, north - (rows - 1) // 2, col, rows - 1 - north)
E
read -r west north < <(gdalinfo utm.tif | sed -n 's/^Origin = (\(.*\),\(.*\))/\1 \2/p')
while read -r _ _ col row; do
  awk "BEGIN { printf \"%.6f %.6f 0\n\", $west + ($col + 0.5) * $cell, $north - ($row + 0.5) * $cell }"
done < places > projected
gdaltransform -s_srs EPSG:32616+4979 -t_srs EPSG:4978 < projected > exact 2> /dev/null ||
  gdaltransform -s_srs EPSG:32616 -t_srs EPSG:4978 < projected > exact
python3 - "$cell" << 'E'
import json
import sys
cell, root = float(sys.argv[1]), json.load(open("city/tileset.json"))["root"]
m, report = root["transform"], json.load(open("r.json"))["plane"]
worst = 0
for k, (place, exact) in enumerate(zip(open("places"), open("exact"), strict=True)):
    x, y = (cell * int(number) for number in place.split()[:2])
    put = [m[i] * x + m[4 + i] * y + m[12 + i] for i in range(3)]
    off = sum((a - float(b)) ** 2 for a, b in zip(put, exact.split())) ** 0.5
    assert k > 0 or off < 1e-3, off
    worst = max(worst, off)
most = (report["off_along"] ** 2 + report["off_height"] ** 2) ** 0.5
assert most / 2 < worst < most + 0.01, (worst, most)
assert report["crs"] == "EPSG:32616" and 1 < report["convergence"] < 3 and 0.9995 < report["scale"][0] < 1.001, report
E
succeeds "$scarp" tile utm.tif sea --grid local --cells 64 --vertical egm96 -q
python3 - << 'E'
import json
a, b = (json.load(open(f"{name}/tileset.json"))["root"]["transform"] for name in ("city", "sea"))
off = sum((a[12 + i] - b[12 + i]) ** 2 for i in range(3)) ** 0.5
assert 25 < off < 40, off  # the geoid
assert all(abs(a[i] - b[i]) < 1e-5 for i in range(12))
E
diff -r city/0 sea/0 || fail "the datum moves the plane, not its tiles"

# Threads, shares, containers, a byte limit.
make() { succeeds "$scarp" tile utm.tif "$1" --grid local --cells 64 -q "${@:2}"; }
make again -j 3
diff -r city again || fail "threads make another set"
succeeds "$scarp" tile plan utm.tif city.json --grid local --cells 64 -q
[ "$(json city.json pyramid grid kind)" = '"local"' ] || fail "the plan does not name its grid"
for shard in 3/3 1/3 2/3 1/1; do succeeds "$scarp" tile run city.json --shard $shard -q; done
succeeds "$scarp" tile finish city.json joined -q
diff -r city joined || fail "shares make another set"
succeeds "$scarp" tile check joined --source city.json -q
make city.3tz
succeeds "$scarp" tile check city.3tz --source utm.tif -q
[ "$(python3 "$SCARP_SOURCE/tests/program/tile_sets.py" city city.3tz)" = "$(find city -type f | wc -l)" ] || fail "city.3tz is not the folder"
make small --max-tile-bytes 4k
succeeds "$scarp" tile check small --source utm.tif -q
holds "$(find small -name '*.glb' -size +4k | wc -l) < $(find city -name '*.glb' -size +4k | wc -l)"
succeeds "$scarp" tile plan utm.tif later.json --changed-since city.json -q
succeeds "$scarp" tile run later.json
grep -q "0 blocks made, 1 there" "$logs/out" || fail "a block of the same samples is made again"

# The check finds a moved tile, a missing triangle, and another raster.
python3 - << 'E'
import json
import pathlib
import shutil
import struct
for name in ("high", "torn"):
    shutil.copytree("city", name)
    path = max(pathlib.Path(name).glob("0/3/*/*.glb"), key=lambda path: path.stat().st_size)
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    gltf = json.loads(data[20:20 + size])
    if name == "high":
        gltf["nodes"][0]["matrix"][13] += 30
    else:
        primitive = gltf["meshes"][0]["primitives"][0]
        accessor = gltf["accessors"][primitive["indices"]]
        accessor["count"] -= 3
        gltf["bufferViews"][accessor["bufferView"]]["extensions"]["EXT_meshopt_compression"]["count"] -= 3
    text = json.dumps(gltf, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    whole = data[:12] + struct.pack("<I", len(text)) + data[16:20] + text + data[20 + size:]
    path.write_bytes(whole[:8] + struct.pack("<I", len(whole)) + whole[12:])
E
try "$scarp" tile check high --source utm.tif --json
[ "$code" = 3 ] || fail "a tile that is 30 m too high is no fault"
cp "$logs/out" high.json
holds "$(json high.json faults bound) > 0 && $(json high.json faults border) > 0"
try "$scarp" tile check torn --json
[ "$code" = 3 ] || fail "a missing triangle is no fault"
cp -r city lie
python3 - << 'E'
import json
tileset = json.load(open("lie/tileset.json"))
tileset["asset"]["extras"]["scarp"]["levels"][3]["node_error"] /= 2
json.dump(tileset, open("lie/tileset.json", "w"))
E
try "$scarp" tile check lie --source utm.tif
[ "$code" = 3 ] || fail "half of the error is promised, and that is no fault"
succeeds gdal_translate -q -srcwin 0 0 100 100 utm.tif part.tif
refuses 1 "of another raster" "$scarp" tile check city --source part.tif

# Above the blocks; a raster that ends on a tile border; without a place on the globe the default is local.
succeeds gdal_translate -q -srcwin 30 10 129 300 -a_nodata none -outsize 385 700 -r bilinear -ot Float32 utm.tif tall.tif
succeeds gdal_translate -q -of ENVI tall.tif tall.img
rm -f tall.img.aux.xml
sed -i '/map info\|coordinate system\|projection/d' tall.hdr
cp tall.img tall.f32
succeeds "$scarp" tile tall.img tall --cell-size 25 --cells 16 -e 2 --effort fast
grep -q "local, 3D Tiles: 385 x 700 samples, cells of 25 m" "$logs/out" || fail "the raster without a place has no local grid"
grep -q "no transform" "$logs/out" || fail "the summary does not say that the set lies nowhere"
[ "$(json tall/tileset.json asset extras scarp units horizontal)" = '"metre"' ] || fail "cells have no unit"
! grep -q transform tall/tileset.json || fail "a set that lies nowhere has a transform"
succeeds "$scarp" tile check tall --source tall.img --cell-size 25 -q
python3 "$judge" tall tall.f32 385 700 "$(json tall/tileset.json asset extras scarp background)" 25 > judged
[ "$(wc -l < judged)" = 7 ] || fail "other levels than 0 to 6"

# Another planet: the plane touches its ellipsoid, or a given one; clients learn of it as in globe sets.
succeeds gdal_translate -q -a_srs "+proj=stere +lat_0=-4.6 +lon_0=137.4 +R=3396190 +units=m" -a_ullr 0 30000 40000 0 "$dem" mars.tif
succeeds "$scarp" tile mars.tif mars --grid local --effort fast -e 50 --report mars.json
grep -q "a plane at its centre on " "$logs/out" || fail "the summary does not name the planet"
succeeds "$scarp" tile utm.tif moon --grid local --effort fast -e 50 --ellipsoid 1737400,1737400 -q
succeeds "$scarp" tile check mars --source mars.tif -q
python3 - << 'E'
import json
for name, radius in (("mars", 3396190), ("moon", 1737400)):
    tileset = json.load(open(f"{name}/tileset.json"))
    place = tileset["root"]["transform"][12:15]
    assert abs(sum(x * x for x in place) ** 0.5 - radius) < 1, (name, place)
    told = tileset["extensions"]["3DTILES_ellipsoid"]
    assert told["radii"] == [radius] * 3 and told["body"], told
    assert tileset["asset"]["extras"]["scarp"]["ellipsoid"] == [radius] * 2
assert "3DTILES_ellipsoid" not in json.load(open("city/tileset.json")).get("extensions", {})
assert json.load(open("mars.json"))["ellipsoid"] == [3396190, 3396190]
E

# Feet become metres, reported once; heights without a unit have that of x and y.
quick=(--grid local --vertical ellipsoid --effort fast -e 200)
for crs in 2225 2225+6360; do
  succeeds gdal_translate -q -a_srs EPSG:$crs -a_ullr 6000000 2100000 6040000 2070000 "$dem" feet.tif
  succeeds "$scarp" tile feet.tif feet "${quick[@]}" --report feet.json --overwrite
  [ "$(grep -c "US survey foot.*become metres" "$logs/err")" = 1 ] || fail "no word of feet"
  [ "$(json feet.json warnings 0 | grep -c "become metres")" = 1 ] || fail "the report has no word of feet"
  succeeds "$scarp" tile feet.tif metres "${quick[@]}" --z-scale 0.3048006096012192 --overwrite
  [ ! -s "$logs/err" ] || fail "scaled heights are warned of"
  differs=$(diff -rq feet metres | grep -v tileset.json || true)
  [ -z "$differs" ] || fail "feet are not metres times 0.3048: $differs"
  succeeds "$scarp" tile feet.tif metres "${quick[@]}" --z-unit m --overwrite -q
  differs=$(diff -rq feet metres | grep glb || true)
  [ -n "$differs" ] || fail "--z-unit changes nothing"
  succeeds "$scarp" tile feet.tif globe --vertical ellipsoid --effort fast -e 200 --overwrite
  grep -q "become metres" "$logs/err" || fail "globe sets have no word of feet"
done
succeeds gdal_translate -q -a_srs 'LOCAL_CS["site",UNIT["metre",1]]' feet.tif site.tif
succeeds gdal_translate -q -of VRT site.tif site.vrt
sed -i 's|<VRTRasterBand[^>]*>|&<UnitType>ft</UnitType>|' site.vrt
succeeds "$scarp" tile site.vrt site --effort fast -e 200
grep -q "heights in ft become metres" "$logs/err" || fail "feet of a building site pass in silence"
sed -i 's|<UnitType>ft|<UnitType>K|' site.vrt
refuses 1 "heights are in 'K', which is no unit of length" "$scarp" tile site.vrt no

# A plane cannot represent a continent: errors of 1 % of the distance to a corner cause a warning, the city's did not.
succeeds gdal_translate -q -a_srs EPSG:3035 -a_ullr 3000000 4000000 5000000 2500000 "$dem" continent.tif
succeeds "$scarp" tile continent.tif continent "${quick[@]}"
grep -q "lie up to [0-9]* km from their place on the globe, .* take --grid geographic" "$logs/err" || fail "no word of the distance"
succeeds "$scarp" tile utm.tif near "${quick[@]}"
! grep -q "from their place" "$logs/err" || fail "a city is warned of"

# The range of heights makes no set coarser, and units are the grid's.
python3 - << 'E'
import array
import math
heights = [[int(32767.5 + 32767.5 * math.sin(x / 9) * math.cos(y / 11)) for x in range(130)] for y in range(90)]
heights[4][7], heights[50][60] = 0, 65535
samples = array.array("H", sum(heights, []))
array.array("f", samples).tofile(open("steep.f32", "wb"))
samples.byteswap()
open("steep.pgm", "wb").write(b"P5 130 90 65535\n" + samples.tobytes())
E
succeeds "$scarp" tile steep.pgm steep --cells 64 --report steep.json
! grep -q '[0-9] m\b' "$logs/out" || fail "cells of no unit are metres in the summary"
holds "$(json steep.json levels 2 asked) * 4 == $(json steep.json levels 2 geometric_error)"
python3 "$judge" steep steep.f32 130 90 0 1 > judged
succeeds "$scarp" tile check steep --source steep.pgm
! grep -q '[0-9] m\b' "$logs/out" || fail "cells of no unit are metres in the summary of the check"
# A relief beyond 16 bits of the earlier steps remains in float32; beyond that, the set must be made again.
python3 -c 'open("land.pgm", "wb").write(b"P5 130 90 65535\n" + bytes(b for k in range(11700) for b in (0, k % 11)))'
for error in 0.25 0.0625; do succeeds "$scarp" tile plan land.pgm low$error.json --cells 64 -e $error -q; done
succeeds "$scarp" tile run low0.25.json -q
cp steep.pgm land.pgm
succeeds "$scarp" tile plan land.pgm grown.json --changed-since low0.25.json -q
succeeds "$scarp" tile run grown.json -q
succeeds "$scarp" tile finish grown.json grown -q
succeeds "$scarp" tile check grown --source land.pgm -q
python3 "$judge" grown steep.f32 130 90 0 1 > judged
refuses 1 "needs steps of 0.00390625 where the earlier plan has 0.00195" "$scarp" tile plan land.pgm no.json --changed-since low0.0625.json
refuses 1 "0.001 at level 2, the finest, is too fine for heights of 0 to 65535" "$scarp" tile steep.pgm no --cells 64 -e 0.001

# Meaningless requests are refused.
local=("$scarp" tile utm.tif no --grid local)
refuses 1 "quantized-mesh lies on the ellipsoid" "${local[@]}" --of qm
refuses 1 "--water cannot be combined with --grid local: lakes and rivers are laid in degrees" "${local[@]}" --water lakes.shp
refuses 1 "--breaklines cannot be combined with --grid local" "${local[@]}" --breaklines lines.shp
refuses 1 "--drape cannot be combined with --grid local" "${local[@]}" --drape image.tif
refuses 1 "--only cannot be combined with --grid local" "${local[@]}" --only 1,2,3,4
refuses 1 "--drape cannot be combined with a local grid" "$scarp" tile tall.img no --of 3dtiles --drape utm.tif
refuses 1 "leave --ellipsoid out" "$scarp" tile tall.img no --ellipsoid 1737400
refuses 1 "--zoom" "${local[@]}" --zoom 9
refuses 1 "keep a local grid in a folder" "$scarp" tile utm.tif no.pmtiles --grid local
refuses 1 "one raster" "$scarp" tile utm.tif "$dem" no --grid local
refuses 2 "in degrees" "$scarp" tile "$dem" no --grid local
refuses 2 "or take --grid local" "$scarp" tile tall.img no --grid geographic --vertical none
refuses 1 "leave --vertical" "$scarp" tile tall.img no --vertical egm96
refuses 1 "3D Tiles say in advance" "$scarp" serve tall.img --port 0
refuses 1 "choose geographic or mercator" "$scarp" tile check city --grid nonsense
refuses 1 "do not name theirs" "$scarp" tile check city --grid mercator

# Other programs: the glTF validator, and 3d-tiles-renderer, whose rays meet the land near the centre.
if npm_judges gltf-validator; then
  find city -name '*.glb' | sort | head -20 > some
  xargs node "$js/validate_glb.cjs" < some > judged.txt || { head -20 judged.txt; fail "the glTF validator has objections"; }
  [ "$(grep -c ': 0 errors, 0 warnings' judged.txt)" = "$(wc -l < some)" ] || fail "not every tile was judged"
fi
if npm_judges 3d-tiles-renderer three; then
  python3 - "$west" "$north" "$cell" "$cols" "$rows" > corners << 'E'
import sys
west, north, cell, cols, rows = map(float, sys.argv[1:])
for k in range(100):
    print(west + ((cols - 1) // 2 + k % 10 - 5 + 0.5) * cell, north - (rows - (rows - 1) // 2 - 1 + k // 10 - 5 + 0.5) * cell)
E
  gdaltransform -s_srs EPSG:32616 -t_srs EPSG:4326 < corners | python3 -c '
import json, sys
json.dump([[float(word) for word in line.split()[:2]] for line in sys.stdin], open("places.json", "w"))'
  gdallocationinfo -valonly -geoloc utm.tif < corners > wanted
  succeeds node "$js/three_tiles.mjs" city places.json
  cp "$logs/out" answer.json
  python3 - << 'E'
import json
answer, report = json.load(open("answer.json")), json.load(open("r.json"))
wanted = [float(line) for line in open("wanted")]
assert not answer["failed"] and None not in answer["heights"], answer
worst = max(abs(a - b) for a, b in zip(answer["heights"], wanted, strict=True))
bound = report["levels"][3]["bound"]
print(f"{len(answer['drawn'])} tiles drawn; {len(wanted)} rays: {worst:.2f} m of {bound:.2f}")
assert bound / 10 < worst <= bound + 0.1, (worst, bound)
E
fi
