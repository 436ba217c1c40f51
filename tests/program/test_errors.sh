#!/usr/bin/env bash
# Invalid input and options: one clear message, the right exit code, and no output.
source "$(dirname "$0")/lib.sh"
need gdal_translate gdal_create python3

# Options.
refuses 1 "no command given: choose simplify" "$scarp"
refuses 1 "unknown command 'simplfy' (did you mean simplify?)" "$scarp" simplfy "$dem" out.glb
refuses 1 "unknown command 'simplfy' (did you mean simplify?)" "$scarp" help simplfy
refuses 1 "did you mean measure?" "$scarp" validate "$dem" out.glb
refuses 1 "unknown command 'paper': make paper" "$scarp" paper --data . --out bench
refuses 1 "unknown command 'frobnicate': choose simplify" "$scarp" frobnicate
refuses 1 "a file comes behind one, as in scarp simplify dem.tif OUTPUT -e 1" "$scarp" dem.tif out.glb
refuses 1 "option --versoin is unknown (did you mean --version?)" "$scarp" --versoin
refuses 1 "scarp info" "$scarp" simplify "$dem" out.glb
refuses 1 "INPUT" "$scarp" simplify
refuses 1 "OUTPUT" "$scarp" simplify "$dem" -e 1
refuses 1 "option --frobnicate is unknown" "$scarp" simplify "$dem" out.glb -e 1 --frobnicate
refuses 1 "scarp simplify --help" "$scarp" simplify "$dem" out.glb -e 1 --frobnicate
# Misspelled, or another program's.
while read -r given meant; do
  refuses 1 "option $given is unknown (did you mean $meant?)" "$scarp" simplify "$dem" out.glb "$given" 1
done <<'END'
--effor --effort
--error --max-error
--max_error --max-error
--max-eror --max-error
--t_srs --crs
-t_srs --crs
-of --of
-effort --effort
-preview --preview
--threads --num-threads
--thread --num-threads
--force --overwrite
-srcnodata --nodata
--hel --help or --help-all
--eff --effort
--lod --lods or --lods-in-one
--lods-in --lods-in-one
--max --max-error, --max-triangles, --max-points or --max-edge
--fallof --falloff
--errr --max-error
--bbbox --te
END
refuses 1 "a share of the relief is an error with a % behind it: -e 1%" "$scarp" simplify "$dem" out.glb --percent 1
refuses 1 "contour lines are an input: scarp simplify contours.gpkg OUTPUT -e 2" "$scarp" simplify "$dem" out.glb --contours lines.gpkg
refuses 1 "unknown command 'simp' (did you mean simplify?)" "$scarp" simp
refuses 1 "option --error=5 is unknown (did you mean --max-error?)" "$scarp" simplify "$dem" out.glb --error=5
refuses 1 "gdal_translate -a_srs" "$scarp" simplify "$dem" out.glb -e 1 -a_srs EPSG:32611
refuses 1 "the output is the word behind the input" "$scarp" simplify "$dem" -o out.glb -e 1
for area in -te --bbox; do
  refuses 1 "option $area is unknown (did you mean --te?)" "$scarp" simplify "$dem" out.glb -e 1 $area 1 2 3 4
done
refuses 1 "(did you mean --fail-above?)" "$scarp" measure "$dem" out.glb --fail-abov 1
refuses 2 "out.glb: no such file" "$scarp" simplify "$dem" out.glb more.glb -e 1
refuses 1 "--max-error needs a value" "$scarp" simplify "$dem" out.glb -e
for behind in --overwrite -q --order=greedy --frobnicate --help; do
  for option in --order --max-error --report --memory --nodata --num-threads; do
    refuses 1 "$option needs a value, and $behind behind it reads as an option" "$scarp" simplify "$dem" out.glb "$option" "$behind"
  done
done
refuses 1 "--num-threads needs a value, and --json behind it" "$scarp" measure "$dem" out.glb -j --json
refuses 1 "--crs needs a value, and -q behind it" "$scarp" info "$dem" --crs -q
succeeds "$scarp" simplify "$dem" "$root/o.glb" -e 100 --report=--plain -q # a value that reads like an option
[ -s ./--plain ] || fail "--report=--plain wrote no file of that name"
rm ./--plain "$root/o.glb"
refuses 2 "nofile: no such file" "$scarp" simplify --breaklines nofile "$dem" out.glb -e 100 # one value each time
refuses 1 "--max-error is given more than once" "$scarp" simplify "$dem" out.glb -e 1 -e 2
for bad in -5 -0.1% nan NaN inf -inf garbage 5mi 5x 1e999 % m mm -1m "" "5 %" 0x10; do
  refuses 1 "" "$scarp" simplify "$dem" out.glb "--max-error=$bad"
