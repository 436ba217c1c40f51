#!/usr/bin/env bash
# --cutline, --inset and --mask-outside: the surface ends at the polygons of a vector file, and the bound holds within.
source "$(dirname "$0")/lib.sh"
need python3 gdal_rasterize gdal_translate ogrinfo

python3 - <<'PYTHON'
import json, math
def layer(name, *geometries):
    json.dump({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": coordinates}} for kind, coordinates in geometries]},
        open(name, "w"))
x, y = -84.24, 36.30
star = [[x + (0.12 if k % 2 else 0.06) * math.cos(k * math.pi / 8), y + (0.11 if k % 2 else 0.05) * math.sin(k * math.pi / 8)] for k in range(16)]
hole = [[x - .02, y - .02], [x + .015, y - .018], [x + .02, y + .017], [x - .018, y + .02]]
square = [[-84.4003, 36.1703], [-84.3697, 36.1703], [-84.3697, 36.2004], [-84.4003, 36.2004]]
ring = lambda points: points + points[:1]
layer("star.geojson", ("MultiPolygon", [[ring(star), ring(hole)], [ring(square)]]))
layer("bow.geojson", ("Polygon", [ring([[-84.35, 36.2], [-84.2, 36.4], [-84.2, 36.2], [-84.35, 36.4]])]))
layer("closed.geojson", ("LineString", ring(square)))
layer("open.geojson", ("LineString", square))
layer("away.geojson", ("Polygon", [[[1, 1], [2, 1], [2, 2], [1, 1]]]))
layer("beyond.geojson", ("Polygon", [ring([[-90, 30], [-80, 30], [-80, 40], [-90, 40]])]))
layer("point.geojson", ("Point", [x, y]))
PYTHON

# Facts about an OBJ: plan area, triangles, thin triangles (height below a tenth of their longest edge), and thin ones
# without a corner on the border.
cat > mesh.py <<'PYTHON'
import sys
vertices, faces = [], []
for line in open(sys.argv[1]):
    words = line.split()
    if words[:1] == ["v"]: vertices.append(tuple(map(float, words[1:4])))
    if words[:1] == ["f"]: faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
uses = {}
for f in faces:
    for k in range(3):
        edge = frozenset((f[k], f[(k + 1) % 3]))
        uses[edge] = uses.get(edge, 0) + 1
border = {v for edge, n in uses.items() if n == 1 for v in edge}
area, thin, free = 0, 0, 0
for f in faces:
    p = [vertices[v] for v in f]
    a = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])
    longest = max((p[k][0] - p[k - 1][0]) ** 2 + (p[k][1] - p[k - 1][1]) ** 2 for k in range(3))
    area += a / 2
    if a / longest < 0.0999:
        thin += 1
        free += not border & set(f)
print(repr(area), len(faces), thin, free)
PYTHON

# GDAL's results for the polygons: area and samples inside.
burn() { # FILE OUT
  rm -f "$2"
  succeeds gdal_rasterize -q -burn 1 -init 0 -ot Byte -tr 0.000833333333333 0.000833333333333 \
    -te -84.41375 36.1595833333334 -84.0779166666667 36.44625 "$1" "$2"
}
area_of() { # FILE LAYER
  ogrinfo -q -sql "SELECT SUM(OGR_GEOM_AREA) AS area FROM \"$2\"" "$1" | sed -n 's/.*area (Real) = //p'
}

burn star.geojson inside.tif
succeeds gdal_translate -q -of XYZ inside.tif inside.xyz
for effort in fast normal high max; do
  succeeds "$scarp" simplify "$dem" cut.obj -e 20 --up z --effort "$effort" --cutline star.geojson --crs source --report cut.json --overwrite
  holds "$(json cut.json max_error) <= 20"
  [ "$(json cut.json topology sound)" = true ] || fail "a cutline and $effort effort make an unsound mesh"
  [ "$(json cut.json cutline polygons)" = 2 ] || fail "a multipolygon of two is not two polygons"
  succeeds "$scarp" measure "$dem" cut.obj --crs source --cutline star.geojson --fail-above 20 --error-raster errors.tif --overwrite
  succeeds gdal_translate -q -of XYZ errors.tif errors.xyz
  python3 - <<'PYTHON' || fail "$effort effort covers other samples than GDAL burns"
