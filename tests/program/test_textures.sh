#!/usr/bin/env bash
# Textures count with heights: -e remains a true bound on heights, the judge agrees, and textures on other grids are
# refused.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalbuildvrt gdalinfo

make_image ortho.tif '(col * 255) // 402' '128 + 100 * math.sin(col * row / 40000)' '200 if (col // 50 + row // 50) % 2 else 40'
make_raster infra.tif 'math.hypot(col - 200, row - 170)'
textured() { "$scarp" simplify "$dem" "$@"; }

agree() {
  python3 - s.json m.json <<'PYTHON'
import json, math, sys
s, m = (json.load(open(f)) for f in sys.argv[1:3])
for key in "combined_max_error", "max_error", "rmse":
    assert math.isclose(s[key], m[key], rel_tol=1e-6), (key, s[key], m[key])
for a, b in zip(s["channels"], m["channels"], strict=True):
    assert a["name"] == b["name"] and math.isclose(a["scale"], b["scale"])
    assert math.isclose(a["max_error"], b["max_error"], rel_tol=1e-6) and math.isclose(a["rmse"], b["rmse"], rel_tol=1e-6)
PYTHON
}

for norm in l1 l2 linf; do
  for format in glb ply obj; do
    [ $norm = l1 ] || [ $format = ply ] || continue
    succeeds textured "t.$format" -e 60 --texture ortho.tif --norm $norm --texture-weight 0.4 --report s.json --overwrite
    succeeds "$scarp" measure "$dem" "t.$format" --texture ortho.tif --norm $norm --texture-weight 0.4 --fail-above 60 --json
    cp "$logs/out" m.json
    agree
    holds "$(json s.json max_error) <= 60 && $(json s.json combined_max_error) <= 60.0001"
  done
  # Scape's emphasis: all channels together have weight w / (1 - w) against the heights, as shares of their ranges.
  python3 - s.json $norm <<'PYTHON'
import json, math, sys
s = json.load(open(sys.argv[1]))
share = {"l1": 1 / 3, "l2": 3 ** -0.5, "linf": 1}[sys.argv[2]]
assert s["height_scale"] == 1
assert math.isclose(s["channels"][0]["scale"], 0.4 / 0.6 * (1076 - 236) / 255 * share), s["channels"][0]
PYTHON
done
try "$scarp" measure "$dem" t.ply --texture ortho.tif --norm linf --texture-weight 0.4 --fail-above 40
[ "$code" = 3 ] && grep -q 'combined max error .* exceeds 40' "$logs/err" || fail "a broken bound passes"

# More weight on the texture improves colours; 0 means heights only, 1 textures only.
succeeds textured a.glb -p 1500 --texture ortho.tif --texture-weight 0 --effort fast --report a.json
succeeds textured b.glb -p 1500 --texture ortho.tif --texture-weight 0.9 --effort fast --report b.json --render b.png
succeeds textured c.glb -p 1500 --texture ortho.tif --texture-weight 1 --report c.json
succeeds textured plain.glb -p 1500 --effort fast --report plain.json
holds "$(json a.json max_error) == $(json plain.json max_error)"
holds "$(json b.json channels 2 rmse) < $(json a.json channels 2 rmse) && $(json a.json rmse) < $(json b.json rmse)"
holds "$(json c.json height_scale) == 0 && $(json b.json psnr) > 10"

# Several files, weights of their bands, a coloured solid, only texture coordinates.
succeeds textured m.glb -e 80 --texture ortho.tif --texture infra.tif --channel-weights 1,1,1,3 --report s.json --overwrite
succeeds "$scarp" measure "$dem" m.glb --texture ortho.tif --texture infra.tif --channel-weights 1,1,1,3 --fail-above 80 --json
cp "$logs/out" m.json
agree
grep -q -- '--texture ortho.tif --texture infra.tif --norm weights=1,1,1,3' <(strings m.glb) || fail "the metadata does not name the textures"
succeeds textured solid.ply -e 80 --texture ortho.tif --base 0
succeeds "$scarp" measure "$dem" solid.ply --texture ortho.tif --fail-above 80 -q
succeeds textured uv.obj -e 80 --uvs
grep -q '^vt 0 1$' uv.obj || grep -q '^vt ' uv.obj || fail "--uvs writes no texture coordinates"
succeeds textured t.stl -e 80 --texture ortho.tif
grep -q 'STL has no place for colours' "$logs/err" || fail "no word about lost colours"

succeeds textured m.obj -e 80 --texture ortho.tif --texture infra.tif
grep -q 'OBJ has a place for 8-bit colours only' "$logs/err" || fail "no word about lost channels"
for threads in 1 3; do
  succeeds textured threads$threads.glb -t 9000 --texture ortho.tif --edges data -j $threads
done
cmp threads1.glb threads3.glb || fail "the mesh depends on the number of threads"

gdal_translate -q -outsize 50% 50% ortho.tif small.tif
refuses 2 "--texture small.tif is" textured out.glb -e 9 --texture small.tif
refuses 2 "bring it onto the grid" textured out.glb -e 9 --texture small.tif
gdal_translate -q -a_srs EPSG:32616 -a_ullr 700000 4030000 736270 3999040 ortho.tif utm.tif
refuses 2 "is in EPSG:32616 instead of EPSG:4326" textured out.glb -e 9 --texture utm.tif
gdal_translate -q -b 1 -b 2 -b 3 -b 1 -colorinterp red,green,blue,alpha ortho.tif alpha.tif
refuses 2 "alpha" textured out.glb -e 9 --texture alpha.tif
gdal_translate -q -a_nodata 200 ortho.tif gaps.tif
refuses 2 "has no value at column" textured out.glb -e 9 --texture gaps.tif
refuses 2 "missing.tif" textured out.glb -e 9 --texture missing.tif
many=()
for _ in $(seq 22); do many+=(--texture ortho.tif); done
refuses 2 "66 bands, more than 64" textured out.glb -e 9 "${many[@]}"
refuses 1 "--texture-weight needs --texture" textured out.glb -e 9 --texture-weight 0.5
for bad in -0.1 1.1 nan x; do refuses 1 "--texture weight $bad" textured out.glb -e 9 --texture "ortho.tif,weight=$bad"; done
refuses 1 "--texture weight 1 cannot be combined with --max-error" textured out.glb -e 9 --texture ortho.tif --texture-weight 1
refuses 1 "no goal is given" textured out.glb --texture ortho.tif --texture-weight 1
refuses 1 "input file" textured out.glb -e 9 --texture ortho.tif --error-raster ortho.tif --overwrite
refuses 1 "has 2 weights for 3 bands" textured out.glb -e 9 --texture ortho.tif --channel-weights 1,2
refuses 2 "holds no colours" "$scarp" measure "$dem" plain.glb --texture ortho.tif

# A real pair: an elevation model and the aerial photograph on the same grid.
shared=${SCARP_SHARED:-$SCARP_SOURCE/../shared}/data
if [ -d "$shared" ]; then
  elevation=$shared/santa_barbara_elev.tif aerial=$shared/santa_barbara_aerial.tif
  succeeds "$scarp" simplify "$elevation" sb.glb -p 5000 --texture "$aerial" --report s.json --overwrite --render sb.png
  succeeds "$scarp" measure "$elevation" sb.glb --texture "$aerial" --json
  cp "$logs/out" m.json
  agree
fi
echo "textures count beside the heights"