done
refuses 1 "--max-error -5 is negative" "$scarp" simplify "$dem" out.glb -e -5
refuses 1 "--max-error nan" "$scarp" simplify "$dem" out.glb -e nan
refuses 1 "--max-error 5mi" "$scarp" simplify "$dem" out.glb -e 5mi
refuses 1 "--max-error 0.1mm is an error on a print, which needs its size" "$scarp" simplify "$dem" out.stl -e 0.1mm
refuses 1 "--max-error 0.1mm is an error on a print, which needs its size" "$scarp" simplify "$dem" out.stl -e 0.1mm --solid base=0
refuses 1 "--max-error 0mm is not above 0" "$scarp" simplify "$dem" out.stl -e 0mm --solid size=9cm
refuses 1 "grey levels" "$scarp" simplify "$dem" out.glb -e 1m --image
for bad in 0 -1 nan 1.5 1.0001k inf k 5kk 1e-3 0x10 many 99999999999999999999; do
  refuses 1 "--max-triangles $bad" "$scarp" simplify "$dem" out.glb -t "$bad"
  refuses 1 "--max-points $bad" "$scarp" simplify "$dem" out.glb -p "$bad"
done
refuses 1 "--max-triangles 99999999999999999999 is too large" "$scarp" simplify "$dem" out.glb -t 99999999999999999999
refuses 1 "--max-triangles 1.5 is not a whole number of at least 1, such as 5000, 50k" "$scarp" simplify "$dem" out.glb -t 1.5
refuses 1 "--max-triangles 1e30 is too large" "$scarp" simplify "$dem" out.glb -t 1e30
refuses 1 "--num-threads 99999999999999999999 is too large" "$scarp" simplify "$dem" out.glb -e 1 -j 99999999999999999999
refuses 1 "--num-threads 1025 is above 1024: ask for fewer" "$scarp" simplify "$dem" out.glb -e 1 -j 1025
for option in --max-error --base --nodata; do
  refuses 1 "$option 1e999 is too large" "$scarp" simplify "$dem" out.glb "$option=1e999" -t 10
done
refuses 1 "--nodata-policy outline 1e999 is too large" "$scarp" simplify "$dem" out.glb --nodata-policy outline=1e999 -t 10
refuses 1 "--max-error 1e999% is too large" "$scarp" simplify "$dem" out.glb -e 1e999%
refuses 1 "--band 0" "$scarp" simplify "$dem" out.glb -e 1 --band 0
refuses 1 "--band two" "$scarp" simplify "$dem" out.glb -e 1 --band two
refuses 1 "--nodata none" "$scarp" simplify "$dem" out.glb -e 1 --nodata none
refuses 1 "--decode png" "$scarp" simplify "$dem" out.glb -e 1 --decode png
refuses 1 "--decode cannot be combined with --band" "$scarp" simplify "$dem" out.glb -e 1 --decode mapbox --band 2
refuses 1 "--nodata-policy ignore" "$scarp" simplify "$dem" out.glb -e 1 --nodata-policy ignore
refuses 1 "--fill-distance" "$scarp" simplify "$dem" out.glb -e 1 --fill-distance 5
refuses 1 "--nodata-policy distance 0" "$scarp" simplify "$dem" out.glb -e 1 --nodata-policy fill --fill-distance 0
refuses 1 "--background" "$scarp" simplify "$dem" out.glb -e 1 --background 0
refuses 1 "--nodata-policy background needs --background: the height to use, such as height=0" "$scarp" simplify "$dem" out.glb -e 1 --nodata-policy background
refuses 1 "--nodata-policy height nan" "$scarp" simplify "$dem" out.glb -e 1 --nodata-policy background --background nan
refuses 1 "--nodata-policy outline -1" "$scarp" simplify "$dem" out.glb -e 1 --outline-tolerance -1
refuses 1 "--num-threads -1" "$scarp" simplify "$dem" out.glb -e 1 -j -1
refuses 1 "--base nan" "$scarp" simplify "$dem" out.glb -e 1 --base nan
refuses 1 "--base -1e300 is below -1e+30" "$scarp" simplify "$dem" out.glb -e 1 --base -1e300
refuses 1 "--normals cannot be combined with --base" "$scarp" simplify "$dem" out.glb -e 1 --base 0 --normals
refuses 1 "--base 2000" "$scarp" simplify "$dem" out.glb -e 50 --base 2000
grep -Eq 'lowest vertex, which is at [0-9]+' "$logs/err" || fail "--base does not name the lowest vertex"
refuses 1 "EPSG:999999" "$scarp" simplify "$dem" out.glb -e 1 --crs EPSG:999999
refuses 1 "--fail-above -1" "$scarp" measure "$dem" out.glb --fail-above -1
refuses 1 "--fail-above nan" "$scarp" measure "$dem" out.glb --fail-above nan

