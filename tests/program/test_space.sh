#!/usr/bin/env bash
# Meshes on the round earth: earth-centred and east-north-up, proven along the verticals of the samples.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

cat > away.py <<'PYTHON'
"""FILE LENGTH: the triangles of a GLB look away from the earth's centre, from which its vertices are about LENGTH away."""
import json, struct, sys
data, length = open(sys.argv[1], "rb").read(), float(sys.argv[2])
size = struct.unpack("<I", data[12:16])[0]
gltf, body = json.loads(data[20:20 + size]), data[28 + size:]
m = gltf["asset"]["extras"]["to_earth"]
shift = gltf["nodes"][0].get("translation", [0, 0, 0])
def numbers(accessor, kind, count):
    view = gltf["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return struct.unpack_from(f"<{count}{kind}", body, start)
for part in gltf["meshes"][0]["primitives"]:
    position, index = (gltf["accessors"][k] for k in (part["attributes"]["POSITION"], part["indices"]))
    flat = numbers(position, "f", 3 * position["count"])
    corners = numbers(index, {5125: "I", 5123: "H"}[index["componentType"]], index["count"])
    points = []
    for k in range(position["count"]):
        a, b, c = (flat[3 * k + i] + shift[i] for i in range(3))
        x, y, z = a, -c, b
        points.append([m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3] for r in range(3)])
    for p in points:
        assert abs(sum(v * v for v in p) ** 0.5 - length) < 3000, p
    for t in range(0, len(corners), 3):
        p, q, r = (points[k] for k in corners[t:t + 3])
        u, v = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
        normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        assert sum(a * b for a, b in zip(normal, p)) > 0, (p, q, r)
PYTHON

for crs in EPSG:4978 enu; do
  for effort in fast normal high; do
    succeeds "$scarp" simplify "$dem" s.glb -e 10 --crs $crs --effort $effort --report r.json --overwrite
    grep -q "ellipsoid of the raster's CRS" "$logs/err" || fail "$crs: nothing is said of heights"
    python3 away.py s.glb 6371000 || fail "$crs, $effort: triangles look inwards"
    succeeds "$scarp" measure "$dem" s.glb --fail-above 10 --json
    cp "$logs/out" m.json
    [ "$(json m.json max_error)" = "$(json r.json max_error)" ] || fail "$crs, $effort: measure tells another error"
    [ "$(json m.json frame kind)" = "$(json r.json frame kind)" ] || fail "$crs, $effort: measure takes another frame"
    holds "$(json r.json max_error) > 9"
  done
  for format in obj ply stl vtu; do
    succeeds "$scarp" simplify "$dem" s.$format -e 10 --crs $crs --overwrite
    succeeds "$scarp" measure "$dem" s.$format --crs $crs --fail-above 10
  done
  # Any number of threads gives the same bytes.
  succeeds "$scarp" simplify "$dem" one.glb -e 10 --crs $crs -j 1 --overwrite
  succeeds "$scarp" simplify "$dem" four.glb -e 10 --crs $crs -j 4 --overwrite
  cmp one.glb four.glb || fail "$crs: threads change the mesh"
done
[ "$(json r.json frame kind)" = '"enu"' ] || fail "the report's frame is another"
grep -qa '^property float x' s.ply || fail "a PLY east, north and up has doubles"

# A bound so coarse that only the earth's curvature needs triangles: on a map two would suffice.
python3 -c 'import struct, sys; sys.stdout.buffer.write(struct.pack("<f", 0) * (601 * 601))' > sea.img
printf 'ENVI\nsamples = 601\nlines = 601\nbands = 1\ndata type = 4\ninterleave = bsq\nbyte order = 0\n' > sea.hdr
for corner in "10 60 12 58" "179 -15 181 -17" "269 40 271 38"; do
  gdal_translate -q -a_srs EPSG:4979 -a_ullr $corner sea.img sea.tif
  succeeds "$scarp" simplify sea.tif sea.glb -e 50 --crs EPSG:4978 --report r.json --overwrite
  [ ! -s "$logs/err" ] || fail "ellipsoidal heights are warned of"
  holds "$(json r.json triangles) > 20 && $(json r.json triangles) < 400 && $(json r.json max_error) > 5"
  succeeds "$scarp" measure sea.tif sea.glb --fail-above 50
done

# Settings that are refused.
refuses 1 "--crs enu cannot be combined with --base" "$scarp" simplify "$dem" x.stl -e 10 --crs enu --base 0
refuses 1 "--crs enu cannot be combined with 2DM as OUTPUT" "$scarp" simplify "$dem" x.2dm -e 10 --crs enu
refuses 1 "--crs EPSG:4978 cannot be combined with --preview" \
  "$scarp" simplify "$dem" x.glb -e 10 --crs EPSG:4978 --preview x.png
refuses 1 "--cliff cannot be combined with --crs enu" "$scarp" simplify "$dem" x.glb -e 10 --crs enu --cliff 20
gdal_translate -q -a_srs EPSG:4326 -a_ullr -180 90 180 -90 sea.img world.tif
refuses 1 "more than 60 degrees away" "$scarp" simplify world.tif x.glb -e 10 --crs enu
gdal_translate -q -a_srs EPSG:4326 -a_ullr -180 90 180 80 sea.img cap.tif
refuses 1 "more than half around the earth" "$scarp" simplify cap.tif x.glb -e 10 --crs enu
try "$scarp" simplify "$dem" x.glb -e 0.0001 --crs enu
[ "$code" = 3 ] && grep -q "rounded to float32" "$logs/err" || fail "a bound below float32 is not refused"
