#!/usr/bin/env bash
# One unit of heights in a run: metres if the frame or the format is in metres, else the raster's own. The heights in
# the files are compared with those of the ground by foreign programs.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

cat > ground.py <<'PYTHON'
"""RASTER METRES CELL MESH ERROR [UNIT]: the mesh is as wide as the raster and as high, METRES and CELL being those of a unit of its
heights and of a cell, up to ERROR metres; a unit of the mesh is UNIT metres (1)."""
import json, struct, subprocess, sys
raster, metres, cell, mesh, error = sys.argv[1], *map(float, sys.argv[2:4]), sys.argv[4], float(sys.argv[5])
unit = float(sys.argv[6]) if len(sys.argv) > 6 else 1
info = json.loads(subprocess.check_output(["gdalinfo", "-json", "-mm", raster], stderr=subprocess.DEVNULL))
low, high = info["bands"][0]["computedMin"] * metres, info["bands"][0]["computedMax"] * metres
data = open(mesh, "rb").read()
if mesh.endswith(".glb"):
    gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
    box = [[], []]
    for primitive in gltf["meshes"][0]["primitives"]:
        position = gltf["accessors"][primitive["attributes"]["POSITION"]]
        box[0].append(position["min"]), box[1].append(position["max"])
    least, most = ([f(v[k] for v in side) for k in (0, 2, 1)] for f, side in ((min, box[0]), (max, box[1])))
else:
    points = [[float(w) for w in line.split()[-3:]] for line in data.decode().splitlines() if line.startswith(("v ", "ND "))]
    points = [[p[0], p[2], p[1]] for p in points] if mesh.endswith(".obj") else points
    least, most = [min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]
wide, deep = ((b - a) * unit for a, b in list(zip(least, most))[:2])
for got, count in ((wide, info["size"][0]), (deep, info["size"][1])):
    assert abs(got / (cell * (count - 1)) - 1) < 1e-4, (mesh, got, cell * (count - 1))
for got, want in ((least[2] * unit, low), (most[2] * unit, high)):
    assert abs(got - want) <= error * 1.000001, (mesh, got, want, error)
PYTHON

# made NAME SRS UNIT: a part of the bundled raster in that CRS, with cells 30 wide and UNIT for the band.
made() {
  succeeds gdal_translate -q -of VRT -srcwin 0 0 60 46 -a_srs "$2" -a_ullr 1500000 701380 1501800 700000 "$dem" "$1.vrt"
  [ -z "$3" ] || sed -i "s|<VRTRasterBand[^>]*>|&<UnitType>$3</UnitType>|" "$1.vrt"
}
foot=0.3048 survey=0.3048006096012192
made utm_ft EPSG:32616 ft
made utm EPSG:32616 ""
made utm_fathom EPSG:32616 fathoms
made plane_ft EPSG:2264 ft
made plane EPSG:2264 ""
made plane_m EPSG:2264 m
made plane_up EPSG:2264+6360 ""

# Raster, metres per unit of its heights and per cell; every format in metres, with bounds in metres and in feet.
while read -r name metres cell; do
  for goal in 6 20ft; do
    if [ $goal = 6 ]; then error=6 mesh=$name.obj; else error=6.0961 mesh=$name.glb; fi
    succeeds "$scarp" simplify "$name.vrt" "$mesh" -e $goal --report r.json --overwrite
    python3 ground.py "$name.vrt" "$metres" "$cell" "$mesh" "$error" || fail "$mesh: $goal"
    max_error=$(json r.json max_error)
    holds "$max_error <= $error && $(json r.json goal max_error) <= $error && $(json r.json goal max_error) > 5.99"
    succeeds "$scarp" measure "$name.vrt" "$mesh" --fail-above $error --json
    [ "$(json "$logs/out" max_error)" = "$max_error" ] || fail "$mesh: measure sees another error"
  done
  if [ "$metres" = 1 ]; then continue; fi
  [ "$(json r.json input unit)" = '"m"' ] || fail "$name: heights are not in metres"
  [ "$(json r.json warnings 0 | grep -c 'become metres')" = 1 ] || fail "$name: nothing in the report of the way to metres"
  succeeds "$scarp" simplify "$name.vrt" "$name.stl" -e 6
  [ "$(grep -c 'become metres' "$logs/err")" = 1 ] || fail "$name: nothing is told of the way to metres"
  grep -q 'in the file' "$logs/out" || fail "$name: the summary has no unit of the file"
  # Formats without metadata, and other frames in metres.
  succeeds "$scarp" measure "$name.vrt" "$name.stl" --fail-above 6
  [[ $name = utm_* ]] || [ $name = plane_up ] || continue
  succeeds "$scarp" simplify "$name.vrt" "$name.glb" -e 6 --crs enu -q --overwrite
  succeeds "$scarp" measure "$name.vrt" "$name.glb" --fail-above 6
