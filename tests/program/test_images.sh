#!/usr/bin/env bash
# Images and stacks of bands as coloured triangles: bounds in grey levels, agreement with the judge, refusals.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalbuildvrt gdalinfo

make_image photo.tif '(col * 255) // 402' '128 + 100 * math.sin(col * row / 40000)' 'row // 2 if col > row else 200'
GDAL_PAM_ENABLED=NO gdal_translate -q -of PNG photo.tif photo.png

# agree: simplify's report and measure's agree on every band.
agree() {
  python3 - s.json m.json <<'PYTHON'
import json, math, sys
s, m = (json.load(open(f)) for f in sys.argv[1:3])
assert abs(s["combined_max_error"] - m["combined_max_error"]) <= 1e-6 * s["combined_max_error"], (s, m)
assert s["norm"] == m["norm"] and s["height_scale"] == m["height_scale"] and "max_error" not in {**s, **m}
assert [c["name"] for c in s["channels"]] == [c["name"] for c in m["channels"]]
for a, b in zip(s["channels"], m["channels"]):
    assert a["scale"] == b["scale"] and a["samples"] == b["samples"] == s["samples"], (a, b)
    for key in "max_error", "rmse", "mean_error":
        assert math.isclose(a[key], b[key], rel_tol=1e-6, abs_tol=1e-9), (key, a, b)
PYTHON
}

# -e is in grey levels: no colour of a pixel is off by more.
for format in glb ply obj; do
  succeeds "$scarp" simplify photo.tif "p.$format" -e 8 --image --report s.json --overwrite
  succeeds "$scarp" measure photo.tif "p.$format" --image --fail-above 8 --json
  cp "$logs/out" m.json
  agree
  python3 - s.json <<'PYTHON'
import json, sys
s = json.load(open(sys.argv[1]))
assert [c["name"] for c in s["channels"]] == ["red", "green", "blue"] and s["norm"] == "linf"
assert max(c["max_error"] for c in s["channels"]) <= 8 and all(c["scale"] == 1 for c in s["channels"])
PYTHON
  try "$scarp" measure photo.tif "p.$format" --image --fail-above 6
  [ "$code" = 3 ] && grep -q 'combined max error .* at column .* exceeds 6' "$logs/err" || fail "a broken bound passes"
done
python3 - p.glb <<'PYTHON'
import json, struct, sys
data = open(sys.argv[1], "rb").read()
gltf = json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])
attributes = gltf["meshes"][0]["primitives"][0]["attributes"]
assert {"POSITION", "COLOR_0", "TEXCOORD_0"} <= set(attributes), attributes
PYTHON
succeeds "$scarp" simplify photo.tif percent.ply -e 10% --image --report s.json --overwrite
holds "$(json s.json goal max_error) == 25.5"

# y is up in the image, and the first row is the top.
succeeds "$scarp" simplify photo.png up.ply -p 500 --image --effort fast --report s.json --overwrite
[ "$(json s.json frame kind)" = '"grid"' ] || fail "an image without a place is not in the grid frame"

# Refinement improves with the budget, and the picture of an exact mesh is the image.
last=0
for points in 100 400 1600; do
  succeeds "$scarp" simplify photo.png r.ply -p $points --image --effort fast --render r.png --report s.json --overwrite
  holds "$(json s.json psnr) > $last + 1"
  last=$(json s.json psnr)
done
make_image flat.tif '10 + col // 4' 20 30
succeeds "$scarp" simplify flat.tif r.ply -e 0 --image --effort fast --render r.png --report s.json --overwrite
[ "$(json s.json psnr)" = '"inf"' ] || fail "an exact mesh does not look like its image"
gdalinfo r.png | grep -q 'Size is 403, 344' || fail "the rendering has another size"

# Norms and weights: bounds on sums and on single bands.
succeeds "$scarp" simplify photo.tif w.glb -e 20 --image --norm l1 --report s.json --overwrite
succeeds "$scarp" measure photo.tif w.glb --image --norm l1 --fail-above 20 --json
cp "$logs/out" m.json
agree
succeeds "$scarp" simplify photo.tif w.ply -e 20 --image --channel-weights 1,0,4 --norm l2 --report s.json --overwrite
succeeds "$scarp" measure photo.tif w.ply --image --channel-weights 1,0,4 --norm l2 --fail-above 20 --json
cp "$logs/out" m.json
agree
holds "$(json s.json channels 0 max_error) <= 20 && $(json s.json channels 2 max_error) <= 5 && $(json s.json channels 1 max_error) > 20"

# A stack of other bands, not bytes: all are scaled to the largest range. A single band; a grey image.
make_raster b1.tif 'col * 10.5'
make_raster b2.tif 'math.sin(col / 30) + row / 400'
gdalbuildvrt -q -separate stack.vrt b1.tif b2.tif b1.tif b2.tif b2.tif
gdal_translate -q stack.vrt stack.tif
for format in glb ply; do
  succeeds "$scarp" simplify stack.tif "k.$format" -e 50 --image --report s.json --overwrite
  succeeds "$scarp" measure stack.tif "k.$format" --image --fail-above 50 --json
  cp "$logs/out" m.json
  agree
