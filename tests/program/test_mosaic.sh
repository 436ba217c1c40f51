#!/usr/bin/env bash
# Several rasters as one, a part of one, and one with coarser cells: the same mesh as from a raster prepared that way.
source "$(dirname "$0")/lib.sh"
need gdal_translate gdalwarp python3
after_header() { tail -c +81 "$1"; }
same() { cmp <(after_header "$1") <(after_header "$2") || fail "$1 and $2 differ"; }
gdal_translate -q -a_srs EPSG:32617 -a_ullr 500000 4010320 512090 4000000 "$dem" utm.tif  # cells of 30 m

# Tiles, one of which overlaps its neighbours.
mkdir tiles
gdal_translate -q -srcwin 0 0 203 344 utm.tif tiles/a.tif
gdal_translate -q -srcwin 200 0 203 150 utm.tif tiles/b.tif
gdal_translate -q -srcwin 203 150 200 194 utm.tif tiles/c.tif
echo "no raster" > tiles/readme.txt
succeeds "$scarp" simplify utm.tif whole.stl -e 20
succeeds "$scarp" simplify tiles/a.tif tiles/b.tif tiles/c.tif tiles.stl -e 20 --report tiles.json
same whole.stl tiles.stl
grep -q '^  read as *mosaic of 3 rasters' "$logs/out" || fail "the summary does not tell of the mosaic"
[ "$(json tiles.json input view)" = '"mosaic of 3 rasters"' ] || fail "the report does not tell of the mosaic"
succeeds "$scarp" simplify -e 20 tiles folder.stl
same whole.stl folder.stl
succeeds "$scarp" measure tiles tiles.stl --fail-above 20
succeeds "$scarp" measure tiles/a.tif tiles/b.tif tiles/c.tif tiles.stl --fail-above 20
succeeds "$scarp" info tiles/a.tif tiles/b.tif
grep -q '403 columns x 344 rows' "$logs/out" || fail "info does not see the mosaic"

# Samples outside all tiles are nodata, though no value stands for it.
succeeds "$scarp" simplify tiles/a.tif tiles/b.tif gap.stl -e 20 --report gap.json
[ "$(json gap.json input void)" = "$((200 * 194))" ] || fail "the gap is not missing: $(json gap.json input void)"
holds "$(json gap.json input min) >= 236"

# A raster that Scarp derived is not part of the folder's input.
mkdir work
gdal_translate -q -ot Float32 utm.tif work/m.tif
succeeds "$scarp" simplify work/m.tif work/a.tif -e 60 --error-raster work/z.tif
succeeds "$scarp" simplify work/m.tif work.glb -e 60
succeeds "$scarp" measure work/m.tif work.glb --error-raster work/e.tif
succeeds "$scarp" simplify work work.stl -e 20 --report work.json
same whole.stl work.stl
grep -q '^  read as *work/m.tif, without what Scarp made: a.tif, e.tif, z.tif' "$logs/out" || fail "outputs are left out silently"
[ "$(json work.json input max)" = 1076.0 ] || fail "an output is taken for a part of the mosaic"
succeeds "$scarp" simplify work/m.tif work.glb -e 60 --overwrite --preview work/p.png
refuses 2 "p.png: has no georeference, so that it has no place in a mosaic: name the other rasters one by one" "$scarp" info work
rm work/p.png
rm work/m.tif work/z.tif work/e.tif
succeeds "$scarp" info work --no-suggest # nothing else is there
succeeds "$scarp" generate fractal 60 50 work/hills.tif --size 30
succeeds "$scarp" info work --no-suggest
grep -q '^  read as *work/hills.tif, without what Scarp made: a.tif' "$logs/out" || fail "a synthetic raster is no input"

# Rasters that cannot form a mosaic.
gdalwarp -q -t_srs EPSG:32616 tiles/b.tif zone.tif
gdal_translate -q -ot Float32 tiles/b.tif float.tif
gdal_translate -q -a_nodata -9999 tiles/b.tif nodata.tif
gdal_translate -q -outsize 50% 50% tiles/b.tif coarse.tif
gdal_translate -q -a_ullr 506015 4010320 512105 4005820 tiles/b.tif shifted.tif
refuses 2 "zone.tif is in EPSG:32616, and tiles/a.tif in EPSG:32617: bring it there first (gdalwarp -t_srs EPSG:32617" \
  "$scarp" simplify tiles/a.tif zone.tif o.stl -e 20
for other in float.tif nodata.tif; do # rasters of another type or nodata value; here there is none
  succeeds "$scarp" simplify tiles/a.tif $other tiles/c.tif other.stl -e 20 --overwrite
  same whole.stl other.stl