done <<LIST
utm 1 30
utm_ft $foot 30
utm_fathom 1.8288 30
plane $survey 9.144018288036576
plane_ft $foot 9.144018288036576
plane_m 1 9.144018288036576
plane_up $survey 9.144018288036576
LIST

# An assumption is reported with its remedy, which changes the heights accordingly.
succeeds "$scarp" simplify plane.vrt plane.glb -e 6 --overwrite
grep -q 'taken for US survey foot, as x and y are.*--z-unit m' "$logs/err" || fail "nothing is told of an assumption"
succeeds "$scarp" simplify plane.vrt plane.glb -e 6 --z-unit m --overwrite
[ ! -s "$logs/err" ] || fail "a unit that was named is warned of: $(cat "$logs/err")"
python3 ground.py plane.vrt 1 9.144018288036576 plane.glb 6
succeeds "$scarp" measure plane.vrt plane.glb --fail-above 6
succeeds "$scarp" simplify utm.vrt utm.glb -e 6 --z-unit us-ft --overwrite
python3 ground.py utm.vrt $survey 30 utm.glb 6
succeeds "$scarp" simplify utm.vrt utm.glb -e 20ft --overwrite
grep -q "taken for metres: --max-error 20ft is 6.096 of them; --z-unit" "$logs/err" || fail "no word of a goal in feet"

# Files in the raster's own CRS keep its unit, as do goals.
for name in utm_ft plane_ft; do
  succeeds "$scarp" simplify $name.vrt $name.2dm -e 20ft --report r.json --overwrite
  holds "$(json r.json goal max_error) == 20"
  python3 - $name.2dm <<'PYTHON' || fail "$name.2dm is in another unit"
import sys
z = [float(line.split()[4]) for line in open(sys.argv[1]) if line.startswith("ND ")]
assert max(z) > 700 and min(z) > 200, (min(z), max(z))
PYTHON
  succeeds "$scarp" measure $name.vrt $name.2dm --fail-above 20ft
  succeeds "$scarp" simplify $name.vrt $name.2dm -e 6.096m --report r.json --overwrite
  holds "$(json r.json goal max_error) > 19.999 && $(json r.json goal max_error) < 20.001"
  succeeds "$scarp" simplify $name.vrt $name.tin -e 20 --crs source -q --overwrite
  succeeds "$scarp" measure $name.vrt $name.tin --fail-above 20
done
succeeds "$scarp" simplify utm_ft.vrt same.tif -e 20ft --overwrite
gdalinfo same.tif | grep -q 'Unit Type: ft' || fail "a raster loses its unit"
# The suggestion of info gives that error in every format.
goal=$("$scarp" info utm_ft.vrt 2> /dev/null | sed -n 's/.*-e \([0-9.]*ft\)$/\1/p' | head -1)
[ -n "$goal" ] || fail "info suggests no error in feet"
succeeds "$scarp" simplify utm_ft.vrt utm_ft.glb -e "$goal" --overwrite
succeeds "$scarp" measure utm_ft.vrt utm_ft.glb --fail-above "$goal"

