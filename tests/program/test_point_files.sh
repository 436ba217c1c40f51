#!/bin/bash
# Contents of text columns: numbers, northings, heights, nodes of a raster; attributes instead of zeros.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need python3 gdal_translate

python3 - <<'PY'
import json, math, random
random.seed(5)
height = lambda x, y: 320 + 20 * math.sin(x / 9) * math.cos(y / 7)
xs, ys = range(60), range(50)
def write(name, nodes, form="%.2f %.2f %.2f\n", head=""):
    with open(name, "w") as file:
        file.write(head)
        for x, y in nodes:
            file.write(form % (500000 + x, 5000000 + y, height(x, y)))
north = [(x, y) for y in reversed(ys) for x in xs]
write("north.xyz", north)
write("south.xyz", [(x, y) for y in ys for x in xs])
write("columns.xyz", [(x, y) for x in xs for y in ys])
write("snake.csv", [(x, y) for y in ys for x in (xs if y % 2 else reversed(xs))], "%.2f,%.2f,%.2f\n", "x,y,z\n")
write("german.txt", random.sample(north, len(north)), "%.1f;%.1f;%.2f\n")
write("plain", north, "%d %d %.2f\n")
holes = [(x, y) for x, y in north if not (20 < x < 35 and 10 < y < 30)]
write("holes.xyz", holes)
write("diagonal.xyz", [(x, y) for x, y in north if x > y])
write("scattered.xyz", [(x + random.random(), y + random.random()) for x, y in north])
write("sparse.xyz", random.sample(north, 600))
write("left/a.xyz".replace("/", "_"), [(x, y) for x, y in holes if x < 30])
write("right_b.xyz", [(x, y) for x, y in holes if x >= 30])
# The surveyor's file, without a header.
with open("pnezd.csv", "w") as file:
    for k in range(400):
        x, y = random.random() * 500, random.random() * 500
        file.write("%d,%.2f,%.2f,%.2f,GND\n" % (k + 1, 4000000 + y, 500000 + x, 80 + 10 * math.sin(x / 50)))
def points(name, z, **more):
    features = []
    for k in range(100):
        x, y = 10 * (k % 10) + random.random(), 10 * (k // 10) + random.random()
        land = 400 + x + y
        features.append({"type": "Feature", "properties": {key: land + add for key, add in more.items()},
                         "geometry": {"type": "Point", "coordinates": [x, y] + ([] if z is None else [z(k, land)])}})
    json.dump({"type": "FeatureCollection", "features": features,
               "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32611"}}}, open(name, "w"))
points("attribute.geojson", lambda k, land: 0, elevation=0, site=7)
points("two.geojson", lambda k, land: 0, elevation=0, height=50)
points("flat.geojson", lambda k, land: 0, site=7)
points("some.geojson", lambda k, land: land if k % 10 else 0)
points("sentinel.geojson", lambda k, land: land if k % 10 else -9999)
PY

# One rule for a file and a folder: a raster's nodes in any order are a raster.
succeeds gdal_translate -q north.xyz north.tif
succeeds "$scarp" simplify north.xyz whole.obj -e 0.5 -q --crs source
succeeds "$scarp" measure north.tif whole.obj --fail-above 0.5 -q
for file in north.xyz south.xyz columns.xyz snake.csv german.txt plain; do
  succeeds "$scarp" simplify "$file" grid.obj -e 0.5 --overwrite --crs source
  grep -q 'read as .*raster of 60 x 50 nodes (--points: as scattered points)' "$logs/out" || fail "$file: how it was read"
  [ "$file" = german.txt ] || cmp <(grep '^[vf]' grid.obj) <(grep '^[vf]' whole.obj) || fail "$file is another raster"
  succeeds "$scarp" measure "$file" grid.obj --fail-above 0.5 -q
done
succeeds "$scarp" simplify holes.xyz holes.obj -e 0.5 --report holes.json
[ "$(json holes.json input void)" = "$((14 * 19))" ] || fail "missing nodes are no holes"
grep -q "\"view\": \"raster of 60 x 50 nodes, 266 of them missing (--points: as scattered points)\"" holes.json ||
  fail "the report does not say how the text was read"
