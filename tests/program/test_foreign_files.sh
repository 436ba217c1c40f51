#!/usr/bin/env bash
# Foreign and malicious files: each is read or refused with one message, and no file is left next to it.
source "$(dirname "$0")/lib.sh"
need gdal_translate gzip python3

# XML whose entities would expand to gigabytes is never given to a driver that expands them.
python3 - <<'PYTHON'
entities = ['<!ENTITY e0 "lol">'] + [f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 10)]
bomb = ('<?xml version="1.0"?>\n<!-- a < b -->\n<!DOCTYPE x [\n' + "\n".join(entities) + ']>\n'
        '<x xmlns:gml="http://www.opengis.net/gml" a="http://www.adv-online.de/namespaces/adv/gid/6.0 NAS-Operationen.xsd">'
        '<gml:a>&e9;</gml:a></x>\n')
open("bomb.xml", "w").write(bomb)
open("bomb16.xml", "w", encoding="utf-16").write(bomb.replace('version="1.0"', 'version="1.0" encoding="UTF-16"'))
PYTHON
for bomb in bomb.xml:"not a raster" bomb16.xml:"text in UTF-16"; do
  is=${bomb#*:} bomb=${bomb%:*}
  refuses 2 "$bomb: $is" timeout 600 "$scarp" info "$bomb"
  refuses 2 "$bomb: $is" timeout 600 "$scarp" simplify "$bomb" out.glb -e 1
  refuses 2 "$bomb: XML that declares entities is not read" timeout 600 "$scarp" simplify "$dem" out.glb -e 50 --cutline "$bomb"
  refuses 2 "$bomb: XML that declares entities is not read" timeout 600 "$scarp" simplify "$bomb" out.glb -e 1 --points
done
rm ./*.xml

# For a name shared by rasters and points the contents decide.
gdal_translate -q -of ENVI "$dem" raster.dat
printf 'x y z\n0 0 1\n1 0 2\n0 1 3\n1 1 5\n' > points.dat
cp points.dat points.txt
succeeds "$scarp" simplify raster.dat raster.ply -e 50
succeeds "$scarp" measure raster.dat raster.ply --fail-above 50
for points in points.dat points.txt; do
  succeeds "$scarp" simplify $points points.ply -e 0 --overwrite
  grep -q '^  points ' "$logs/out" || fail "$points is not taken for points"
done
rm ./*

# Nothing is written next to an input.
printf '<?xml version="1.0"?><gml:FeatureCollection xmlns:gml="http://www.opengis.net/gml"><gml:featureMember><f fid="1">%s</f>%s' \
  '<gml:polygonProperty><gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>-84.4,36.2 -84.2,36.2 -84.2,36.4 -84.4,36.2</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon></gml:polygonProperty>' \
  '</gml:featureMember></gml:FeatureCollection>' > area.gml
gdal_translate -q -of AAIGrid -co FORCE_CELLSIZE=YES "$dem" grid.asc
gzip -k grid.asc
gdal_translate -q -of PNG -scale 200 1100 0 65535 -ot UInt16 "$dem" picture.png
rm -f ./*.aux.xml
before=$(ls)
refuses 2 "area.gml: holds polygons, not points or lines" "$scarp" info area.gml
try "$scarp" simplify "$dem" "$logs/o.glb" -e 50 --cutline area.gml --mask-outside --overwrite
[ "$code" != 70 ] || fail "exit code 70 with a cutline in GML"
for file in grid.asc /vsigzip/grid.asc.gz picture.png; do
  succeeds "$scarp" simplify "$file" "$logs/o.glb" -e 2000 --overwrite
  succeeds "$scarp" info "$file"
done
[ "$(ls)" = "$before" ] || fail "files appear beside inputs: $(ls)"
rm ./*

# --overwrite never replaces a file that is part of an input.
cp "$dem" a.tif
cp "$dem" b.tif
gdal_translate -q -of VRT a.tif inner.vrt
gdal_translate -q -of VRT inner.vrt outer.vrt
gdal_translate -q -of VRT b.tif mask.vrt
refuses 1 "OUTPUT a.tif is a file that inner.vrt is made of" "$scarp" simplify inner.vrt a.tif -e 50 --overwrite
refuses 1 "OUTPUT a.tif is a file that outer.vrt is made of" "$scarp" simplify outer.vrt a.tif -e 50 --overwrite
refuses 1 "OUTPUT b.tif is a file that mask.vrt is made of" "$scarp" simplify a.tif b.tif -e 50 --mask mask.vrt --overwrite
refuses 1 "--error-raster a.tif is a file that inner.vrt is made of" \
  "$scarp" simplify inner.vrt o.glb -e 50 --error-raster a.tif --overwrite
succeeds "$scarp" simplify inner.vrt b.tif -e 50 --overwrite
rm ./*

# A truncated JPEG does not end in grey rows.
gdal_translate -q -of JPEG -ot Byte -scale "$dem" whole.jpg
head -c 9000 whole.jpg > cut.jpg
refuses 2 "cut.jpg: rows" "$scarp" simplify cut.jpg cut.glb -e 5
cp "$dem" land.tif
refuses 2 "cut.jpg" "$scarp" simplify land.tif cut.glb -e 5 --texture cut.jpg
rm ./*

# Libraries that print, and libraries that crash.
printf '\211HDF\r\n\032\ngarbage' > broken.h5
refuses 2 "broken.h5: " "$scarp" info broken.h5
printf '\016\003\023\001garbage' > old.hdf
refuses 2 "old.hdf: HDF4 is not read, since its library crashes on damaged files: convert it first" "$scarp" info old.hdf
refuses 2 "HDF4 is not read" "$scarp" simplify HDF4_SDS:UNKNOWN:old.hdf:0 o.glb -e 1

# Every sentence names its file.
printf 'ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9\n-9 1\n2 -9\n' > diagonal.asc
try "$scarp" info diagonal.asc
[ "$code" = 2 ] && grep -q '^scarp: diagonal.asc: the raster has no grid cell' "$logs/err" || fail "info does not name its file"
python3 -c 'import struct; open("huge.dat", "wb").write(struct.pack("<4d", 1e300, 2e300, 3e300, 4e300))'
printf 'ENVI\nsamples = 2\nlines = 2\nbands = 1\ndata type = 5\nbyte order = 0\ninterleave = bsq\n' > huge.hdr
refuses 2 "huge.dat: none of its 2 x 2 samples is a height: 4 are infinite or beyond what a float32 holds (3.4e38), so give them in a larger unit first" \
  "$scarp" info huge.dat

# With standard output closed, only the file is written.
"$scarp" simplify "$dem" closed.glb -e 50 >&- 2>&- || fail "exit code $? with closed standard streams"
succeeds "$scarp" measure "$dem" closed.glb --fail-above 50
if "$scarp" info "$dem" >&- 2>&-; then fail "info succeeds without a place for its table"; fi

# Cells of a micrometre far from the origin: doubles hardly separate them.
gdal_translate -q -a_srs EPSG:32617 -a_ullr 500000 4000000.000344 500000.000403 4000000 "$dem" micro.tif
succeeds "$scarp" simplify micro.tif micro.obj -e 20 --effort high
succeeds "$scarp" measure micro.tif micro.obj --fail-above 20