done
python3 - s.json <<'PYTHON'
import json, math, sys
c = json.load(open(sys.argv[1]))["channels"]
assert len(c) == 5 and [x["name"] for x in c][:2] == ["band 1", "band 2"]
assert math.isclose(c[0]["scale"], 1, rel_tol=1e-6) and c[1]["scale"] > 1000
PYTHON
succeeds "$scarp" simplify stack.tif one.glb -e 0.1 --image --band 2 --effort fast --report s.json --overwrite
succeeds "$scarp" measure stack.tif one.glb --image --band 2 --fail-above 0.1 -q
holds "$(json s.json triangles) > 100"
gdal_translate -q -b 2 photo.tif grey.tif
succeeds "$scarp" simplify grey.tif grey.obj -e 8 --image
succeeds "$scarp" measure grey.tif grey.obj --image --fail-above 8 -q

# Missing pixels are holes; masks weight colours like heights; errors as a raster.
gdal_translate -q -a_nodata 200 photo.tif holes.tif
succeeds "$scarp" simplify holes.tif holes.ply -e 8 --image
succeeds "$scarp" measure holes.tif holes.ply --image --fail-above 8 --json
holds "$(json "$logs/out" void_cells_covered) == 0 && $(json "$logs/out" input void) > 0"
make_raster half.tif 'col < 200' Byte
succeeds "$scarp" simplify photo.tif half.ply -e 8 --image --mask half.tif --report s.json --overwrite --error-raster e.tif
succeeds "$scarp" measure photo.tif half.ply --image --mask half.tif --fail-above 8 --error-raster e2.tif --map m.png -q
holds "$(json s.json combined_max_error) > 20 && $(json s.json weighted_max_error) <= 8.00001"
python3 - s.json "$(gdalinfo -mm e.tif | grep 'Computed Min/Max')" <<'PYTHON'
import json, sys
low, high = map(float, sys.argv[2].split("=")[1].split(","))
assert low >= 0 and abs(high - json.load(open(sys.argv[1]))["combined_max_error"]) < 1e-3
PYTHON
gdalinfo -checksum e.tif | grep Checksum > sum1
gdalinfo -checksum e2.tif | grep Checksum > sum2
cmp sum1 sum2 || fail "the two error rasters differ"

# Photographs.
shared=${SCARP_SHARED:-$SCARP_SOURCE/../shared}/data
if [ -d "$shared" ]; then
  for photo in astronaut kodim05 kodim23; do
    succeeds "$scarp" simplify "$shared/$photo.png" photo.glb -p 2000 --image --edges data --report s.json --render x.png --overwrite
    succeeds "$scarp" measure "$shared/$photo.png" photo.glb --image --json
    cp "$logs/out" m.json
    agree
    holds "$(json s.json psnr) > 15"
  done
fi

image() { "$scarp" simplify photo.tif "$@" --image; }
refuses 1 "STL has no place for colours" image out.stl -e 8
refuses 1 "OBJ has a place for 8-bit colours only" "$scarp" simplify stack.tif out.obj -e 8 --image
refuses 1 "TIN has no place for colours" image out.tin -e 8
refuses 1 "has no place for colours" image out.tif -e 8
refuses 1 "--image cannot be combined with --texture" image out.glb -e 8 --texture photo.tif
refuses 1 "--image cannot be combined with --decode" image out.glb -e 8 --decode terrarium
refuses 1 "--image cannot be combined with --nodata-policy" image out.glb -e 8 --nodata-policy fill
refuses 1 "--importance measures features of heights" image out.glb -e 8 --importance 'global*local'
refuses 1 "--norm weights has 2 weights for 3 bands" image out.glb -e 8 --channel-weights 1,2
for bad in 1,-2,3 1,,3 a '' 1,2,3, 1,nan,2; do refuses 1 "--norm weights" image out.glb -e 8 --channel-weights "$bad"; done
refuses 1 "are all 0" image out.glb -e 8 --channel-weights 0,0,0
refuses 1 "--norm l3 is unknown: choose l1, l2 or linf" image out.glb -e 8 --norm l3
refuses 1 "--norm needs --texture or --image" "$scarp" simplify "$dem" out.glb -e 8 --norm l1
refuses 1 "--channel-weights needs --texture or --image" "$scarp" simplify "$dem" out.glb -e 8 --channel-weights 1
gdal_translate -q -b 1 -b 2 -b 3 -b 1 -colorinterp red,green,blue,alpha photo.tif alpha.tif
refuses 2 "alpha" "$scarp" simplify alpha.tif out.glb -e 8 --image
succeeds "$scarp" simplify "$dem" heights.glb -e 100
refuses 2 "heights.glb holds no colours" "$scarp" measure photo.tif heights.glb --image
refuses 2 "to compare with" "$scarp" measure stack.tif p.glb --image
refuses 2 "5 channels but 3 bands" "$scarp" measure photo.tif k.ply --image
echo "images are bounded in grey levels"
