#!/usr/bin/env bash
# --memory: rasters that do not fit are read by windows and judged alike to the last bit; options that cannot work so
# report it.
source "$(dirname "$0")/lib.sh"
need gdal_translate gdalbuildvrt
small=72M # no room for samples: every raster stays in its file

succeeds "$scarp" simplify "$dem" hills.glb -e 5 -q
succeeds "$scarp" measure "$dem" hills.glb --json
grep -v '"seconds"\|"command"' "$logs/out" | sed '/"read":/,$d' > whole.json

# The file itself, a mosaic of four parts, and 16-bit samples in memory.
gdal_translate -q -srcwin 0 0 200 150 "$dem" p1.tif
gdal_translate -q -srcwin 200 0 203 150 -co TILED=YES -co BLOCKXSIZE=64 -co BLOCKYSIZE=64 "$dem" p2.tif
gdal_translate -q -srcwin 0 150 200 194 -co COMPRESS=DEFLATE "$dem" p3.tif
gdal_translate -q -srcwin 200 150 203 194 "$dem" p4.tif
gdalbuildvrt -q mosaic.vrt p1.tif p2.tif p3.tif p4.tif
errors() { grep -E '"(max_error|rmse|mean_error|p50|p99|samples|uncovered|stray|gaps|valid|void|min|max|sound)"' "$1"; }
errors whole.json > whole.txt
for case in "$dem $small" "mosaic.vrt $small" "$dem 72.8M" "$dem 1G"; do
  read -r raster limit <<< "$case"
  for threads in 1 3; do
    succeeds "$scarp" measure "$raster" hills.glb --json --memory "$limit" -j "$threads" --fail-above 5
    cp "$logs/out" streamed.json
    errors streamed.json | cmp - whole.txt || fail "other numbers from $raster with $limit and $threads threads"
  done
done

# An option that needs all samples is refused by name with a sufficient memory, which works.
refuses 1 '--texture needs all samples' "$scarp" measure "$dem" hills.glb --memory $small --texture "$dem"
echo "s 7 9" > inserts.txt
for option in "--render r.png" "--nodata-policy fill" \
  "--order greedy" "--algorithm local" "--edges data" "--outline-tolerance 1" "--script inserts.txt" "--texture $dem"; do
  # shellcheck disable=SC2086
  refuses 1 'needs all samples in memory at once' "$scarp" simplify "$dem" o.glb -e 5 --memory $small $option
done
refuses 1 'needs all samples in memory at once' "$scarp" simplify "$dem" o.pgm -e 5 --memory $small
"$scarp" simplify "$dem" rendered.glb -e 5 --memory $small --render r.png 2>&1 | grep -oE 'allow [0-9]+M' | tr -d -c '0-9M' > enough || true
[ -s enough ] || fail "--render does not say how much memory would do"
succeeds "$scarp" simplify "$dem" rendered.glb -e 5 --memory "$(cat enough)" --render r.png

# An input that later needs all samples is refused, too.
{ printf 'ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 1\n'; for ((k = 0; k < 800; ++k)); do echo 3e38 "1e-$((k % 30))"; done; } > huge.asc
refuses 2 'only be refined in memory: leave --memory out, or allow 74M' "$scarp" simplify huge.asc o.glb -e 1 --memory $small

# A mesh that exceeds the limit is refused with a sufficient memory, which works.
succeeds "$scarp" generate fractal 900 900 fractal.tif -q
for raster in fractal.tif "$dem"; do
  for limit in 72M 74M; do
    refuses 1 "--memory $limit is too little: the mesh has" "$scarp" simplify "$raster" o.glb -e 0 --memory $limit
  done
  grep -oE 'would need about [0-9]+M' "$logs/err" | tr -d -c '0-9M' > enough
  succeeds "$scarp" simplify "$raster" o.glb -e 0 --memory "$(cat enough)" -q
  rm o.glb
done
refuses 1 '--memory 80M is too little: the mesh has' "$scarp" simplify fractal.tif o.glb -e 0 --effort normal --memory 80M
gdal_translate -q -of VRT -outsize 300000 100 "$dem" wide.vrt
refuses 1 '--memory 80M is too little: ' "$scarp" simplify wide.vrt o.glb -e 5 --memory 80M
grep -q 'M are needed before the mesh' "$logs/err" || fail "strips that do not fit are not said to be the reason"

# Sizes.
for size in 999999999T 1e30G 1e400 1000001T; do
  refuses 1 "--memory $size is too large: give at most 1000000T, or leave --memory out" "$scarp" measure "$dem" hills.glb --memory $size
done
for size in 0 0.5 1e-400G 63M; do
  refuses 1 "--memory $size is too little: the program alone needs 72M" "$scarp" measure "$dem" hills.glb --memory $size
done
for size in x 1Q G -1G nan inf infG 1e 1,5G 1GBB; do
  refuses 1 "--memory $size is no size of memory" "$scarp" measure "$dem" hills.glb "--memory=$size"
done
for size in 1G 1GiB 1.5g 900M "900 MB" 72000000 100Mi 1T 1000000T; do
  succeeds "$scarp" measure "$dem" hills.glb --memory "$size" -q
done
refuses 1 '--image' "$scarp" measure "$dem" hills.glb --memory 1G --image

# A file damaged in the middle: exit code 2, file and row, nothing written.
gdal_translate -q -co COMPRESS=DEFLATE -co BLOCKYSIZE=1 "$dem" cut.tif
python3 - << 'PYTHON' 2> /dev/null || skip "needs python3"
data = bytearray(open("cut.tif", "rb").read())
middle = len(data) // 2
data[middle:middle + 4000] = bytes(4000)
open("cut.tif", "wb").write(data)
PYTHON
refuses 2 'cut.tif: row' "$scarp" measure cut.tif hills.glb --memory $small
refuses 2 'cut.tif: row' "$scarp" simplify cut.tif o.glb -e 0.5% --memory $small