# Names of outputs, checked before reading: the raster does not even exist.
refuses 1 "out.xyz" "$scarp" simplify missing.tif out.xyz -e 1
refuses 1 "out" "$scarp" simplify missing.tif out -e 1
refuses 1 "--of fbx" "$scarp" simplify missing.tif out.glb -e 1 --of fbx
refuses 1 "hills.jpg" "$scarp" simplify missing.tif out.glb -e 1 --preview hills.jpg
refuses 1 "--preview" "$scarp" measure missing.tif missing.glb --preview p.png
refuses 1 "map.jpg" "$scarp" measure missing.tif missing.glb --map map.jpg
refuses 1 "same file" "$scarp" simplify missing.tif out.glb -e 1 --report ./out.glb
refuses 1 "same file" "$scarp" simplify missing.tif out.glb -e 1 --report p.png --preview "$PWD/p.png"
refuses 4 "no folder" "$scarp" simplify missing.tif nowhere/out.glb -e 1
refuses 4 "no folder" "$scarp" simplify missing.tif out.glb -e 1 --report nowhere/r.json
refuses 4 "no folder" "$scarp" measure missing.tif missing.glb --map nowhere/m.png
mkdir folder.glb
refuses 4 "is a folder" "$scarp" simplify missing.tif folder.glb -e 1
cp "$dem" copy.glb
refuses 1 "input file" "$scarp" simplify copy.glb ./copy.glb -e 1 --overwrite
ln -s copy.glb link.glb
refuses 1 "input file" "$scarp" simplify copy.glb link.glb -e 1 --overwrite
refuses 1 "input file" "$scarp" simplify copy.glb out.glb -e 1 --report copy.glb --overwrite
cp "$dem" raster.png
refuses 1 "input file" "$scarp" measure raster.png mesh.glb --map raster.png --overwrite

# Rasters.
refuses 2 "missing.tif" "$scarp" simplify missing.tif out.glb -e 1
refuses 2 "missing.tif" "$scarp" info missing.tif
echo "this is no raster" > text.tif
refuses 2 "text.tif" "$scarp" simplify text.tif out.glb -e 1
: > empty.tif
refuses 2 "empty.tif" "$scarp" simplify empty.tif out.glb -e 1
mkdir empty
refuses 2 "empty: the folder holds no raster" "$scarp" simplify empty out.glb -e 1
rmdir empty
gdal_translate -q -co TILED=YES "$dem" whole.tif
head -c 100000 whole.tif > cut.tif
refuses 2 "cut.tif" "$scarp" simplify cut.tif out.glb -e 1
head -c 60 whole.tif > stub.tif
refuses 2 "stub.tif" "$scarp" simplify stub.tif out.glb -e 1
gdal_translate -q -co COMPRESS=DEFLATE "$dem" packed.tif
size=$(wc -c < packed.tif)
{ head -c $((size / 2)) packed.tif; head -c 3000 /dev/zero | tr '\0' 'x'; tail -c +$((size / 2 + 3001)) packed.tif; } > corrupt.tif
refuses 2 "corrupt.tif" "$scarp" simplify corrupt.tif out.glb -e 1
gdal_create -q -of GTiff -outsize 1 50 -bands 1 -burn 7 narrow.tif
refuses 2 "narrow.tif" "$scarp" simplify narrow.tif out.glb -e 1
gdal_create -q -of GTiff -outsize 50 1 -bands 1 -burn 7 flat.tif
refuses 2 "flat.tif" "$scarp" simplify flat.tif out.glb -e 1
gdal_create -q -of GTiff -outsize 1 1 -bands 1 -burn 7 point.tif
refuses 2 "point.tif" "$scarp" info point.tif
gdal_create -q -of GTiff -outsize 20 20 -bands 1 -burn 7 -a_nodata 7 void.tif
refuses 2 "void.tif" "$scarp" simplify void.tif out.glb -e 1
refuses 2 "void.tif" "$scarp" info void.tif
refuses 2 "band 2" "$scarp" simplify "$dem" out.glb -e 1 --band 2
printf 'P5 0 0 255\n' > empty.pgm
refuses 2 "empty.pgm" "$scarp" simplify empty.pgm out.glb -e 1
printf 'P2 3 3 255\n1 2 3 4 5\n' > cut.pgm
refuses 2 "cut.pgm" "$scarp" simplify cut.pgm out.glb -e 1
printf 'P2 3 3 255\n1 2 3 4 x 6 7 8 9\n' > letters.pgm
refuses 2 "letters.pgm" "$scarp" simplify letters.pgm out.glb -e 1
refuses 2 "" "$scarp" simplify "$dem" out.glb -e 1 --decode terrarium

