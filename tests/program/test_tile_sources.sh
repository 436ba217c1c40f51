#!/usr/bin/env bash
# scarp tile of several rasters: mosaics, and stacks in which the first height wins.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalwarp gdal_create
reader=$SCARP_SOURCE/tests/program/tiles.py

# Two halves on one grid form a mosaic with the tiles of the whole raster.
succeeds gdal_translate -q -srcwin 0 0 200 344 "$dem" left.tif
succeeds gdal_translate -q -srcwin 200 0 203 344 "$dem" right.tif
succeeds "$scarp" tile "$dem" whole --vertical egm96 --zoom 8 -q
succeeds "$scarp" tile left.tif right.tif halves --vertical egm96 --zoom 8 -q
diff -r -x layer.json whole halves || fail "two halves make other tiles than the whole"
mkdir folder && cp left.tif right.tif folder
succeeds "$scarp" tile folder from_folder --vertical egm96 --zoom 8 -q
diff -r -x layer.json whole from_folder || fail "a folder makes other tiles"
# A set made inside the folder is not a raster of the next run, though GDAL opens .mbtiles as one.
succeeds "$scarp" tile folder folder/set.mbtiles --vertical egm96 --zoom 8 -q
succeeds "$scarp" tile folder folder/set --vertical egm96 --zoom 8 -q
diff -r from_folder folder/set || fail "a set inside the folder is read"

# The first height wins, and a source without one exposes the next.
succeeds gdal_create -of GTiff -ot Float32 -a_srs EPSG:4979 -a_ullr 10.2 45.8 10.6 45.4 -outsize 60 60 -burn 100 low.tif
succeeds gdal_create -of GTiff -ot Float32 -a_srs EPSG:4979 -a_ullr 10 46 11 45 -outsize 60 60 -burn 200 high.tif
# heights FOLDER: of the finest tile in the middle of the small raster, rounded and distinct.
heights() {
  python3 - "$1" <<'PY'
import gzip, json, struct, sys
z = json.load(open(sys.argv[1] + "/layer.json"))["maxzoom"]
x, y = (int((degrees + 180 - 90 * k) / 180 * 2**z) for k, degrees in enumerate((10.4, 45.6)))
data = gzip.open(f"{sys.argv[1]}/{z}/{x}/{y}.terrain").read()
low, high = struct.unpack_from("<2f", data, 24)
count, = struct.unpack_from("<I", data, 88)
height, heights = 0, set()
for code in struct.unpack_from(f"<{count}H", data, 92 + 4 * count):
    height += (code >> 1) ^ -(code & 1)
    heights.add(round(low + (high - low) * height / 32767))
print(*sorted(heights))
PY
}
succeeds "$scarp" tile low.tif high.tif low_first --background 200 -q
[ "$(heights low_first)" = "100 200" ] || fail "the first raster does not win: $(heights low_first)"
succeeds "$scarp" tile high.tif low.tif high_first --background 200 -q
[ "$(heights high_first)" = 200 ] || fail "the second raster wins: $(heights high_first)"
succeeds gdal_translate -q -a_nodata 0 -srcwin -30 -30 120 120 low.tif void.tif
succeeds "$scarp" tile void.tif high.tif void_first --background 200 -q
[ "$(heights void_first)" = "100 200" ] || fail "nodata hides what lies below"