# Tolerances in their own unit.
succeeds gdal_translate -q -of VRT -ot Float32 -scale 0 2000 20 20 utm.vrt few.vrt
sed -i 's|<VRTRasterBand[^>]*>|&<UnitType>ft</UnitType>|' few.vrt
succeeds "$scarp" simplify utm.vrt few.glb --tolerance few.vrt --report r.json --overwrite
holds "$(json r.json max_error) <= 6.0961 && $(json r.json max_error) > 4"

# A unit that is not a length, and a CRS that a format in metres cannot hold.
made utm_K EPSG:32616 K
refuses 1 "heights are in 'K', which is no unit of length" "$scarp" simplify utm_K.vrt no.glb -e 6
grep -q -- '--z-unit m.*--z-scale F' "$logs/err" || fail "no way out of a unit that is no length"
succeeds "$scarp" simplify utm_K.vrt kelvin.glb -e 6 --z-unit m
succeeds "$scarp" simplify utm_K.vrt kelvin.2dm -e 6
refuses 1 "--max-error is in m, and the heights are in 'K'" "$scarp" simplify utm_K.vrt no.2dm -e 6m
refuses 1 "GLB is in metres by its specification" "$scarp" simplify plane.vrt no.glb -e 6 --crs source
refuses 1 "GLB is in metres by its specification" "$scarp" simplify utm.vrt no.glb -e 6 --crs EPSG:2264
refuses 1 "cannot be combined with --z-unit" "$scarp" simplify utm.vrt no.glb -e 6 --image --z-unit ft

# Depths: only the remedy converts a vertical CRS that counts downwards to heights.
for crs in EPSG:32616+5715 EPSG:32616+5831; do
  gdal_translate -q -a_srs $crs utm.vrt depths.tif
  succeeds "$scarp" simplify depths.tif depths.obj -e 6 --overwrite --report r.json
  grep -q 'depths.tif: its vertical CRS, .* depth.*, counts downwards: .*upside down.* --z-scale, such as -1' "$logs/err" ||
    fail "depths in $crs are heights in silence"
  json r.json input depths | grep -q 'counts downwards' || fail "no depths in the report"
  succeeds "$scarp" simplify depths.tif turned.obj -e 6 --overwrite --z-scale -1
  [ ! -s "$logs/err" ] || fail "depths that are turned are warned of"
  holds "$(awk '$1 == "v" { print $3 }' turned.obj | sort -g | tail -1) < 0"
done
gdal_translate -q -a_srs EPSG:32616+5715 -scale 0 1 0 -1 -ot Float32 utm.vrt below.tif
succeeds "$scarp" info below.tif --no-suggest
grep -q 'below.tif: its vertical CRS, .*, counts downwards, but no value is above 0' "$logs/err" || fail "heights below the sea are depths"

# Tiles.
for name in plane plane_up utm_ft; do
  succeeds "$scarp" tile $name.vrt $name --vertical none --effort fast -e 100 --zoom 10 --report r.json --overwrite
  [ "$(grep -c 'become metres' "$logs/err")" = 1 ] && ! grep -q 'z is in' "$logs/err" || fail "$name: tiles tell nothing of the way to metres"
  succeeds "$scarp" tile check $name --source $name.vrt -q
done
succeeds "$scarp" tile utm_ft.vrt by_hand --vertical none --effort fast -e 100 --zoom 10 --z-scale 0.3048 -q
differs=$(diff -rq utm_ft by_hand | grep terrain || true)
[ -z "$differs" ] || fail "tiles of feet are others by hand"

