#!/usr/bin/env bash
# Coordinates for every viewer: near 0, in metres, the right way up, with numbers that map them back to the source.
source "$(dirname "$0")/lib.sh"
need python3 gdalwarp gdal_translate

cat > look.py <<'PYTHON'
"""box FILE: the box around a mesh as x, y, z in the file; place FILE: its JSON numbers, where it has them."""
import json, struct, sys
what, path = sys.argv[1:]
data = open(path, "rb").read()
place, points = {}, []
if path.endswith(".glb"):
    gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
    position = gltf["accessors"][gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    shift = gltf["nodes"][0].get("translation", [0, 0, 0])
    points = [[a + b for a, b in zip(position[end], shift)] for end in ("min", "max")]
    place = gltf["asset"]["extras"]
elif path.endswith(".stl"):
    for t in range(struct.unpack("<I", data[80:84])[0]):
        floats = struct.unpack("<9f", data[96 + 50 * t:132 + 50 * t])
        points += [floats[0:3], floats[3:6], floats[6:9]]
else:
    head, _, body = data.partition(b"end_header\n")
    texts = head.decode().splitlines()
    if path.endswith(".ply"):
        count = next(int(t.split()[2]) for t in texts if t.startswith("element vertex"))
        kind = "f" if "property float x" in texts else "d"
        size = struct.calcsize("<3" + kind)
        points = [struct.unpack_from("<3" + kind, body, size * k) for k in range(count)]
    else:
        points = [[float(w) for w in t.split()[1:4]] for t in texts if t.startswith("v ")]
    for text in texts:
        key, _, value = text.replace("comment ", "# ", 1).partition(": ")
        if key in ("# scarp origin", "# scarp to_source"):
            place[key[8:]] = json.loads(value)
        elif key == "# scarp origin_crs":
            place[key[8:]] = value
if what == "place":
    print(json.dumps([place[key] for key in ("origin", "origin_crs", "to_source")]))
else:
    print(*(f"{min(p[k] for p in points):.10g} {max(p[k] for p in points):.10g}" for k in range(3)))
PYTHON

gdalwarp -q -t_srs EPSG:32616 -tr 90 90 -r bilinear -dstnodata -9999 -ot Float32 "$dem" utm.tif
succeeds "$scarp" simplify utm.tif source.ply -e 20 --crs source --report source.json
read -r -a source < <(python3 look.py box source.ply)
for format in glb obj ply stl; do
  succeeds "$scarp" simplify utm.tif local.$format -e 20 --report r.json --overwrite
  read -r x0 x1 a0 a1 b0 b1 < <(python3 look.py box local.$format)
  case $format in glb | obj) z0=$a0 z1=$a1 y0=$(awk "BEGIN { print -($b1) }") y1=$(awk "BEGIN { print -($b0) }") ;;
  *) y0=$a0 y1=$a1 z0=$b0 z1=$b1 ;; esac
  holds "$x0 < -14000 && $x0 > -25000 && $x1 > 14000 && $x1 < 25000 && $y0 < -14000 && $y1 > 14000 && $y1 < 25000"
  holds "$z0 >= 200 && $z0 < 300 && $z1 > 1000 && $z1 < 1100"
  # The numbers map back to the raster's own coordinates.
  place="$(json r.json frame origin) $(json r.json frame to_source)"
  python3 - "$place" "$x0 $x1 $y0 $y1" "${source[*]}" <<'PYTHON' || fail "$format: $place leads elsewhere"
import json, sys
place, local, source = sys.argv[1:]
origin, t = place.split("] ")
origin, t = json.loads(origin + "]"), json.loads(t)
x0, x1, y0, y1 = map(float, local.split())
x, y = (t[0] + t[1] * x0 + t[2] * y0, t[0] + t[1] * x1 + t[2] * y1), (t[3] + t[4] * x0 + t[5] * y0, t[3] + t[4] * x1 + t[5] * y1)
assert origin == [t[0], t[3]], (origin, t)
assert all(abs(a - b) < 1e-3 for a, b in zip(x + y, map(float, source.split()[:4]))), (x, y, source)
PYTHON
  [ "$(json r.json frame kind) $(json r.json frame origin_crs)" = '"local" "EPSG:32616"' ] || fail "$format is in another frame"
  [ $format = stl ] || [ "$(python3 look.py place local.$format)" = \
    "[$(json r.json frame origin), \"EPSG:32616\", $(json r.json frame to_source)]" ] || fail "$format tells other numbers than its report"
  succeeds "$scarp" measure utm.tif local.$format --fail-above 20