done
refuses 2 "coarse.tif has cells of 60.2970297 x 60" "$scarp" info tiles/a.tif coarse.tif
refuses 2 "shifted.tif lies 0.5 of a cell beside the grid of tiles/a.tif" "$scarp" simplify tiles/a.tif shifted.tif o.stl -e 20
refuses 2 "no.tif: no such file" "$scarp" simplify tiles/a.tif no.tif p.stl -e 20
mkdir empty
refuses 2 "empty: the folder holds no raster" "$scarp" simplify empty p.stl -e 20
printf '0,0,1\n1,0,2\n0,1,3\n' > points.csv
refuses 1 "points.csv holds points, and a.tif is read as a raster" "$scarp" simplify tiles/a.tif points.csv p.stl -e 20
refuses 1 "OUTPUT is required" "$scarp" simplify tiles/a.tif
refuses 1 "tiles/c.tif is" "$scarp" simplify tiles tiles/c.tif -e 20 --overwrite
refuses 1 "tiles/c.tif is an input file" "$scarp" simplify tiles/a.tif tiles/b.tif tiles/c.tif tiles/c.tif -e 20 --overwrite

# A part: whole cells, outwards.
gdal_translate -q -srcwin 10 20 101 52 utm.tif part.tif
succeeds "$scarp" simplify part.tif part.stl -e 10
succeeds "$scarp" simplify utm.tif te.stl -e 10 --te 500300 4008160 503330 4009720
same part.stl te.stl
grep -q 'read as *columns 10 to 110 of 403 and rows 20 to 71 of 344' "$logs/out" || fail "the summary does not tell the part"
succeeds "$scarp" simplify tiles te.stl -e 10 --te 500310 4008170 503320 4009719 --overwrite
same part.stl te.stl
refuses 2 "utm.tif: lies beside the extent" "$scarp" simplify utm.tif o2.stl -e 10 --te 0 0 1 1
refuses 1 "--te 5 0 1 1 is empty" "$scarp" simplify utm.tif o2.stl -e 10 --te 5 0 1 1
refuses 1 "--te needs 4 values" "$scarp" simplify utm.tif o2.stl -e 10 --te 5 0
gdal_translate -q -co PROFILE=BASELINE "$dem" plain.tif
rm -f plain.tif.aux.xml
refuses 1 "an extent and a resolution need a georeference" "$scarp" info plain.tif --te 0 0 5 5

# Coarser cells are means, never from an overview.
python3 - <<'PYTHON'
rows = [[1, 2, 3, 4, 9], [2, 3, 4, 5, 9], [7, 7, -9, -9, 9], [8, 9, -9, -9, 9]]
open("few.asc", "w").write("ncols 5\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9\n" +
                           "\n".join(" ".join(map(str, row)) for row in rows) + "\n")
PYTHON
gdal_translate -q -ot Int16 few.asc few.tif
succeeds "$scarp" simplify few.tif means.tif -e 0 --resolution 2
grep -q 'read as *means of 2 x 2 cells, 2 x 2 each (without the last 1 columns and 0 rows)' "$logs/out" || fail "the summary does not tell the means"
[ "$(gdal_translate -q -of XYZ means.tif /vsistdout/ | cut -d' ' -f3 | head -3 | tr '\n' ' ')" = "2 4 7.75 " ] || fail "wrong means"
# The mean of valid samples: excludes declared nodata and the value of --nodata.
sed 's/-9 -9 9$/5 6 9/; s/^2 3 4 5/2 3 4 -9/' few.asc > mixed.asc
gdal_translate -q -ot Int16 mixed.asc mixed.tif
gdal_translate -q -a_nodata none mixed.tif plain.tif
for input in "mixed.tif" "plain.tif --nodata -9"; do
  succeeds "$scarp" simplify $input mixed.csv.tif -e 0.001 --resolution 2 --overwrite
  means=$(gdal_translate -q -of XYZ mixed.csv.tif /vsistdout/ | cut -d' ' -f3 | tr '\n' ' ')
  [[ "$means" = "2 3.66"*" 7.75 5.5 " ]] || fail "means of $input: $means"
done
# GDAL's rounding of means counts: the bound holds for exact means.
python3 - > thirds.asc <<'PYTHON'
print("ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 1")
for row in range(60):
    print(*(20000 + (row * row * 7 + col * row * 3 + col * 11) % 9000 for col in range(60)))
PYTHON
gdal_translate -q -ot Int16 thirds.asc thirds.tif
refuses 3 "a max error of 0 cannot be kept: the raster's values do not fit float32" \
  "$scarp" simplify thirds.tif zero.glb -e 0 --resolution 3
succeeds "$scarp" simplify thirds.tif thirds.ply -e 1000 --resolution 3 --report thirds.json
holds "$(json thirds.json sample_rounding) >= 0.00065 && $(json thirds.json sample_rounding) < 0.001"
succeeds "$scarp" measure thirds.tif thirds.ply --resolution 3 --fail-above 1000
succeeds "$scarp" simplify thirds.tif quarters.ply -e 0 --resolution 2
succeeds "$scarp" simplify utm.tif memory.stl -e 10 --resolution 100 --effort fast
succeeds "$scarp" measure utm.tif memory.stl --resolution 100 --fail-above 10
gdaladdo -q -r nearest utm.tif 2 4
succeeds "$scarp" simplify utm.tif overview.stl -e 10 --resolution 100 --effort fast
same memory.stl overview.stl
refuses 1 "--resolution 0 is not above 0" "$scarp" info utm.tif --resolution 0
refuses 2 "leave less than 2 x 2" "$scarp" info utm.tif --resolution 100000
refuses 1 "--resolution cannot be combined with --decode" "$scarp" info utm.tif --resolution 100 --decode terrarium