# Points.
printf 'x,y,z\n' > points.csv
python3 -c 'import random; random.seed(3); [print(f"{1500000 + random.random() * 3000:.2f},{700000 + random.random() * 3000:.2f},{900 + random.random() * 100:.2f}") for _ in range(200)]' >> points.csv
printf '<OGRVRTDataSource><OGRVRTLayer name="points"><SrcDataSource relativeToVRT="1">points.csv</SrcDataSource><GeometryType>wkbPoint25D</GeometryType><LayerSRS>EPSG:2264</LayerSRS><GeometryField encoding="PointFromColumns" x="x" y="y" z="z"/></OGRVRTLayer></OGRVRTDataSource>' > points.vrt
succeeds "$scarp" simplify points.vrt points.glb --points -e 3
grep -q 'taken for US survey foot.*become metres' "$logs/err" || fail "nothing is told of points in feet"
python3 - <<'PYTHON'
import json, struct
data = open("points.glb", "rb").read()
gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
position = gltf["accessors"][gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
low, high = position["min"], position["max"]
assert 880 < high[0] - low[0] < 915 and 270 < low[1] < high[1] < 306, (low, high)
PYTHON
succeeds "$scarp" measure points.vrt points.glb --points --fail-above 3
succeeds "$scarp" measure points.vrt points.glb --points --fail-above 9.85ft

# Their unit comes from the vertical CRS, the name of a column or attribute, or --z-unit. LOW HIGH: the land in metres.
land() {
  succeeds "$scarp" simplify "${@:4}" "$1" -e 0.5m --report r.json --overwrite
  python3 - "$1" "$2" "$3" <<'PYTHON' || fail "${*:4} $1: heights, or what is as wide as it should not be"
import json, struct, sys
data = open(sys.argv[1], "rb").read()
if sys.argv[1].endswith(".glb"):
    gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
    position = gltf["accessors"][gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    low, high = position["min"], position["max"]
else:
    rows = [[float(w) for w in line.split()[1:4]] for line in data.decode().splitlines() if line.startswith("v ")]
    low, high = ([f(row[k] for row in rows) for k in range(3)] for f in (min, max))
assert 800 < high[0] - low[0] < 1100 and 800 < high[2] - low[2] < 1100, (low, high)
assert float(sys.argv[2]) - 0.6 < low[1] < high[1] < float(sys.argv[3]) + 0.6, (low, high)
PYTHON
  succeeds "$scarp" measure "${@:4}" "$1" --fail-above 0.5m
}
if command -v ogr2ogr >/dev/null; then
  python3 - <<'PYTHON'
import random
random.seed(4)
rows = [(random.random() * 1000, random.random() * 1000, 660 + 60 * random.random()) for _ in range(200)]
def write(name, head, scale, unit, x0, y0, stretch=1):
    with open(name, "w") as file:
        file.write(head + "\n")
        for k, (x, y, z) in enumerate(rows):
            file.write(f"{k},{x0 + x / scale:.7f},{y0 + y / scale * stretch:.7f},{z / unit:.5f}\n")
ft, us = 0.3048, 1200 / 3937
write("utm.csv", "no,x,y,z", 1, us, 500000, 4000000)
write("degrees.csv", "no,x,y,z", 91000, us, -123, 35, 0.82)
write("plane.csv", "no,x,y,z", us, 1, 6500000, 1800000)
write("elev.csv", "no,x,y,ELEV_FT", 1, ft, 500000, 4000000)
write("mm.csv", "no,Easting (m),Northing (m),Elevation (mm)", 1, 0.001, 500000, 4000000)
write("feet.csv", "no,Easting (ft),Northing (ft),Elevation (ft)", ft, ft, 500000, 4000000)
write("none.csv", "no,x,y,z", 1, ft, 500000, 4000000)
PYTHON
  gpkg() {
    ogr2ogr -q "$1.gpkg" "$1.csv" -a_srs "$2" -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y ${3:+-oo Z_POSSIBLE_NAMES=$3} -oo AUTODETECT_TYPE=YES
  }
  gpkg utm EPSG:26910+6360 z && gpkg degrees EPSG:4326+6360 z && gpkg plane EPSG:2229+5703 z && gpkg elev EPSG:26910 ""
  for mesh in heights.glb heights.obj; do
    for name in utm degrees plane elev; do land $mesh 660 720 $name.gpkg; done
    for name in mm feet; do land $mesh 660 720 $name.csv; done
  done
  land heights.glb 660 720 none.csv --z-unit ft
  # The command that assigns a CRS to a text preserves the unit.
  succeeds "$scarp" info elev.csv
  refuses 1 "does not declare its CRS" "$scarp" simplify elev.csv no.glb -e 1 --crs EPSG:26911
  command=$(sed -n 's/.*in a file next to it (\(.*\))$/\1/p' "$logs/err" | sed 's/EPSG:CODE/EPSG:26910/')
  bash -ec "$command" || fail "the command fails: $command"
  land heights.glb 660 720 elev.csv
  succeeds "$scarp" simplify plane.gpkg plane.glb -e 0.5 --overwrite
  [ ! -s "$logs/err" ] || fail "heights that the CRS says to be metres are warned of: $(cat "$logs/err")"
  succeeds "$scarp" simplify utm.gpkg utm.glb -e 0.5 --report r.json --overwrite
  grep -q 'heights in US survey foot become metres' "$logs/err" || fail "nothing is told of the vertical CRS"
  [ "$(json r.json input unit)" = '"m"' ] || fail "the report does not tell the unit of points"
  succeeds "$scarp" simplify utm.gpkg utm.2dm -e 2ft --overwrite
  succeeds "$scarp" measure utm.gpkg utm.2dm --fail-above 2ft
  refuses 1 "--z-scale" "$scarp" simplify plane.gpkg no.xml -e 1
  factor=$(sed -n 's/.*scale them by \([0-9.]*\) (--z-scale).*/\1/p' "$logs/err")
  succeeds "$scarp" simplify plane.gpkg levels.xml -e 1 --z-scale "$factor"
  succeeds "$scarp" measure plane.gpkg levels.xml --fail-above 1
  succeeds "$scarp" simplify none.csv none.glb -e 2
  refuses 1 "no unit of length" "$scarp" simplify none.csv no.glb -e 2 --z-unit K

  # Breaklines in feet on a raster in metres.
  succeeds gdal_translate -q -of GTiff -srcwin 0 0 60 46 -a_srs EPSG:32616 -a_ullr 1500000 701380 1501800 700000 "$dem" metres.tif
  sample=$(gdallocationinfo -valonly -geoloc metres.tif 1500915 700705)
  python3 - "$sample" $survey <<'PYTHON'
import sys
z = float(sys.argv[1]) / float(sys.argv[2])
open("line.csv", "w").write(f"ELEV_USFT,WKT\n{z},\"LINESTRING Z (1500905 700705 {z},1500925 700705 {z})\"\n")
PYTHON
  ogr2ogr -q lines.gpkg line.csv -a_srs EPSG:32616+6360 -nlt LINESTRINGZ -oo GEOM_POSSIBLE_NAMES=WKT -oo AUTODETECT_TYPE=YES
  for field in "" ELEV_USFT; do
    succeeds "$scarp" simplify metres.tif lines.glb -e 5 --breaklines lines.gpkg ${field:+--breakline-z $field} --report r.json --overwrite
    holds "$(json r.json breaklines farthest) < 60"
    grep -q 'are multiplied by 0.3048006096, for the unit of the raster' "$logs/err" || fail "lines in feet: nothing is told"
  done
fi

# LandXML has one unit for everything: its remedy works.
refuses 1 "--z-scale" "$scarp" simplify utm_ft.vrt no.xml -e 20ft
factor=$(sed -n 's/.*scale them by \([0-9.]*\) (--z-scale).*/\1/p' "$logs/err")
succeeds "$scarp" simplify utm_ft.vrt site.xml -e 20ft --z-scale "$factor"
succeeds "$scarp" measure utm_ft.vrt site.xml --fail-above 6.0961
succeeds "$scarp" simplify plane_m.vrt plane.2dm -e 20
factor=$(sed -n 's/.*--z-scale \([0-9.]*\) makes them one unit.*/\1/p' "$logs/err")
succeeds "$scarp" simplify plane_m.vrt plane.2dm -e 20 --z-scale "$factor" --overwrite
[ ! -s "$logs/err" ] || fail "units that were made one are warned of"
echo "heights have one unit in a run"
