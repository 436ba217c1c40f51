#!/usr/bin/env bash
# Every view of a raster preserves its metadata; incompatible rasters are refused, and the remedy works.
source "$(dirname "$0")/lib.sh"
need gdal_translate gdalwarp gdalbuildvrt python3
gdal_edit() { /usr/bin/python3 "$(command -v gdal_edit.py)" "$@"; }
gdal_edit --help > "$logs/out" 2>&1 || grep -q Usage "$logs/out" || skip "needs gdal_edit.py"
heights() { gdal_translate -q -of XYZ "$1" /vsistdout/ | awk '{ print $3 }'; }
same_mesh() { cmp <(grep -av '^comment' "$1") <(grep -av '^comment' "$2"); }
# Runs the command in the last message.
way_out() {
  local command
  command=$(sed -n 's/.*(\(gdal[^()]*\)).*/\1/p' "$logs/err" | sed 's/gdal_edit\.py/gdal_edit/g; s/gdal_translate /gdal_translate -q /g; s/gdalwarp /gdalwarp -q /g')
  [ -n "$command" ] || fail "no way out is named"
  eval "$command" && { [ ! -e NEW.tif ] || mv NEW.tif new.tif; } || fail "the way out is no command: $command"
}

gdal_translate -q -a_srs EPSG:26917 -a_ullr 500000 4010320 512090 4000000 "$dem" utm.tif
gdal_edit -units ft utm.tif
gdal_translate -q -srcwin 0 0 203 344 utm.tif a.tif
gdal_translate -q -srcwin 203 0 200 344 utm.tif b.tif
gdal_edit -units ft a.tif  # gdal_translate loses it
gdal_edit -units ft b.tif

# Unit and datum: the raster, a mosaic, a part, means, a stream, a plan of tiles.
for view in "utm.tif o.ply" "a.tif b.tif o.ply" "utm.tif o.ply --te 500300 4008160 503330 4009720" \
  "utm.tif o.ply --resolution 100" "a.tif b.tif o.ply --resolution 100 --te 500300 4000000 509000 4009720"; do
  succeeds "$scarp" simplify -e 50 --report r.json --overwrite --effort fast $view
  [ "$(json r.json input file_unit)" = '"ft"' ] || fail "the unit of $view is $(json r.json input file_unit)"
done

# Different units, and an undeclared unit: the remedy gives the same heights.
cp b.tif us.tif && gdal_edit -units "US survey foot" us.tif
refuses 2 "us.tif has heights in US survey foot, and a.tif in ft: bring it to one unit first" "$scarp" info a.tif us.tif
way_out
succeeds "$scarp" simplify a.tif new.tif o.ply -e 50 --overwrite --report r.json
[ "$(json r.json input file_unit)" = '"ft"' ] || fail "no unit after the way out"
gdal_translate -q -srcwin 0 0 199 344 b.tif none.tif
refuses 2 "none.tif has no unit, and a.tif heights in ft: if none.tif has the same unit, declare it first" \
  "$scarp" info a.tif none.tif
way_out
succeeds "$scarp" info a.tif new.tif --no-suggest
gdal_edit -units metre b.tif
gdal_edit -units m a.tif
succeeds "$scarp" info a.tif b.tif --no-suggest
gdal_edit -units ft b.tif
refuses 2 "b.tif has heights in ft, and a.tif in m" "$scarp" simplify a.tif b.tif o.ply -e 50 --overwrite
way_out
succeeds "$scarp" simplify a.tif new.tif o.tif -e 0.001 --overwrite
python3 - <(heights b.tif) <(heights new.tif) <<'PY' || fail "the way out is not the same land"
import sys
a, b = (list(map(float, open(name))) for name in sys.argv[1:])
assert a == b and a  # stored values; the scale converts them to metres
PY
gdalinfo new.tif | grep -q 'Scale:0.3048' || fail "no scale makes metres of feet"
gdal_edit -units m b.tif

# Different vertical datums.
gdal_translate -q -a_srs EPSG:26917+5703 a.tif navd.tif
gdal_translate -q -a_srs EPSG:26917+5773 b.tif egm.tif
refuses 2 "egm.tif has heights above EGM96 height, and navd.tif heights above NAVD88 height: " "$scarp" info navd.tif egm.tif
grep -q 'first (gdalwarp -t_srs EPSG:26917+5703\|PROJ knows no way between their heights' "$logs/err" || fail "$(cat "$logs/err")"
gdal_translate -q -a_srs EPSG:26917 b.tif flat.tif
refuses 2 "flat.tif has no vertical datum, and navd.tif heights above NAVD88 height: if flat.tif has the same" "$scarp" info navd.tif flat.tif
way_out
succeeds "$scarp" info navd.tif new.tif --no-suggest

