#!/usr/bin/env bash
# The four formats, frames and encodings of input: measure confirms simplify's promise for the file.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

for format in glb obj ply stl; do
  succeeds "$scarp" simplify "$dem" "hills.$format" -e 20 --report "$format.json"
  "$scarp" measure "$dem" "hills.$format" --fail-above 20 --json > judged.json || fail "$format breaks the promise"
  [ "$(json "$format.json" triangles)" = "$(json judged.json triangles)" ] || fail "$format has other triangles"
  holds "$(json judged.json rmse) - $(json "$format.json" rmse) < 1e-6 && $(json "$format.json" rmse) - $(json judged.json rmse) < 1e-6"
  # By --of, whatever the extension; upper case is accepted.
  succeeds "$scarp" simplify "$dem" "named.$format.bin" -e 20 --of "${format^^}"
  cmp "hills.$format" "named.$format.bin" || fail "--of $format differs from the extension"
done
succeeds "$scarp" simplify "$dem" HILLS.GLB -e 20
cmp hills.glb HILLS.GLB || fail "the case of the extension matters"

# Frames. The mesh stores its frame, so measure needs no --crs but accepts one.
for crs in source local grid EPSG:32616 EPSG:3857; do
  for format in glb obj ply; do
    out=${crs#*:}.$format
    succeeds "$scarp" simplify "$dem" "$out" -e 20 --crs "$crs"
    succeeds "$scarp" measure "$dem" "$out" --fail-above 20
    succeeds "$scarp" measure "$dem" "$out" --fail-above 20 --crs "$crs"
  done
done
# Degrees need more digits than float32 offsets from the origin hold; STL has only offsets.
succeeds "$scarp" simplify "$dem" utm.stl -e 20 --crs EPSG:32616
succeeds "$scarp" measure "$dem" utm.stl --fail-above 20 --crs EPSG:32616
try "$scarp" measure "$dem" grid.obj --fail-above 20 --crs source
[ "$code" = 3 ] || fail "a mesh in the wrong frame passes"

# Normals.
succeeds "$scarp" simplify "$dem" normals.obj -e 20 --up z --normals
[ "$(grep -c '^vn ' normals.obj)" = "$(grep -c '^v ' normals.obj)" ] || fail "not one normal a vertex"
awk '$1 == "vn" { n = $2 * $2 + $3 * $3 + $4 * $4; if (n < 0.999 || n > 1.001 || $4 <= 0) exit 1 }' normals.obj ||
  fail "normals are not unit vectors that point up"

# RGB-encoded heights: 16 x 16 samples of 100.5 + column, both schemes.
python3 - <<'PYTHON'
def write(name, encode):
    with open(name, "wb") as f:
        f.write(b"P6 16 16 255\n")
        for row in range(16):
            for col in range(16):
                f.write(bytes(encode(100.5 + col + (3 if (row, col) == (7, 9) else 0))))
def terrarium(h):
    v = int((h + 32768) * 256)
    return v >> 16 & 255, v >> 8 & 255, v & 255
def mapbox(h):
    v = int(round((h + 10000) * 10))
    return v >> 16 & 255, v >> 8 & 255, v & 255
write("terrarium.ppm", terrarium)
write("mapbox.ppm", mapbox)
PYTHON
for scheme in terrarium mapbox; do
  succeeds "$scarp" simplify $scheme.ppm $scheme.glb -e 0 --decode $scheme --report $scheme.json
  holds "$(json $scheme.json input min) > 100.49 && $(json $scheme.json input min) < 100.51"
  holds "$(json $scheme.json input max) > 115.49 && $(json $scheme.json input max) < 115.51"
  succeeds "$scarp" measure $scheme.ppm $scheme.glb --decode $scheme --fail-above 0
done

# Colours that were resampled or lossily compressed after packing heights.
gdal_translate -q -of ENVI -ot Float32 "$dem" heights.img
python3 - <<'PYTHON'
import array
heights = array.array("f", open("heights.img", "rb").read())
head = open("heights.hdr").read().replace("data type = 4", "data type = 1").replace("bands   = 1", "bands   = 3")
for name, number in (("terrarium", lambda h: int((h + 32768) * 256)), ("mapbox", lambda h: round((h + 10000) * 10))):
    numbers = [number(h) for h in heights]
    open(f"packed_{name}.img", "wb").write(b"".join(bytes(n >> bits & 255 for n in numbers) for bits in (16, 8, 0)))
    open(f"packed_{name}.hdr", "w").write(head.split("band names")[0])
PYTHON
for scheme in terrarium mapbox; do
  succeeds "$scarp" info packed_$scheme.img --decode $scheme --no-suggest
  [ ! -s "$logs/err" ] || fail "$scheme as it was made is doubted"
  for way in "-r average -outsize 50% 50%" "-r bilinear -outsize 70% 70%" "-r bilinear -outsize 150% 150%" \
    "-r bilinear -outsize 500% 500% -srcwin 0 0 100 100" "-of JPEG -co QUALITY=75" "-of JPEG -co QUALITY=100"; do
    gdal_translate -q $way packed_$scheme.img changed
    succeeds "$scarp" info changed --decode $scheme --no-suggest --json
    grep -q "warning: .* samples jump by up to .* where a colour begins anew" "$logs/err" || fail "$scheme: $way goes unseen"
    holds "$(json "$logs/out" input packed torn) > 24"
  done
  gdalwarp -q -overwrite -r bilinear -t_srs EPSG:32616 packed_$scheme.img warped.tif
  succeeds "$scarp" info warped.tif --decode $scheme --no-suggest
  grep -q "where a colour begins anew" "$logs/err" || fail "$scheme: gdalwarp goes unseen"
  gdal_translate -q -co COMPRESS=JPEG -co JPEG_QUALITY=100 packed_$scheme.img changed
  succeeds "$scarp" info changed --decode $scheme --no-suggest
  grep -q "where a colour begins anew\|compressed with a loss (JPEG)" "$logs/err" || fail "$scheme: JPEG without YCbCr goes unseen"
done

# Bands.
gdal_translate -q -scale 236 1076 0 100 -ot Float32 "$dem" second.tif
if command -v gdalbuildvrt > /dev/null; then
  gdalbuildvrt -q -separate both.vrt "$dem" second.tif
  succeeds "$scarp" simplify both.vrt band.glb -e 5% --band 2 --report band.json
  holds "$(json band.json input max) < 101"
  [ "$(json band.json input band)" = 2 ] || fail "the report tells another band"
  succeeds "$scarp" measure both.vrt band.glb --band 2 --fail-above 5
fi
