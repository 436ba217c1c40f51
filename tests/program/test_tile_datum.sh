#!/usr/bin/env bash
# scarp tile: the datum of heights and its ellipsoid.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdal_create gdalwarp
reader=$SCARP_SOURCE/tests/program/tiles.py
moon=${SCARP_SHARED:-$SCARP_SOURCE/../shared}/data/moon_gld100_caucasus_4096.tif
mars=${SCARP_SHARED:-$SCARP_SOURCE/../shared}/data/mars_gale_hirise_1m.tif

# highest FOLDER: of all vertices.
highest() { python3 "$reader" "$1" | cut -d' ' -f4; }

# near A B MOST: true if they differ by less than MOST.
near() { holds "($1) - ($2) < $3 && ($2) - ($1) < $3"; }

# The program includes the geoid: without PROJ's grid the tiles are the same.
mkdir bare_proj
cp "$(find /usr/share/proj /usr/local/share/proj -name proj.db 2> /dev/null | head -1)" bare_proj/ || skip "needs the database of PROJ"
succeeds "$scarp" tile "$dem" sea --vertical egm96 --zoom 8 -q
succeeds env PROJ_DATA="$PWD/bare_proj" PROJ_LIB="$PWD/bare_proj" "$scarp" tile "$dem" bare --vertical EPSG:5773 --zoom 8 -q
diff -r sea bare || fail "the built-in geoid depends on PROJ's files"
[ "$(json sea/layer.json scarp heights_above)" = '"EGM96 height"' ] || fail "layer.json does not tell the datum"
near "$(json sea/layer.json scarp ellipsoid 1)" 6356752.3142 1e-3