# Nodata: only each raster's own value is a hole.
gdal_translate -q -a_nodata 300 a.tif a300.tif
gdal_translate -q -a_nodata 400 b.tif b400.tif
succeeds "$scarp" simplify a300.tif b400.tif o.tif -e 0 --overwrite --report r.json
holes=$(($(heights a.tif | grep -cx 300) + $(heights b.tif | grep -cx 400)))
[ "$(json r.json input void)" = "$holes" ] || fail "$(json r.json input void) holes instead of $holes"
# A value outside the type's range has no effect; outside all rasters there is no land at 0.
gdal_translate -q -ot Byte -scale 236 1076 1 200 -srcwin 0 0 100 100 utm.tif c.tif
gdal_translate -q -ot Byte -scale 236 1076 1 200 -srcwin 100 100 100 100 utm.tif d.tif
gdal_edit -a_nodata -9999 c.tif
gdal_edit -a_nodata -9999 d.tif
succeeds "$scarp" simplify c.tif d.tif o.tif -e 0 --overwrite --report r.json
[ "$(json r.json input void)" = 20000 ] || fail "the gap is not missing"
holds "$(json r.json input min) >= 1"
# --nodata replaces the declared value; the gap remains.
gdal_translate -q -a_nodata -9999 -srcwin 0 0 100 100 utm.tif c.tif
gdal_translate -q -a_nodata -9999 -srcwin 100 100 100 100 utm.tif d.tif
succeeds "$scarp" simplify c.tif d.tif o.tif -e 0 --nodata -1 --overwrite --report r.json
holds "$(json r.json input min) >= 236"
# A mean may equal the nodata value.
printf 'ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value 0\n-1 1 5 5\n1 -1 5 5\n7 7 9 0\n7 7 9 9\n' > zero.asc
succeeds "$scarp" simplify zero.asc zero.tif -e 0.001 --resolution 2
[ "$(heights zero.tif | tr '\n' ' ')" = "0 5 7 9 " ] || fail "means: $(heights zero.tif | tr '\n' ' ')"
# Masks apply to means, and to mosaics with rasters without masks.
gdal_translate -q -a_nodata 300 a.tif with_nodata.tif
gdal_translate -q --config GDAL_TIFF_INTERNAL_MASK YES -mask mask,1 -a_nodata none with_nodata.tif masked.tif
for view in "--te 500300 4008160 503330 4009720" "--resolution 60"; do
  succeeds "$scarp" simplify masked.tif o.tif -e 0.01 $view --overwrite --report r.json
  succeeds "$scarp" simplify with_nodata.tif o2.tif -e 0.01 $view --overwrite --report r2.json
  [ "$(json r.json input void)" = "$(json r2.json input void)" ] || fail "the mask is not heeded in $view"
  [ "$(heights o.tif)" = "$(heights o2.tif)" ] || fail "the mask spoils heights in $view"
done
succeeds "$scarp" simplify masked.tif b.tif o.tif -e 0 --overwrite --report r.json
[ "$(json r.json input void)" = "$(heights a.tif | grep -cx 300)" ] || fail "the mask is not heeded in a mosaic"

# Rasters whose first row is the southern one.
python3 - <<'PY'
def sheet(name, first, count):
    open(name + ".raw", "wb").write(bytes((col * 3 + row * row) % 200 for row in range(30) for col in range(first, first + count)))
    open(name, "w").write(f'''<VRTDataset rasterXSize="{count}" rasterYSize="30"><SRS dataAxisToSRSAxisMapping="1,2">EPSG:32617</SRS>
<GeoTransform>{500000 + 10 * first},10,0,4000000,0,10</GeoTransform><VRTRasterBand dataType="Byte" band="1"
subClass="VRTRawRasterBand"><SourceFilename relativeToVRT="1">{name}.raw</SourceFilename><PixelOffset>1</PixelOffset>
<LineOffset>{count}</LineOffset></VRTRasterBand></VRTDataset>''')
sheet("up.vrt", 0, 50), sheet("up_a.vrt", 0, 20), sheet("up_b.vrt", 20, 30)
PY
succeeds "$scarp" simplify up.vrt up.ply -e 2 --crs source
succeeds "$scarp" simplify up_a.vrt up_b.vrt ups.ply -e 2 --crs source
same_mesh up.ply ups.ply || fail "two south-up rasters are not one"
succeeds "$scarp" simplify up_b.vrt up_a.vrt up.tif -e 0 --resolution 20
gdalwarp -q up_b.vrt north_b.tif
refuses 2 "north_b.tif and up_a.vrt begin at different sides: make up_a.vrt north up first" "$scarp" info up_a.vrt north_b.tif
way_out
succeeds "$scarp" simplify new.tif north_b.tif north.ply -e 2 --crs source
[ "$(grep -ac . north.ply)" -gt 0 ]

