#!/usr/bin/env bash
# --roi and --falloff: small errors in the polygons and on the lines of a vector file.
source "$(dirname "$0")/lib.sh"
need python3 gdal_rasterize gdal_translate

# Regions of interest: their bound inside, another beyond, and between them a bound by distance.
python3 - <<'PYTHON'
import json
square = [[[-84.30, 36.25], [-84.25, 36.25], [-84.25, 36.30], [-84.30, 36.30], [-84.30, 36.25]]]
def layer(name, kind, coordinates):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": coordinates}}]}, open(name, "w"))
layer("site.geojson", "Polygon", square)
layer("road.geojson", "LineString", [[-84.40, 36.20], [-84.10, 36.40]])
layer("away.geojson", "Polygon", [[[1, 1], [2, 1], [2, 2], [1, 1]]])
PYTHON
refuses 1 "--roi site.geojson=inf: the error inf is neither a finite number" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=inf
refuses 1 "--roi site.geojson=-1: the error -1 is negative" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=-1
refuses 1 "--roi site.geojson=30mm: the error 30mm is neither a finite number nor a length such as 2m, 30cm or 1ft" \
  "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=30mm
refuses 1 "--roi site.geojson=1%: the error 1% is neither" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=1%
refuses 1 "--roi falloff far is neither" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=2,falloff=far
refuses 1 "--roi falloff -3m is negative" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=2,falloff=-3m
refuses 1 "--roi has no key fallof: choose falloff" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=2,fallof=3
# Units: the heights of the raster are metres.
succeeds "$scarp" simplify "$dem" plain.obj -e 50 --roi site.geojson=2,falloff=3048 --report plain.json
for region in 200cm,falloff=3048m 2m,falloff=10000ft; do
  succeeds "$scarp" simplify "$dem" units.obj -e 50 --roi site.geojson=$region --report units.json --overwrite
  cmp <(grep '^[vf]' plain.obj) <(grep '^[vf]' units.obj) || fail "the unit of $region"
done
grep -q '"falloff": "10000ft"' units.json || fail "the report of a falloff"
succeeds "$scarp" measure "$dem" units.obj --fail-above 50 --roi site.geojson=200cm,falloff=3.048e5cm
for effort in fast high; do
  succeeds "$scarp" simplify "$dem" roi.glb -e 50 --roi site.geojson=2 --effort "$effort" --report roi.json --overwrite
  succeeds "$scarp" measure "$dem" roi.glb --fail-above 50 --roi site.geojson=2
  succeeds "$scarp" simplify "$dem" near.glb -e 50 --roi site.geojson=2 --falloff 5000 --roi road.geojson=10 --effort "$effort" \
    --report near.json --overwrite
  succeeds "$scarp" measure "$dem" near.glb --fail-above 50 --roi site.geojson=2 --falloff 5000 --roi road.geojson=10
  holds "$(json near.json triangles) > $(json roi.json triangles)"
done
# Lines in the mesh do not change the bounds of the samples.
for effort in fast normal high; do
  succeeds "$scarp" simplify "$dem" lines.glb -e 50 --roi site.geojson=2 --falloff 5000 --breaklines road.geojson \
    --effort "$effort" --report lines.json --overwrite
  [ "$(json lines.json breaklines laid)" = 1 ] || fail "the line is not inserted with $effort effort"
  succeeds "$scarp" measure "$dem" lines.glb --fail-above 50 --roi site.geojson=2 --falloff 5000
done
try "$scarp" measure "$dem" roi.glb --fail-above 50 --roi site.geojson=2 --falloff 5000
[ "$code" = 3 ] || fail "a mesh without falloff keeps the bounds of one"
succeeds "$scarp" simplify "$dem" only.glb --roi site.geojson=2
succeeds "$scarp" measure "$dem" only.glb --roi site.geojson=2
# Independently measured, errors in the square are at most 2.
succeeds "$scarp" measure "$dem" roi.glb --error-raster errors.tif --overwrite
succeeds gdal_rasterize -q -burn 1 -init 0 -ot Byte -tr 0.000833333333333 0.000833333333333 \
  -te -84.41375 36.1595833333334 -84.0779166666667 36.44625 site.geojson inside.tif
succeeds gdal_translate -q -of XYZ errors.tif errors.xyz
succeeds gdal_translate -q -of XYZ inside.tif inside.xyz
python3 - <<'PYTHON'
column = lambda path: [float(line.split()[2]) for line in open(path)]
errors, inside = column("errors.xyz"), column("inside.xyz")
assert len(errors) == len(inside) and sum(inside) > 3000, (len(errors), len(inside), sum(inside))
worst = max(abs(e) for e, i in zip(errors, inside) if i)
assert worst <= 2 < max(map(abs, errors)), worst
PYTHON
succeeds "$scarp" simplify "$dem" away.glb -e 50 --roi away.geojson=1
grep -q "lies beside the raster" "$logs/err" || fail "no warning that a region lies beside the raster"
refuses 1 "--roi" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson
refuses 1 "--falloff" "$scarp" simplify "$dem" x.glb -e 50 --falloff 10
refuses 1 "--roi falloff needs --max-error" "$scarp" simplify "$dem" x.glb --roi site.geojson=2,falloff=10
refuses 1 "--mask" "$scarp" simplify "$dem" x.glb -e 50 --roi site.geojson=2 --mask "$dem"
refuses 2 "nothing.gpkg" "$scarp" simplify "$dem" x.glb -e 50 --roi nothing.gpkg=2