mkdir both && mv left_a.xyz right_b.xyz both
succeeds "$scarp" simplify both both.obj -e 0.5 --report both.json
cmp <(grep '^[vf]' both.obj) <(grep '^[vf]' holes.obj) || fail "a folder of texts is read otherwise than one text"
succeeds "$scarp" info diagonal.xyz --json --no-suggest
[ "$(json "$logs/out" input cols)" = 59 ] || fail "half of a sheet is no raster"
succeeds "$scarp" simplify north.xyz scattered.obj -e 0.5 --points
grep -Eq 'points  *3,?000' "$logs/out" || fail "--points does not choose points"
succeeds "$scarp" info scattered.xyz sparse.xyz
grep -q 'points  *3600' "$logs/out" || fail "info of two files of points"
for file in scattered.xyz sparse.xyz; do
  succeeds "$scarp" info "$file"
  grep -q 'read as  *1 x, 2 y, 3 height' "$logs/out" || fail "$file: info does not tell how columns are read"
done
succeeds "$scarp" tile south.xyz tiles --grid local -q --vertical none
refuses 1 "is read as a raster: --points reads it as points" "$scarp" simplify north.xyz x.obj -e 1 --z-field z

# Columns: recognized, named, stored.
succeeds "$scarp" info pnezd.csv --json
python3 - "$logs/out" <<'PY' || fail "the surveyor's file"
import json, sys
r = json.load(open(sys.argv[1]))["points"]
assert r["columns"].startswith("1 not read, 2 y, 3 x, 4 height, 5 not read"), r["columns"]
assert 500000 <= r["bounds"]["low"][0] < 500500 and 4000000 <= r["bounds"]["low"][1] < 4000500, r["bounds"]
assert 60 < r["bounds"]["low"][2] < 100
PY
succeeds "$scarp" simplify pnezd.csv pnezd.ply -e 0.5
grep -q 'warning: .*column 2 (4000.* is taken for the northing' "$logs/err" || fail "the order is taken without a word"
grep -q 'read as  *1 not read, 2 y, 3 x, 4 height' "$logs/out" || fail "the summary does not tell the columns"
succeeds "$scarp" simplify pnezd.csv named.ply -e 0.5 --columns pnezd
[ ! -s "$logs/err" ] || fail "columns that are named are warned of"
succeeds "$scarp" simplify pnezd.csv turned.ply -e 0.5 --columns number,easting,northing,height -q
succeeds "$scarp" measure pnezd.csv turned.ply --fail-above 0.5 -q
refuses 1 "--columns: 'q' is no column" "$scarp" simplify pnezd.csv x.ply -e 1 --columns pqez
refuses 1 "--columns names the columns of a text" "$scarp" info flat.geojson --columns xyz
sed 's/,4000/,0/; s/,5000/,0/; s/,5001/,1/' pnezd.csv >local.csv
refuses 2 "is the easting: give --columns penz or --columns pnez" "$scarp" simplify local.csv x.ply -e 1
succeeds "$scarp" simplify local.csv local.ply -e 1 --columns pnez -q

# Zeros instead of heights.
succeeds "$scarp" info attribute.geojson
grep -q 'warning: .*third coordinate is 0 everywhere, so the heights are those of the attribute elevation' "$logs/err" ||
  fail "an attribute is taken without a word"