# Nodata within a raster drops to the background, or is filled first.
make_raster hole.tif 'math.nan if 150 <= col < 250 and 110 <= row < 210 else 500 + row / 2'
succeeds "$scarp" tile hole.tif hole --vertical ellipsoid --nodata-policy background --report voids.json
[ "$(json voids.json filled)" = 0 ] && [ ! -s "$logs/err" ] || fail "voids that are to be left are filled, or warned of"
succeeds "$scarp" tile hole.tif filled --vertical ellipsoid --nodata-policy fill -q
read -r lowest highest < <(python3 - "$reader" hole.tif << 'PY'
import importlib.util, pathlib, subprocess, sys, json
spec = importlib.util.spec_from_file_location("tiles", sys.argv[1])
tiles = importlib.util.module_from_spec(spec)
spec.loader.exec_module(tiles)
west, step_x, _, north, _, step_y = json.loads(subprocess.check_output(["gdalinfo", "-json", sys.argv[2]]))["geoTransform"]
z = json.load(open("filled/layer.json"))["maxzoom"]
heights = set()
for k in range(20):
    x, y = (int((degrees + 180 - 90 * axis) / 180 * 2**z) for axis, degrees in
            enumerate((west + step_x * (155 + 5 * k), north + step_y * (115 + 5 * k))))
    tile = tiles.read_tile(pathlib.Path(f"filled/{z}/{x}/{y}.terrain"))
    heights.update(tile["heights"])
print(min(heights), max(heights))
PY
)
holds "$lowest > 490 && $highest < 680" || fail "a void is not filled"
succeeds "$scarp" tile check filled --source hole.tif --vertical ellipsoid --nodata-policy fill
try "$scarp" tile check filled --source hole.tif --vertical ellipsoid --nodata-policy background
[ "$code" = 3 ] || fail "filled nodes are taken for those of a raster with a hole"
succeeds "$scarp" tile plan hole.tif fill.json --vertical ellipsoid --nodata-policy fill -q
succeeds "$scarp" tile run fill.json -q
succeeds "$scarp" tile finish fill.json planned -q
diff -r filled planned || fail "a plan fills otherwise"
refuses 2 "filling its nodata needs all samples in memory" "$scarp" tile run fill.json --parts streamed --memory 10k
succeeds "$scarp" tile hole.tif near --vertical ellipsoid --nodata-policy fill --fill-distance 5 -q
diff -rq filled near > /dev/null && fail "--fill-distance changes nothing"
refuses 1 "--fill-distance needs --nodata-policy fill" "$scarp" tile hole.tif no --fill-distance 5
refuses 1 "background" "$scarp" tile hole.tif no --nodata-policy hole
# Enclosed voids up to 100 samples a side are filled unless disabled: by a plan, from a raster in its file, and from
# several.
succeeds "$scarp" tile hole.tif usual --vertical ellipsoid --report voids.json --overwrite
diff -r usual filled || fail "small voids are filled otherwise"
grep -q 'filled  *10,000 missing samples in enclosed voids; --nodata-policy background leaves them' "$logs/out" || fail "the summary has no filled samples"
[ "$(json voids.json filled)" = 10000 ] && [ ! -s "$logs/err" ] || fail "the report has no filled samples"
succeeds "$scarp" tile check usual --source hole.tif -q
succeeds "$scarp" tile plan hole.tif usual.json --vertical ellipsoid -q
succeeds "$scarp" tile run usual.json --memory 10k -q
succeeds "$scarp" tile finish usual.json streamed
diff -r usual streamed || fail "windows of a file have other voids"
grep -q 'filled  *10,000' "$logs/out" || fail "a plan forgets its filled samples"
cp hole.tif also.tif
succeeds "$scarp" tile hole.tif also.tif twice --vertical ellipsoid -q
for tile in $(cd usual && find . -name '*.terrain'); do cmp -s "usual/$tile" "twice/$tile" || fail "a stack has a pit in $tile"; done
make_raster wide.tif 'math.nan if 150 <= col < 251 and 110 <= row < 210 or col == 400 and row < 9 else 500 + row / 2'
succeeds "$scarp" tile wide.tif wide --vertical ellipsoid --report voids.json --overwrite
grep -q '^scarp: warning: 10,109 missing samples .* up to 5[0-9.]* m from the land.*--nodata-policy fill' "$logs/err" || fail "no word of a pit"
[ "$(json voids.json filled)" = 0 ] && json voids.json warnings 0 | grep -q 'nodata-policy fill' || fail "no pit in the report"