done
grep -qa '^property float x' local.ply || fail "a local PLY has doubles"
grep -qa '^property double x' source.ply || fail "a PLY in UTM has floats"
succeeds "$scarp" simplify utm.tif local.ply -e 20 --double --overwrite
grep -qa '^property double x' local.ply || fail "--double writes floats"
refuses 1 "--double is for PLY" "$scarp" simplify utm.tif out.glb -e 20 --double
[ "$(json source.json frame to_source)" = "[0.0, 1.0, 0.0, 0.0, 0.0, 1.0]" ] || fail "the source's way to itself is another"
succeeds "$scarp" simplify utm.tif there.obj -e 20 --crs 3857 --report r.json --overwrite
[ "$(json r.json frame crs) $(json r.json frame to_source)" = '"EPSG:3857" null' ] || fail "3857 is not EPSG:3857"

# The up axis, and files that do not declare it.
for format in obj ply stl; do
  for up in y z; do
    succeeds "$scarp" simplify utm.tif up.$format -e 20 --up $up --overwrite
    read -r x0 x1 a0 a1 b0 b1 < <(python3 look.py box up.$format)
    [ $up = z ] || { b0=$a0 b1=$a1; }
    holds "$b0 >= 200 && $b1 < 1100"
    succeeds "$scarp" measure utm.tif up.$format --fail-above 20
    [ $format != obj ] || succeeds "$scarp" measure utm.tif <(grep -v '^#' up.obj) --up $up --fail-above 20
  done
done
refuses 1 "GLB is always y up" "$scarp" simplify utm.tif out.glb -e 20 --up z
refuses 1 "2DM is always z up" "$scarp" simplify utm.tif out.2dm -e 20 --up y
refuses 1 "--up x is unknown" "$scarp" simplify utm.tif out.obj -e 20 --up x
succeeds "$scarp" simplify utm.tif print.obj -e 20 --solid size=100mm
read -r x0 x1 y0 y1 z0 z1 < <(python3 look.py box print.obj)
holds "$z1 < 20 && $y1 > 60"
# A mesh without metadata is judged where it fits.
for frame in source local; do
  succeeds "$scarp" simplify utm.tif $frame.obj -e 20 --up z --crs $frame --overwrite
  succeeds "$scarp" measure utm.tif <(grep -v '^#' $frame.obj) --fail-above 20
done

# Formats for maps: the raster's CRS, and a .prj file that never replaces another's.
for format in 2dm dxf xml tin; do
  rm -f map.prj
  succeeds "$scarp" simplify utm.tif map.$format -e 50 --report r.json --overwrite
  [ "$(json r.json frame kind)" = '"source"' ] || fail "$format is not in the raster's CRS"
  [ "$(json r.json outputs 1 path) $(json r.json outputs 1 format)" = '"map.prj" "prj"' ] || fail "the report does not list map.prj"
  grep -q '  written *map.prj, ' "$logs/out" || fail "the summary does not list map.prj"
  grep -q '^PROJCS\["WGS_1984_UTM_Zone_16N"' map.prj || fail "map.prj holds $(cat map.prj)"
  succeeds "$scarp" measure utm.tif map.$format --fail-above 50
done
succeeds "$scarp" simplify utm.tif map.gpkg -e 50
succeeds "$scarp" simplify "$dem" local.tin -e 50
[ ! -e local.prj ] || fail "a mesh without CRS has a .prj file"
rm -f map.2dm
succeeds "$scarp" simplify utm.tif map.2dm -e 50
[ "$(grep -c written "$logs/out")" = 1 ] || fail "a .prj file that says the same is written again"
rm -f map.* && echo other > map.prj
refuses 4 "map.prj exists already" "$scarp" simplify utm.tif map.2dm -e 50
touch map.shp
refuses 4 "map.prj tells the CRS of map.shp" "$scarp" simplify utm.tif map.2dm -e 50 --overwrite
mv map.shp map.glb
succeeds "$scarp" simplify utm.tif map.2dm -e 50 --overwrite
grep -q '^PROJCS' map.prj || fail "--overwrite leaves an old .prj file"
gdal_translate -q -of AAIGrid "$dem" deg.asc
cp deg.prj deg.before
refuses 1 "deg.prj is a file that deg.asc is made of" "$scarp" simplify deg.asc deg.2dm -e 50 --crs EPSG:32616 --overwrite
cmp deg.prj deg.before || fail "the raster's own .prj file is lost"