grep -q 'read as  *height: attribute elevation' "$logs/out" || fail "info does not tell where heights come from"
grep -q 'heights  *4[0-9.]* to' "$logs/out" || fail "the heights are not those of the attribute"
succeeds "$scarp" info two.geojson
grep -q 'warning: .*of the attribute height, not of elevation: --z-field names another' "$logs/err" || fail "two attributes"
succeeds "$scarp" info two.geojson --z-field elevation
[ ! -s "$logs/err" ] || fail "an attribute that is named is warned of"
succeeds "$scarp" simplify flat.geojson flat.ply -e 1 --report flat.json
grep -q 'warning: flat.geojson: all heights are 0: .*--z-field (site)' "$logs/err" || fail "a flat layer is not warned of"
python3 -c 'import json; assert json.load(open("flat.json"))["warnings"]' || fail "the report has no warning"
for pair in some:0 sentinel:-9999; do
  file=${pair%:*}.geojson value=${pair#*:}
  succeeds "$scarp" info "$file"
  grep -q "10 points have exactly the height $value, .*--nodata $value leaves them out" "$logs/err" || fail "$file"
  succeeds "$scarp" simplify "$file" "$file.ply" -e 1 --nodata "$value"
  [ ! -s "$logs/err" ] || fail "$file: points that are left out are warned of"
  grep -q 'points  *90 (10 without a height left out)' "$logs/out" || fail "$file: points are not counted"
  succeeds "$scarp" measure "$file" "$file.ply" --fail-above 1 -q
done
# A constant is not a height either; nor is a third coordinate of NaN.
"$python_program" - <<'PY'
import struct
def gpkg_like(name, z):
    rows = [(k % 10 + k * k % 7 / 10, k // 10 + k * k % 11 / 20, 400 + k) for k in range(60)]
    with open(name + ".csv", "w") as file:
        file.write("WKT,altitude\n")
        for x, y, land in rows:
            file.write('"POINT Z (%.2f %.2f %s)",%d\n' % (x, y, z, land))
gpkg_like("sentinels", "-9999")
gpkg_like("constant", "7")
try:
    from osgeo import ogr
    file = ogr.GetDriverByName("GPKG").CreateDataSource("nans.gpkg")
    layer = file.CreateLayer("nans", None, ogr.wkbPoint25D)
    layer.CreateField(ogr.FieldDefn("altitude", ogr.OFTReal))
    for k in range(60):
        feature, place = ogr.Feature(layer.GetLayerDefn()), ogr.Geometry(ogr.wkbPoint25D)
        place.AddPoint(k % 10 + k * k % 7 / 10, k // 10 + k * k % 11 / 20, float("nan"))
        feature.SetGeometry(place)
        feature["altitude"] = 400 + k
        layer.CreateFeature(feature)
except ImportError:
    pass
PY
if command -v ogr2ogr >/dev/null; then
  for pair in sentinels:-9999 constant:7 nans:nan; do
    name=${pair%:*}
    [ $name = nans ] && { [ -e nans.gpkg ] || continue; } ||
      ogr2ogr -q -f GPKG $name.gpkg $name.csv -a_srs EPSG:32611 -oo GEOM_POSSIBLE_NAMES=WKT -oo AUTODETECT_TYPE=YES 2>/dev/null
    succeeds "$scarp" info $name.gpkg
    grep -q "third coordinate is ${pair#*:} everywhere, so the heights are those of the attribute altitude" "$logs/err" || fail "$name: $(cat "$logs/err")"
    grep -q 'heights  *400 to 459' "$logs/out" || fail "$name: the heights are not those of the attribute"
  done
  # A file next to the text declares its CRS.
  { printf '# a log\n\n'; awk 'BEGIN { print "id,lat,lon,alt"; srand(1); for (k = 0; k < 99; ++k) printf "%d,%.7f,%.7f,%.1f\n", k, 48 + rand() / 99, 11 + rand() / 99, 400 + 90 * rand() }'; } >log.csv
  succeeds "$scarp" info log.csv
  command=$(sed -n 's/.*declare their CRS in a file next to it (\(.*\)) for a local frame.*/\1/p' "$logs/err")
  bash -ec "$command" || fail "the command fails: $command"
  succeeds "$scarp" simplify log.csv log.glb -e 5
  grep -q 'frame  *local metres east and north' "$logs/out" || fail "$command: $(cat "$logs/out")"
  # Polygons and lines in another CRS go to the local frame of degrees.
  printf '{"type":"Polygon","coordinates":[[[11.001,48.001],[11.009,48.001],[11.009,48.009],[11.001,48.009],[11.001,48.001]]]}' >site.geojson
  ogr2ogr -q -f GPKG site.gpkg site.geojson -t_srs EPSG:32632
  succeeds "$scarp" simplify log.csv site.glb -e 5 --boundary site.gpkg
  outside=$(awk -F, '$1 + 0 > 0 && !($3 > 11.001 && $3 < 11.009 && $2 > 48.001 && $2 < 48.009)' log.csv | wc -l)
  grep -q ", $outside points outside left out" "$logs/out" || fail "points in a boundary of another CRS, not $outside outside"
  succeeds "$scarp" measure log.csv site.glb --fail-above 5 -q
  printf 'not a CRS\n' >log.prj
  refuses 2 "log.prj: declares no CRS that is known here: write WKT into it, or a code such as EPSG:32633" \
    "$scarp" simplify log.csv no.glb -e 5
fi
echo "columns, grids and heights of points are understood or asked about"