# Both sides of the 180th meridian, as two rasters, a folder, one virtual raster, and in 0 to 360 degrees.
gdal_translate -q -a_srs EPSG:4326 -a_ullr 179.899 10.344 180.302 10 "$dem" date.tif
succeeds "$scarp" simplify date.tif date.ply -e 40
mkdir sides
gdal_translate -q -srcwin 0 0 101 344 date.tif sides/east.tif
gdal_translate -q -srcwin 101 0 302 344 -a_ullr -180 10.344 -179.698 10 date.tif sides/west.tif
gdal_translate -q -srcwin 101 0 302 344 date.tif over.tif
gdalbuildvrt -q all.vrt sides/east.tif sides/west.tif
for view in "sides/east.tif sides/west.tif" "sides/west.tif sides/east.tif" sides all.vrt "over.tif sides/east.tif"; do
  succeeds "$scarp" simplify $view sides.ply -e 40 --overwrite --report r.json
  same_mesh date.ply sides.ply || fail "$view is not the raster"
done
succeeds "$scarp" simplify sides sides.glb -e 40 --crs EPSG:32660
grep -q 'read as *mosaic of 2 rasters, both ends of x side by side' "$logs/out" || fail "the summary does not tell"

# Two zones: the wedges next to a warped raster are holes, not land at 0.
gdal_translate -q -a_srs EPSG:26916 a.tif zone.tif
refuses 2 "zone.tif is in EPSG:26916, and a.tif in EPSG:26917: bring it there first" "$scarp" info a.tif zone.tif
way_out
succeeds "$scarp" info new.tif --no-suggest
[ "$(gdalinfo -stats new.tif | sed -n 's/.*STATISTICS_MINIMUM=//p' | cut -d. -f1)" -ge 200 ] || fail "wedges at 0"

# A raster OUTPUT has the input raster's frame.
succeeds "$scarp" simplify "$dem" out.tif -e 50 --report r.json --overwrite
grep -q '^  frame *coordinates in EPSG:4326 (degree)' "$logs/out" || fail "the summary names another frame"
[ "$(json r.json frame crs)" = '"EPSG:4326"' ] || fail "the report names another frame"
[ "$(json r.json frame to_source)" = "[0.0, 1.0, 0.0, 0.0, 0.0, 1.0]" ] || fail "the way to the source is $(json r.json frame to_source)"
succeeds "$scarp" simplify "$dem" out.pgm -e 50
grep -q '^  frame *grid coordinates' "$logs/out" || fail "a PGM knows no place"
succeeds "$scarp" simplify navd.tif out.tif -e 50 --overwrite
gdalinfo out.tif | grep -q 'NAVD88' || fail "the datum of heights is lost"
# A CRS in degrees for metres, and one in metres for degrees: the remedy names the right one.
gdal_translate -q -a_srs EPSG:4326 utm.tif metres.tif
for command in "info metres.tif" "simplify metres.tif o.glb -e 50 --overwrite" "simplify metres.tif o.obj -e 50 --crs source" \
  "tile metres.tif o --vertical egm96"; do
  refuses 2 "metres.tif: its CRS, EPSG:4326, has the unit degree, but its middle lies at 506045, 4005145, which is no place" \
    "$scarp" $command
done
printf 'x,y,z\n500000,5400000,1\n500100,5400000,2\n500000,5400100,3\n500100,5400120,5\n' > points.csv
ogr2ogr -q points.geojson points.csv -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z
refuses 2 "is no place there: that is the wrong CRS; name the one that x and y are in first (ogr2ogr -a_srs EPSG:CODE NEW.gpkg points.geojson)" \
  "$scarp" simplify points.geojson o.glb --points -e 1
refuses 2 "metres.tif: its CRS" "$scarp" info metres.tif
sed -i 's/EPSG:CODE/EPSG:26917/' "$logs/err"
way_out
succeeds "$scarp" simplify new.tif o.glb -e 50 --overwrite
gdal_translate -q -a_srs EPSG:32616 "$dem" degrees.tif
for command in "info degrees.tif --no-suggest" "simplify degrees.tif o.glb -e 50 --overwrite"; do
  succeeds "$scarp" $command
  grep -q "warning: its x and y look like degrees, but its CRS, EPSG:32616, has the unit metre" "$logs/err" || fail "degrees are metres"
done
way_out
succeeds "$scarp" simplify new.tif new.ply -e 50 --overwrite
succeeds "$scarp" simplify "$dem" dem.ply -e 50 --overwrite
same_mesh new.ply dem.ply || fail "another mesh after the way out"
echo "views keep what rasters say"