column = lambda path: [float(line.split()[2]) for line in open(path)]
errors, inside = column("errors.xyz"), column("inside.xyz")
assert len(errors) == len(inside) and 20000 < sum(inside) < 40000, (len(errors), sum(inside))
covered = [e == e and abs(e) < 1e30 for e in errors]
other = sum(c != (i > 0) for c, i in zip(covered, inside))
assert other <= 40, other  # on the boundary itself either answer is valid
assert max(abs(e) for e, c in zip(errors, covered) if c) <= 20
PYTHON
  read -r area triangles thin free < <(python3 mesh.py cut.obj)
  python3 - "$area" <<'PYTHON' || fail "with $effort effort the mesh has the area $area"
import json, sys
def doubled(ring): return abs(sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(ring, ring[1:])))
polygons = json.load(open("star.geojson"))["features"][0]["geometry"]["coordinates"]
wanted = sum(doubled(rings[0]) - sum(map(doubled, rings[1:])) for rings in polygons) / 2
length = sum(((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) ** 0.5 for rings in polygons for ring in rings for p, q in zip(ring, ring[1:]))
assert abs(float(sys.argv[1]) - wanted) < length * 0.000833333333333 / 512, (sys.argv[1], wanted)
PYTHON
  echo "$effort: $triangles triangles, $thin below a shape of a tenth, $free of them off the boundary"
  [ "$effort" = fast ] || [ "$effort" = normal ] || holds "$thin <= $triangles * 0.01"
done
ogr_area=$(area_of star.geojson star)
[ -n "$ogr_area" ] || fail "GDAL says no area"
holds "($ogr_area - $area) ^ 2 < (1e-4 * $ogr_area) ^ 2"

# The same bytes on any number of threads; judged without the cutline the mesh fails.
succeeds "$scarp" simplify "$dem" one.glb -e 20 --cutline star.geojson -j 1
succeeds "$scarp" simplify "$dem" two.glb -e 20 --cutline star.geojson -j 2
cmp one.glb two.glb || fail "-j 2 makes another mesh"
succeeds "$scarp" measure "$dem" one.glb --cutline star.geojson --fail-above 20
try "$scarp" measure "$dem" one.glb --fail-above 20
[ "$code" = 3 ] || fail "a mesh that was cut passes for a whole one"
succeeds "$scarp" simplify "$dem" whole.glb -e 20
succeeds "$scarp" measure "$dem" whole.glb --cutline star.geojson --fail-above 20 --json
mv "$logs/out" whole.json
holds "$(json whole.json cutline samples_outside) + $(json whole.json samples) + $(json whole.json stray) == 138632"

# Self-crossing rings, closed lines, unions over files, polygons beyond the raster.
succeeds "$scarp" simplify "$dem" bow.glb -e 20 --cutline bow.geojson --cutline closed.geojson --report bow.json
[ "$(json bow.json cutline polygons)" = 2 ] || fail "a bow-tie and a closed line are not two polygons"
succeeds "$scarp" measure "$dem" bow.glb --cutline bow.geojson --cutline closed.geojson --fail-above 20
succeeds "$scarp" simplify "$dem" all.glb -e 20 --cutline beyond.geojson --report all.json
[ "$(json all.json cutline samples_outside)" = 0 ] || fail "a polygon around the raster leaves samples out"
succeeds "$scarp" simplify "$dem" solid.stl -e 20 --cutline star.geojson --base 0 --report solid.json

# Breaklines and water end at the cutline.
succeeds "$scarp" simplify "$dem" lines.glb -e 20 --cutline star.geojson --breaklines open.geojson --soft-breaklines --breaklines bow.geojson
succeeds "$scarp" measure "$dem" lines.glb --cutline star.geojson --fail-above 20

# Along samples: like GDAL's burning, and with a budget.
succeeds "$scarp" simplify "$dem" mask.glb -t 2000 --cutline star.geojson --mask-outside --report mask.json --error-raster masked.tif
holds "$(json mask.json triangles) <= 2000"
[ "$(json mask.json cutline mask_outside)" = true ] || fail "the report does not tell of --mask-outside"
succeeds gdal_translate -q -of XYZ masked.tif masked.xyz
python3 - <<'PYTHON' || fail "--mask-outside covers other samples than GDAL burns"
column = lambda path: [float(line.split()[2]) for line in open(path)]
errors, inside = column("masked.xyz"), column("inside.xyz")
other = sum((e == e and abs(e) < 1e30) != (i > 0) for e, i in zip(errors, inside))
assert other <= 60, other  # on the boundary, and samples without a cell
PYTHON
succeeds "$scarp" measure "$dem" mask.glb --cutline star.geojson --mask-outside --fail-above 1000

# Moved inwards: fewer samples; with a negative distance more.
succeeds "$scarp" simplify "$dem" in.glb -e 20 --cutline star.geojson --inset 200 --report in.json
succeeds "$scarp" measure "$dem" in.glb --cutline star.geojson --inset 200 --fail-above 20
succeeds "$scarp" simplify "$dem" out.glb -e 20 --cutline star.geojson --inset=-200 --report out.json
holds "$(json in.json cutline samples_outside) > $(json cut.json cutline samples_outside)"
holds "$(json out.json cutline samples_outside) < $(json cut.json cutline samples_outside)"

# A distance too small for coordinates has no effect.
succeeds "$scarp" simplify "$dem" tiny.glb -e 20 --cutline star.geojson --inset 1e-300 --report tiny.json
holds "$(json tiny.json cutline samples_outside) == $(json cut.json cutline samples_outside)"

refuses 2 "open.geojson feature 0 is an open line" "$scarp" simplify "$dem" x.glb -e 20 --cutline open.geojson
refuses 2 "beside the raster" "$scarp" simplify "$dem" x.glb -e 20 --cutline away.geojson
refuses 2 "lies in the polygons" "$scarp" simplify "$dem" x.glb -e 20 --cutline away.geojson --mask-outside
# A strip with samples but without a cell.
echo '{"type":"Polygon","coordinates":[[[-84.3,36.2998],[-84.1,36.2998],[-84.1,36.3004],[-84.3,36.2998]]]}' > strip.geojson
refuses 2 "no cell with three heights" "$scarp" simplify "$dem" x.glb -e 20 --cutline strip.geojson --mask-outside
refuses 2 "point.geojson" "$scarp" simplify "$dem" x.glb -e 20 --cutline point.geojson
refuses 2 "nothing.gpkg" "$scarp" simplify "$dem" x.glb -e 20 --cutline nothing.gpkg
refuses 2 "nothing of the polygons is left" "$scarp" simplify "$dem" x.glb -e 20 --cutline star.geojson --inset 20000
# A print of the part in the polygon, whole and in print tiles.
succeeds "$scarp" simplify "$dem" print.stl -e 20 --cutline star.geojson --solid size=100mm
succeeds "$scarp" measure "$dem" print.stl --cutline star.geojson --fail-above 20
grep -q "closed solid" "$logs/out" || fail "the print is not closed"
succeeds "$scarp" simplify "$dem" sheet.stl -e 20 --cutline star.geojson --solid size=100mm --split 2x1

# Shape goals up to the boundary, and walls inside.
for effort in fast high; do
  succeeds "$scarp" simplify "$dem" shape.ply -e 20 --crs local --min-angle 25 --max-edge 2000 --effort "$effort" \
    --cutline star.geojson --report shape.json --overwrite
  succeeds "$scarp" measure "$dem" shape.ply --cutline star.geojson --fail-above 20
  holds "$(json shape.json shape longest_edge) <= 2000"
  holds "$(json shape.json shape below) - $(json shape.json shape forced) <= 5"
  succeeds "$scarp" simplify "$dem" walls.ply -e 5 --cliff 30 --effort "$effort" --cutline star.geojson --report walls.json --overwrite
  succeeds "$scarp" measure "$dem" walls.ply --cutline star.geojson --fail-above 5
done

# The places where such distant rings enter the raster are unknown.
echo '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
 {"type": "Polygon", "coordinates": [[[1, 1], [1e17, 5], [-1e17, 1e17], [1, 1]]]}}]}' >far.geojson
refuses 2 "feature 0 has a vertex at 1e+17, 5, too far away to be placed" "$scarp" simplify "$dem" x.glb -e 20 --cutline far.geojson
refuses 2 "too far away to be placed" "$scarp" simplify "$dem" x.glb -e 20 --cutline far.geojson --mask-outside
refuses 2 "too far away to be placed" "$scarp" measure "$dem" one.glb --cutline far.geojson

refuses 1 "--inset" "$scarp" simplify "$dem" x.glb -e 20 --inset 5
refuses 1 "--cutline inset wide" "$scarp" simplify "$dem" x.glb -e 20 --cutline star.geojson,inset=wide
refuses 1 "--mask-outside" "$scarp" measure "$dem" one.glb --mask-outside
refuses 1 "--cutline whole-cells" "$scarp" simplify "$dem" x.glb -e 20 --outline-tolerance 1 --cutline star.geojson
refuses 1 "--cutline" "$scarp" simplify "$dem" x.glb -e 20 --edges data --cutline star.geojson
refuses 1 "needs a frame" "$scarp" simplify "$dem" x.glb -e 20 --crs EPSG:32616 --cutline star.geojson