# A fine raster in UTM with nodata corners, above the sea, on a coarse one in degrees above the ellipsoid.
succeeds gdalwarp -q -t_srs EPSG:32616+5773 -s_srs EPSG:4326+5773 -te 740000 4014000 752000 4026000 -tr 80 80 -r bilinear -dstnodata -9999 -ot Float32 "$dem" fine.tif
succeeds gdal_translate -q -a_srs EPSG:4979 -outsize 100 86 "$dem" coarse.tif
succeeds "$scarp" tile fine.tif coarse.tif stack --report r.json -j 1
grep -q "EGM96 height, the ellipsoid" "$logs/out" || fail "the summary does not tell both datums"
read -r tiles edges low high < <(python3 "$reader" stack)
holds "$tiles > 30 && $edges > 40 && $high > 900"
finest=$(json stack/layer.json maxzoom)
succeeds "$scarp" tile coarse.tif alone -q
holds "$finest == $(json alone/layer.json maxzoom) + 2"
# Only the fine raster reaches the finest level.
python3 - "$finest" <<'PY' || fail "tiles of the finest level lie where only the coarse raster is"
import json, sys
z = int(sys.argv[1])
layer = json.load(open("stack/layer.json"))
side = 180 / 2**z
boxes = [(-180 + r["startX"] * side, -180 + (r["endX"] + 1) * side) for r in layer["available"][z]]
wide = [(-180 + r["startX"] * 4 * side, -180 + (r["endX"] + 1) * 4 * side) for r in layer["available"][z - 2]]
assert max(e for _, e in boxes) - min(w for w, _ in boxes) < 0.45, boxes
assert max(e for _, e in wide) - min(w for w, _ in wide) > 0.3, wide
print(len(boxes))
PY
# Threads and shares have no effect.
succeeds "$scarp" tile fine.tif coarse.tif again -j 3 -q
diff -r stack again || fail "3 threads make other tiles"
succeeds "$scarp" tile plan fine.tif coarse.tif plan.json -q
succeeds "$scarp" tile run plan.json --shard 2/2 -q
succeeds "$scarp" tile run plan.json --shard 1/2 -q
succeeds "$scarp" tile finish plan.json shares
diff -r stack shares || fail "shares make other tiles"
succeeds "$scarp" tile run plan.json --parts streamed --memory 10k -q
succeeds "$scarp" tile finish plan.json streamed_set --parts streamed -q
diff -r stack streamed_set || fail "streamed rasters make other tiles"
succeeds "$scarp" tile fine.tif coarse.tif stack3d --of 3dtiles -q

# Different or unknown datums, other planets, parts of several.
succeeds gdal_translate -q -a_srs EPSG:4326 coarse.tif unknown.tif
refuses 1 "unknown.tif are above" "$scarp" tile fine.tif unknown.tif no
refuses 1 "coarse.tif are above the ellipsoid, as its CRS says" "$scarp" tile fine.tif coarse.tif no --vertical egm96
succeeds "$scarp" tile fine.tif unknown.tif both --vertical egm96 --zoom 8 -q
succeeds gdal_translate -q -a_srs EPSG:4326+5773 left.tif left_sea.tif
succeeds gdal_translate -q -a_srs EPSG:4979 right.tif right_gps.tif
succeeds "$scarp" tile left_sea.tif right_gps.tif unlike --zoom 8
grep -q "EGM96 height, the ellipsoid" "$logs/out" || fail "rasters of unlike datums are one mosaic"
succeeds gdal_translate -q -a_srs "+proj=longlat +R=1737400 +no_defs" coarse.tif moon.tif
refuses 2 "moon.tif lies on an ellipsoid" "$scarp" tile coarse.tif moon.tif no --vertical ellipsoid
refuses 1 "no mosaic with" "$scarp" tile fine.tif coarse.tif no --te 0 0 1 1
refuses 1 "--bound samples is for one raster" "$scarp" tile fine.tif coarse.tif no --bound samples
refuses 2 "missing.tif" "$scarp" tile coarse.tif missing.tif no
[ ! -e no ] || fail "something is left of a set that was refused"

# A raster that disappears or changes between plan and run, and is restored.
succeeds "$scarp" tile plan fine.tif coarse.tif gone.json -q
succeeds "$scarp" tile run gone.json --shard 1/2 -q
mv coarse.tif away.tif
refuses 2 "coarse.tif is not there any more" "$scarp" tile run gone.json --shard 2/2
mv away.tif coarse.tif
touch -r coarse.tif time
touch coarse.tif
refuses 2 "coarse.tif has changed" "$scarp" tile run gone.json --shard 2/2
touch -r time coarse.tif
succeeds "$scarp" tile run gone.json --shard 2/2 -q
# finish needs no raster, and reports one that has changed by then.
mv coarse.tif away.tif
succeeds "$scarp" tile finish gone.json gone
grep -q "coarse.tif" "$logs/err" || fail "finish does not tell that a raster is gone"
mv away.tif coarse.tif
diff -r stack gone || fail "a raster that was away changes tiles"

# A raster that changes during a run.
succeeds gdal_translate -q -outsize 1600 1400 -r bilinear "$dem" big.tif
"$scarp" tile big.tif changing --vertical egm96 -j 1 --json-progress > /dev/null 2> progress &
until grep -q tiles progress; do sleep 0.05; kill -0 $! 2> /dev/null || fail "it ended before it began"; done
touch big.tif
wait $! && fail "a raster changed, and nobody noticed"
grep -q "big.tif has changed" progress || fail "it does not tell which raster changed: $(tail -1 progress)"
[ ! -e changing ] || fail "a set of two versions of a raster"