# A surface from a file: a constant, PROJ's own grid, one in a projection.
succeeds "$scarp" tile "$dem" flat --vertical ellipsoid --zoom 8 -q
succeeds gdal_create -of GTiff -ot Float32 -a_srs EPSG:4326 -a_ullr -86 38 -83 35 -outsize 30 30 -burn 40 forty.tif
succeeds "$scarp" tile "$dem" raised --geoid forty.tif --zoom 8 --report r.json -q
near "$(highest raised)" "$(highest flat) + 40" 0.5
[ "$(json r.json vertical)" = '"the surface in forty.tif"' ] || fail "the report does not tell the surface"
[ "$(json raised/layer.json scarp heights_above)" = '"the surface in forty.tif"' ] || fail "nor does layer.json"
if [ -e /usr/share/proj/egm96_15.gtx ]; then
  succeeds "$scarp" tile "$dem" grid --geoid /usr/share/proj/egm96_15.gtx --zoom 8 -q
  near "$(highest grid)" "$(highest sea)" 0.5
  # PROJ finds a grid of EGM2008 if present: here EGM96's under its name.
  cp /usr/share/proj/egm96_15.gtx bare_proj/egm08_25.gtx
  succeeds env PROJ_DATA="$PWD/bare_proj" PROJ_LIB="$PWD/bare_proj" "$scarp" tile "$dem" proj --vertical egm2008 --zoom 8 -q
  near "$(highest proj)" "$(highest sea)" 0.5
  [ "$(json proj/layer.json scarp heights_above)" = '"EGM2008 height"' ] || fail "EGM2008 is called otherwise"
  rm bare_proj/*egm08*
fi
succeeds gdalwarp -q -t_srs EPSG:32616 forty.tif forty_utm.tif
succeeds "$scarp" tile "$dem" warped --geoid forty_utm.tif --zoom 8 -q
diff -r raised/8 warped/8 || fail "a surface in UTM is another one"

# An unknown zero: heights are used unchanged.
succeeds "$scarp" tile "$dem" none --vertical none --zoom 8 -q
diff -r flat/8 none/8 || fail "--vertical none changes heights"
grep -q "nobody names" none/layer.json || fail "layer.json does not tell that nobody knows the datum"

# Impossible requests name the remedy.
refuses 1 "--geoid FILE" "$scarp" tile "$dem" no
refuses 1 "--geoid FILE" env PROJ_DATA="$PWD/bare_proj" PROJ_LIB="$PWD/bare_proj" "$scarp" tile "$dem" no --vertical egm2008
refuses 1 "no vertical CRS" "$scarp" tile "$dem" no --vertical EPSG:4326
refuses 1 "number of a vertical CRS" "$scarp" tile "$dem" no --vertical EPSG:x
refuses 1 "egm2008" "$scarp" tile "$dem" no --vertical sea
refuses 1 "without --vertical" "$scarp" tile "$dem" no --vertical egm96 --geoid forty.tif
refuses 1 "no geoid of the earth" "$scarp" tile "$dem" no --geoid "$dem"
refuses 2 "missing.gtx" "$scarp" tile "$dem" no --geoid missing.gtx
succeeds gdal_create -of GTiff -ot Float32 -a_srs EPSG:4326 -a_ullr 0 38 3 35 -outsize 30 30 -burn 40 elsewhere.tif
refuses 2 "nothing is known of the zero" "$scarp" tile "$dem" no --geoid elsewhere.tif
[ ! -e no ] || fail "something is left of a set that was refused"

# A plan stores the surface and notices its changes.
succeeds "$scarp" tile plan "$dem" plan.json --geoid forty.tif --zoom 8 -q
succeeds "$scarp" tile run plan.json -q
succeeds "$scarp" tile finish plan.json planned -q
diff -r raised planned || fail "a plan makes other tiles"
touch forty.tif
refuses 2 "forty.tif has changed" "$scarp" tile run plan.json --parts others
rm forty.tif
refuses 2 "forty.tif is not there any more" "$scarp" tile run plan.json --parts others

# Other planets: their own ellipsoid, on which the geometric errors are smaller.
succeeds gdal_translate -q -a_srs "+proj=longlat +R=1737400 +no_defs" "$dem" moonlike.tif
refuses 1 "--vertical ellipsoid" "$scarp" tile moonlike.tif no
! grep -q egm96 "$logs/err" || fail "the sea of the earth is offered on the moon"
refuses 1 "not the earth's" "$scarp" tile moonlike.tif no --vertical egm96
refuses 1 "of another globe" "$scarp" tile moonlike.tif no --geoid elsewhere.tif
refuses 1 "no ellipsoid of a planet" "$scarp" tile "$dem" no --ellipsoid 1737.4,1737.4
refuses 1 "no ellipsoid of a planet" "$scarp" tile "$dem" no --ellipsoid 1,2
succeeds "$scarp" tile moonlike.tif moonlike --vertical ellipsoid --zoom 8 -q
succeeds "$scarp" tile "$dem" given --vertical ellipsoid --ellipsoid 1737400,1737400 --zoom 8 -q
diff -r moonlike/8 given/8 || fail "a given ellipsoid is another one than the CRS's"
holds "$(json moonlike/layer.json scarp ellipsoid 1) == 1737400"
near "$(json moonlike/layer.json scarp levels 0 geometric_error)" "$(json flat/layer.json scarp levels 0 geometric_error) * 1737400 / 6378137" 1e-6
succeeds "$scarp" tile moonlike.tif moon3d --of 3dtiles --vertical ellipsoid --zoom 8 -q
[ "$(json moon3d/tileset.json extensions 3DTILES_ellipsoid radii 2)" = 1737400.0 ] || fail "tileset.json tells no ellipsoid"
succeeds "$scarp" tile "$dem" mars --vertical ellipsoid --ellipsoid 3396190,3376200 --zoom 8 --report mars.json -q
near "$(json mars.json ellipsoid 1)" 3376200 1e-6
python3 "$reader" mars > /dev/null || fail "an ellipsoid of one's own"

# Heights of Mars, 30 km from the lowest to the highest.
succeeds gdal_translate -q -ot Float32 -scale 236 1076 -8500 21200 -a_srs "+proj=longlat +a=3396190 +b=3376200 +no_defs" "$dem" olympus.tif
succeeds "$scarp" tile olympus.tif olympus --vertical ellipsoid --zoom 8 -q
near "$(highest olympus)" 21200 2000

if [ -e "$moon" ]; then
  succeeds gdal_translate -q -srcwin 1800 1700 100 80 "$moon" window.tif
  succeeds "$scarp" tile window.tif caucasus --vertical ellipsoid --report moon.json -q
  python3 "$reader" caucasus > /dev/null || fail "the moon's tiles do not fit"
  [ "$(json caucasus/layer.json maxzoom)" = 9 ] || fail "256 samples a degree are level 9"
  holds "$(json caucasus/layer.json scarp ellipsoid 0) == 1737400"
  for z in 9 8 7 6 5; do holds "$(json moon.json levels $z node_error) <= $(json moon.json levels $z asked)"; done
  succeeds "$scarp" tile window.tif caucasus3d --of 3dtiles --vertical ellipsoid -q
  grep -q "Moon" caucasus3d/tileset.json || fail "tileset.json does not name the moon"
else
  echo "skipped: the moon's raster is not here"
fi
if [ -e "$mars" ]; then
  succeeds "$scarp" tile "$mars" gale --vertical ellipsoid --zoom 13 -q
  python3 "$reader" gale > /dev/null || fail "the tiles of Mars do not fit"
  holds "$(json gale/layer.json scarp ellipsoid 1) == 3396190"
else
  echo "skipped: the raster of Mars is not here"
fi