# A machine that does not answer, and a name that is almost right.
refuses 2 "http://127.0.0.1:1/x.tif: cannot be read: CURL error: Failed to connect" "$scarp" info http://127.0.0.1:1/x.tif
cp "$dem" near.tif
refuses 2 "near.tiff: no such file: did you mean near.tif?" "$scarp" info near.tiff
refuses 2 "naer.tif: no such file: did you mean near.tif?" "$scarp" simplify naer.tif out.glb -e 1
refuses 1 "OUTPUT - is standard output" "$scarp" simplify near.tif - -e 1

# More than the machine's memory: refused before the work, with the figure.
echo '<VRTDataset rasterXSize="2000000" rasterYSize="2000000"><VRTRasterBand dataType="Float32" band="1"/></VRTDataset>' > huge.vrt
refuses 2 "TiB of memory" "$scarp" simplify huge.vrt out.glb -e 1
refuses 2 "TiB of memory" "$scarp" info huge.vrt

# Meshes.
refuses 2 "missing.glb" "$scarp" measure "$dem" missing.glb
for format in glb obj ply stl; do
  succeeds "$scarp" simplify "$dem" "mesh.$format" -e 100 -q
  size=$(wc -c < "mesh.$format")
  head -c $((size / 2)) "mesh.$format" > "half.$format"
  if [ "$format" != obj ]; then refuses 2 "half.$format" "$scarp" measure "$dem" "half.$format"; fi
done
refuses 2 "text.tif" "$scarp" measure "$dem" text.tif
refuses 2 "empty.tif" "$scarp" measure "$dem" empty.tif

# A truncated OBJ file has no end mark; its rest must not pass for the whole.
try "$scarp" measure "$dem" half.obj --fail-above 100
[ "$code" = 2 ] || [ "$code" = 3 ] || fail "half an OBJ file passes"

# A failed write is reported.
if [ -w /dev/full ]; then
  try bash -c '"$1" info "$2" > /dev/full' - "$scarp" "$dem"
  [ "$code" = 4 ] || fail "a full standard output ends with $code instead of 4"
  grep -q '^scarp: standard output cannot be written: ' "$logs/err" || fail "a full standard output is not told"
  try bash -c '"$1" info missing.tif 2> /dev/full' - "$scarp"
  [ "$code" = 2 ] || fail "a full stderr turns exit code 2 into $code"
  try bash -c '"$1" simplify "$2" full.glb -e 100 --json-progress 2> /dev/full' - "$scarp" "$dem"
  [ "$code" = 0 ] || fail "a full stderr ends a good run with $code"
  try "$scarp" simplify "$dem" unreported.glb -e 100 --report /dev/full
  [ "$code" = 4 ] || fail "a full disk for the report ends with $code instead of 4"
  grep -q '/dev/full: the disk is full; unreported.glb itself is written$' "$logs/err" || fail "what is written is not told"
  succeeds "$scarp" measure "$dem" unreported.glb --fail-above 100 -q
fi
try bash -c '"$1" info missing.tif 2>&-' - "$scarp"
[ "$code" = 2 ] || fail "a closed stderr turns exit code 2 into $code"
try bash -c '"$1" info "$2" >&-' - "$scarp" "$dem"
[ "$code" = 4 ] || fail "a closed standard output ends with $code instead of 4"
try bash -c '"$1" simplify "$2" closed.glb -e 100 --json-progress <&- >&- 2>&-' - "$scarp" "$dem"
[ "$code" = 0 ] || fail "closed streams, which nobody reads, end with $code though the mesh is written"
succeeds "$scarp" measure "$dem" closed.glb --fail-above 100 -q
# A read-only folder (root may write everywhere, so another user is used).
mkdir locked
chmod 555 locked
if [ "$(id -u)" != 0 ]; then
  refuses 4 "locked" "$scarp" simplify "$dem" locked/out.glb -e 100
elif command -v setpriv > /dev/null; then
  chmod 755 "$root" "$root/run"
  nobody=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  if "${nobody[@]}" test -x "$scarp" -a -r "$dem"; then
    refuses 4 "locked" "${nobody[@]}" "$scarp" simplify "$dem" locked/out.glb -e 100
  fi
fi
echo "every bad input gets its sentence"
