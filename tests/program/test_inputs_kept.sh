#!/usr/bin/env bash
# No output replaces a file that any option reads, nor its parts or its archive.
source "$(dirname "$0")/lib.sh"
need ogr2ogr gdal_translate gzip tar python3

cp -L "$data"/examples/* .
for name in water rivers breaklines cutline roi materials node-strings; do cp lakes.geojson "$name.geojson"; done
cp dem.tif mask.tif
cp dem.tif tolerance.tif
cp tile.png texture.png
cp tile.png drape.png
echo "s 3 3" > script.txt

# Every option of the table that names an input file; a new one must be added here.
options=$("$scarp" help --json simplify | python3 -c '
import json, sys
rows = json.load(sys.stdin)["options"]
read = [r for r in rows if r["type"] == "file" and r["group"] not in ("Arguments", "Output") or r["name"] == "--drape"]
print(*sorted(r["name"] for r in read))')
expected="--breaklines --cutline --drape --mask --materials --node-strings --rivers --roi --script --texture --tolerance --water"
[ "$options" = "$expected" ] ||
  fail "options that read files: $options"
for option in $options; do
  file=$(ls "${option#--}".*)
  value=$file
  if [ "$option" = --roi ]; then value=$file=5; fi
  format=glb
  case $option in --materials | --node-strings) format=2dm ;; esac
  refuses 1 "OUTPUT $file is an input file" "$scarp" simplify dem.tif "$file" --of $format -e 20 "$option" "$value" --overwrite
  cp "$file" report.json
  ln -sf "$file" p.png
  refuses 1 "--preview p.png is " "$scarp" simplify dem.tif o.$format -e 20 "$option" "$value" --preview p.png --overwrite
  rm report.json p.png
done

# Layers, and parts of multi-part files.
ogr2ogr -q v.gpkg lakes.geojson -nln lakes
ogr2ogr -q sh.shp lakes.geojson
for option in --water --breaklines --cutline --rivers; do
  refuses 1 "OUTPUT v.gpkg is a file that v.gpkg:lakes is made of" \
    "$scarp" simplify dem.tif v.gpkg -e 20 "$option" v.gpkg:lakes --overwrite
  for part in dbf shx prj; do
    refuses 1 "OUTPUT sh.$part is a file that sh.shp is made of" \
      "$scarp" simplify dem.tif "sh.$part" --of glb -e 20 "$option" sh.shp --overwrite
  done
done
refuses 1 "OUTPUT v.gpkg is a file that v.gpkg:lakes is made of" \
  "$scarp" simplify dem.tif v.gpkg -e 20 --roi v.gpkg:lakes=5 --overwrite
refuses 1 "--report sh.dbf is a file that sh.shp is made of" \
  "$scarp" simplify dem.tif o.glb -e 20 --roi sh.shp=5 --report sh.dbf --overwrite
# A driver's prefix before the file.
for name in GPKG:v.gpkg GPKG:v.gpkg:lakes GeoJSON:lakes.geojson; do
  file=${name#*:}
  refuses 1 "--report ${file%:lakes} is a file that $name is made of" \
    "$scarp" simplify dem.tif o.glb -e 20 --water "$name" --report "${file%:lakes}" --overwrite
done
succeeds "$scarp" simplify dem.tif o.glb -e 20
refuses 1 "--error-raster mask.tif is an input file" \
  "$scarp" measure dem.tif o.glb --mask mask.tif --error-raster mask.tif --overwrite
cp mask.tif cut.tif
mv cut.tif cut.geojson
cp lakes.geojson cut.tif
refuses 1 "--error-raster cut.tif is an input file" \
  "$scarp" measure dem.tif o.glb --cutline cut.tif --error-raster cut.tif --overwrite

# The archive that contains a file.
python3 -c 'import zipfile; zipfile.ZipFile("z.zip", "w").write("dem.tif")'
mkdir in
cp z.zip in/deep.zip
tar cf y.tar dem.tif
gzip -k mask.tif
gdal_translate -q -of VRT /vsizip/z.zip/dem.tif z.vrt
keeps() { refuses 1 "OUTPUT $2 is a file that $1 is made of" "$scarp" simplify "$1" "$2" --of glb -e 20 --overwrite; }
keeps /vsizip/z.zip/dem.tif z.zip
keeps "/vsizip/{z.zip}/dem.tif" z.zip
keeps /vsizip/in/deep.zip/dem.tif in/deep.zip
keeps "/vsizip/$PWD/in/deep.zip/dem.tif" in/deep.zip
keeps /vsitar/y.tar/dem.tif y.tar
keeps /vsigzip/mask.tif.gz mask.tif.gz
keeps "/vsisubfile/0_$(wc -c < dem.tif),dem.tif" dem.tif
keeps z.vrt z.zip

# Standard output opened on an input.
for output in - /dev/stdout; do
  cksum dem.tif > before
  code=0
  "$scarp" simplify dem.tif "$output" --of glb -e 20 1<> dem.tif 2> "$logs/err" || code=$?
  [ "$code" = 1 ] || fail "exit code $code: an input was written to as $output"
  grep -qF "OUTPUT $output is an input file" "$logs/err" || fail "no sentence of standard output"
  cksum dem.tif | cmp - before || fail "dem.tif was written to"
done
"$scarp" simplify dem.tif - --of glb -e 20 > new.glb 2> "$logs/err" || fail "no file for standard output"
cmp o.glb new.glb

# Two outputs that are the same file, which does not exist yet.
ln -s p.png q.png
refuses 1 "--preview and --render name the same file, q.png" \
  "$scarp" simplify dem.tif twice.glb -e 20 --preview p.png --render q.png