# Heightmaps: cell width, scale and offset of heights; streamed, the same.
gdal_translate -q -of PNG -ot UInt16 -scale 236 1076 0 60000 -outsize 300 200 "$dem" map.png
rm -f map.png.aux.xml
succeeds "$scarp" simplify map.png needle.glb -e 500
grep -q 'the relief of [0-9]* is 19[0-9] times the width of 300.*--cell-size.*--z-scale' "$logs/err" || fail "no word about a needle"
succeeds "$scarp" info map.png
grep -q -- '--cell-size' "$logs/err" || fail "info has no word about a needle"
scaled="--cell-size 90 --z-scale 0.014 --z-offset 236"
succeeds "$scarp" simplify map.png flat.glb -e 10 $scaled --report r.json --overwrite
[ ! -s "$logs/err" ] || fail "a word about a needle that is none"
holds "$(json r.json max_error) <= 10 && $(json r.json input min) == 236 && $(json r.json input max) > 1060 && $(json r.json input max) < 1077"
[ "$(json r.json input z_scale) $(json r.json input z_offset)" = "0.014 236.0" ] || fail "the report knows no scale"
read -r x0 x1 z0 z1 y0 y1 < <(python3 look.py box flat.glb)
holds "$x0 < -13400 && $x0 >= -13500 && $x1 > 13300 && $z1 < 1077"
succeeds "$scarp" measure map.png flat.glb --fail-above 10 --json
[ "$(json "$logs/out" max_error)" = "$(json r.json max_error)" ] || fail "measure sees another error"
try "$scarp" measure map.png flat.glb --fail-above 10 --z-scale 0.02
[ "$code" = 3 ] || fail "another scale passes"
succeeds "$scarp" simplify map.png flat.stl -e 10 $scaled
succeeds "$scarp" measure map.png flat.stl --fail-above 10 $scaled
refuses 1 "has a georeference" "$scarp" simplify "$dem" out.glb -e 10 --cell-size 9
succeeds "$scarp" simplify "$dem" cells.glb -e 10 --crs grid --cell-size 90
succeeds "$scarp" measure "$dem" cells.glb --fail-above 10
refuses 1 "--z-scale 0" "$scarp" simplify map.png out.glb -e 1 --z-scale 0
refuses 1 "--cell-size -1 is not above 0" "$scarp" simplify map.png out.glb -e 1 --cell-size -1
refuses 1 "--image cannot be combined with --z-scale" "$scarp" simplify map.png out.glb -e 1 --image --z-scale 2
gdal_translate -q -outsize 4000 3000 -of PNG -ot UInt16 map.png wide.png
rm -f wide.png.aux.xml
wide="--cell-size 9 --z-scale 0.014 --z-offset 236"
succeeds "$scarp" simplify wide.png whole.glb -e 60 $wide --effort fast -q
succeeds "$scarp" measure wide.png whole.glb --fail-above 60 --json
cp "$logs/out" whole.json
for memory in 115M 95M; do  # in memory as 16-bit codes, and from the file: the same heights by the judge
  succeeds "$scarp" simplify wide.png streamed.glb -e 60 $wide --effort fast --memory $memory -q --overwrite
  succeeds "$scarp" measure wide.png streamed.glb --fail-above 60 -q
  succeeds "$scarp" measure wide.png whole.glb --memory $memory --json
  for key in max_error max_error_at rmse mean_error p99; do
    [ "$(json "$logs/out" $key)" = "$(json whole.json $key)" ] || fail "--memory $memory judges other heights"
  done
done
echo "frames, axes, .prj files and scales are right"

# STL beyond the local frame: the report's numbers map those of the file to the raster.
for crs in source grid; do
  succeeds "$scarp" simplify "$dem" place.stl -e 50 --crs $crs --report place.json --overwrite
  grep -q "the file holds offsets from" "$logs/out" || fail "no word of offsets with --crs $crs"
  python3 - $(gdalinfo "$dem" | awk '/^Upper Left|^Lower Right/ { gsub(/[(),]/, " "); print $3, $4 }') <<'PYTHON'
import json, struct, sys
west, north, east, south = map(float, sys.argv[1:5])
frame = json.load(open("place.json"))["frame"]
t = frame["to_source"]
data = open("place.stl", "rb").read()
corners = [struct.unpack_from("<3f", data, 84 + 50 * k + 12 + 12 * c) for k in range((len(data) - 84) // 50) for c in range(3)]
xs = [t[0] + t[1] * x + t[2] * y for x, y, z in corners]
ys = [t[3] + t[4] * x + t[5] * y for x, y, z in corners]
cell = (east - west) / 403
for value, want in ((min(xs), west), (max(xs), east), (min(ys), south), (max(ys), north)):
    assert abs(value - want) < 0.6 * cell, (value, want)
assert frame["origin"] == [t[0], t[3]]
PYTHON
done
