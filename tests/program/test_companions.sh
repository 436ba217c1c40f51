#!/usr/bin/env bash
# Masks, tolerances and scripts: satisfied sample by sample, judged alike by simplify and measure, refused on other
# grids.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate gdalinfo

make_raster weights.tif 'col / 402'
make_raster percent.tif 'col // 4' Byte
make_raster bounds.tif 'nan if row < 40 else 5 + row / 7'
simplify() { "$scarp" simplify "$dem" out.glb "$@"; }

# same KEY...: the two reports agree on a number.
same() {
  python3 - s.json m.json "$@" <<'PYTHON'
import json, sys
a, b = (json.load(open(f)) for f in sys.argv[1:3])
for key in sys.argv[3:]:
    assert abs(a[key] - b[key]) <= 1e-6 * max(1, abs(a[key])), (key, a[key], b[key])
PYTHON
}

# A mask: weight times error is bounded, except where the weight is 0.
for mask in weights.tif percent.tif; do
  succeeds "$scarp" simplify "$dem" masked.glb -e 20 --mask "$mask" --report s.json --overwrite
  succeeds "$scarp" measure "$dem" masked.glb --mask "$mask" --fail-above 20 --json
  cp "$logs/out" m.json
  same weighted_max_error weighted_rmse ignored max_error rmse
  holds "$(json s.json weighted_max_error) <= 20.00001 && $(json s.json max_error) > 30 && $(json s.json ignored) >= 344"
  try "$scarp" measure "$dem" masked.glb --mask "$mask" --fail-above 19
  [ "$code" = 3 ] && grep -q 'weighted max error .* exceeds 19' "$logs/err" || fail "a broken weighted bound passes"
done
grep -q -- '--mask percent.tif' <(strings masked.glb) || fail "the metadata does not name the mask"

# A colour picture has three bands, one of which is used.
gdal_translate -q -of PNG -ot Byte -b 1 -b 1 -b 1 -colorinterp red,green,blue percent.tif picture.png
succeeds "$scarp" simplify "$dem" pictured.glb -e 20 --mask picture.png
grep -q '^scarp: warning: picture.png: this is a colour picture, and its first band alone, red, is taken for the values$' \
  "$logs/err" || fail "a picture is a mask without a word"

# So has a raster of several bands.
make_raster ones.tif 1
gdal_translate -q -b 1 -b 1 ones.tif stack.tif
for option in --mask --tolerance; do
  succeeds "$scarp" simplify "$dem" stacked.glb -e 20 $option stack.tif --overwrite
  grep -q '^scarp: warning: stack.tif: has 2 bands, and its first alone is taken for the values: select another (gdal_translate -b 2 stack.tif NEW.tif)$' \
    "$logs/err" || fail "$option: a band is chosen without a word"
done
rm ones.tif

# A mask of 1 everywhere changes almost nothing: bounds are rounded downwards to float32.
make_raster ones.tif 1 Byte
succeeds "$scarp" simplify "$dem" plain.obj -e 20 --effort fast --report plain.json
succeeds "$scarp" simplify "$dem" ones.obj -e 20 --mask ones.tif --report ones.json
holds "$(json ones.json max_error) <= 20 && $(json ones.json triangles) < 1.02 * $(json plain.json triangles)"

# Values rounded to float32 by up to 32 keep weighted bounds that are hardly larger.
gdal_translate -q -ot Float64 -scale 236 1076 1000000000.3 1000084000.7 "$dem" fine.tif
make_raster half.tif 0.5
succeeds "$scarp" simplify fine.tif fine.glb -e 1000 --mask half.tif --report s.json --overwrite
holds "$(json s.json max_error) + $(json s.json sample_rounding) <= 2000"

# Tolerances are a goal, alone or with an error.
succeeds "$scarp" simplify "$dem" t.glb --tolerance bounds.tif --report s.json --overwrite
grep -q '^Kept every tolerance, after [0-9.]* s$' "$logs/out" || fail "the summary does not tell that tolerances are kept"
succeeds "$scarp" measure "$dem" t.glb --tolerance bounds.tif --json
cp "$logs/out" m.json
same weighted_max_error weighted_rmse max_error
holds "$(json s.json weighted_max_error) <= 1.000001 && $(json m.json over_tolerance) == 0"
[ "$(json m.json passed)" = true ] || fail "tolerances have no verdict of their own"
python3 - s.json <<'PYTHON'
import json, sys
assert json.load(open(sys.argv[1]))["ignored"] == 40 * 403
PYTHON
succeeds "$scarp" simplify "$dem" both.glb --tolerance bounds.tif -e 12 --report both.json
succeeds "$scarp" measure "$dem" both.glb --tolerance bounds.tif --fail-above 12 -q
holds "$(json both.json triangles) > $(json s.json triangles) && $(json both.json ignored) == 0"
succeeds "$scarp" simplify "$dem" coarse.glb -t 3000
try "$scarp" measure "$dem" coarse.glb --tolerance bounds.tif
[ "$code" = 3 ] && grep -qE '[0-9,]+ samples are above their tolerance, the worst [0-9.]+ times at column' "$logs/err" ||
  fail "broken tolerances pass"
# A tolerance of 0 keeps a sample; 0 everywhere keeps all.
make_raster exact.tif '0 if (col, row) == (200, 100) else nan'
succeeds "$scarp" simplify "$dem" exact.obj --tolerance exact.tif --crs grid
grep -qE "^v 200 [0-9.]+ -243" exact.obj || fail "a sample of tolerance 0 is no vertex"

# No value means E; a raster without values changes nothing. Infinite tolerances are valid.
make_raster none.tif nan
succeeds "$scarp" simplify "$dem" bare.obj -e 20 --crs grid
succeeds "$scarp" simplify "$dem" none.obj -e 20 --tolerance none.tif --crs grid --report s.json --overwrite
grep -q '^scarp: warning: --tolerance none.tif holds no value: it changes nothing$' "$logs/err" || fail "no word about no value"
[ "$(json s.json max_error)" = "$("$scarp" measure "$dem" bare.obj --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["max_error"])')" ] ||
  fail "a raster without a value changes the mesh"
grep '^[vf] ' bare.obj > bare.txt
grep '^[vf] ' none.obj | cmp - bare.txt || fail "a raster without a value changes the mesh"
succeeds "$scarp" measure "$dem" none.obj --tolerance none.tif --fail-above 20
refuses 2 "--tolerance none.tif: none of its 403 x 344 samples has a value" "$scarp" simplify "$dem" x.obj -t 500 --tolerance none.tif
make_raster tiny.tif '1000 if col < 2 else 2e-37'
gdal_translate -q -a_scale 1e38 tiny.tif endless.tif
succeeds "$scarp" simplify "$dem" endless.obj --tolerance endless.tif
grep -q '^scarp: warning: endless.tif: 688 values are infinite or too large for a float32 and taken as no value$' "$logs/err" ||
  fail "the warning does not tell of the file's values"
# A budget too small for the samples with tolerance 0 breaks some, and reports it.
make_raster strict.tif '0 if row % 3 == 0 else nan'
succeeds "$scarp" simplify "$dem" strict.obj -t 500 --tolerance strict.tif --report s.json --overwrite
[ "$(json s.json tolerance_factor)" = '"inf"' ] || fail "samples of tolerance 0 are said to be kept"
grep -q '^scarp: warning: the budget has no room for all samples of tolerance 0' "$logs/err" || fail "no word about broken tolerances"

# Scripts: inserted samples are vertices, ignored ones have no bound.
printf '# a corner of the map\ns 10 20\n\ns 11 20\ni 300 300\nu 301 300\n' > steps.txt
succeeds "$scarp" simplify "$dem" scripted.obj -t 40 --script steps.txt --crs grid --report s.json --overwrite
grep -qE "^v 10 [0-9.]+ -323" scripted.obj && grep -qE "^v 11 [0-9.]+ -323" scripted.obj || fail "the script's samples are no vertices"
holds "$(json s.json ignored) == 2"
succeeds "$scarp" simplify "$dem" scripted.ply -e 20 --script steps.txt
grep -q 'ignored  *2 samples without a bound' "$logs/out" || fail "the summary does not tell what is ignored"
# If a script correctly marks an outlier, everything else is bounded, whatever its weight.
make_raster spiked.tif '900 if (col, row) == (150, 150) else 300 + col / 4 + row % 3'
printf 'i 150 150\n' > steps.txt
for more in "" "--mask ones.tif" "--batch const"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify spiked.tif flat.obj -e 5 --script steps.txt $more --overwrite --report s.json
  grep -q 'asked 5, ignored samples left out' "$logs/out" || fail "the summary does not tell of the exception"
  holds "$(json s.json max_error) > 500 && $(json s.json triangles) < 10 && $(json s.json p999) < 5"
  grep -qE 'without a bound; max error of the others [0-4]' "$logs/out" || fail "the summary is about the outlier"
  holds "$(json s.json bounded_max_error) <= 5 && $(json s.json bounded_max_error) > 0"
  # With the same script the judge agrees.
  # shellcheck disable=SC2086
  succeeds "$scarp" measure spiked.tif flat.obj --script steps.txt ${more%--batch*} --fail-above 5 --json
  cp "$logs/out" m.json
  same max_error bounded_max_error ignored rmse
  [ "$(json m.json passed) $(json m.json ignored) $(json m.json bounded_max_error_at)" = \
    "true 1 $(json s.json bounded_max_error_at)" ] || fail "simplify and measure differ about the bounded samples"
done
try "$scarp" measure spiked.tif flat.obj --fail-above 5
[ "$code" = 3 ] || fail "without the script the outlier passes"
succeeds "$scarp" measure spiked.tif flat.obj --fail-above 5 --script steps.txt
grep -q 'samples ignored  *1, without a bound' "$logs/out" && grep -q 'Passed: max error [0-4].* of the bounded samples' "$logs/out" ||
  fail "the table does not tell of the bounded samples"
try "$scarp" measure spiked.tif flat.obj --fail-above 0.01 --script steps.txt
[ "$code" = 3 ] || fail "a script switches the verdict off"
if grep -q 'at column 150, row 150' "$logs/err"; then fail "the ignored sample is blamed"; fi
# Tolerances, textures and images with a script: the outlier breaks nothing, and everything else is judged.
make_raster five.tif 5
make_image spots.tif '250 if (col, row) == (150, 150) else col // 4'
for more in '--tolerance five.tif' '-e 5 --texture spots.tif'; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify spiked.tif more.ply $more --script steps.txt --overwrite --report s.json
  # shellcheck disable=SC2086
  succeeds "$scarp" measure spiked.tif more.ply ${more#-e 5} --script steps.txt --fail-above 5 --json
  cp "$logs/out" m.json
  same max_error bounded_max_error ignored
  holds "$(json m.json max_error) > 500 && $(json m.json bounded_max_error) <= 5"
  # shellcheck disable=SC2086
  try "$scarp" measure spiked.tif more.ply ${more#-e 5} --fail-above 5
  [ "$code" = 3 ] || fail "without the script the outlier passes: $more"
done
succeeds "$scarp" simplify spots.tif spots.glb -e 6 --image --script steps.txt --report s.json --overwrite
succeeds "$scarp" measure spots.tif spots.glb --fail-above 6 --image --script steps.txt --json
cp "$logs/out" m.json
same combined_max_error bounded_max_error ignored
holds "$(json m.json combined_max_error) > 100 && $(json m.json bounded_max_error) <= 6"
# Weights of 0 are ignored as well.
succeeds "$scarp" simplify "$dem" masked.glb -e 20 --mask weights.tif --report s.json --overwrite
succeeds "$scarp" measure "$dem" masked.glb --mask weights.tif --json
cp "$logs/out" m.json
same max_error bounded_max_error

# A file on another grid is refused with a remedy.
gdal_translate -q -outsize 100 100 weights.tif small.tif
refuses 2 "--mask small.tif is 100 x 100 samples instead of 403 x 344" simplify -e 20 --mask small.tif
refuses 2 "first (gdalwarp -te -84.41375" simplify -e 20 --mask small.tif
gdal_translate -q -a_ullr 10 11 11 10 weights.tif moved.tif
refuses 2 "--tolerance moved.tif begins at" simplify --tolerance moved.tif
gdal_translate -q -a_srs EPSG:32616 -a_ullr 700000 4030000 736270 3999040 weights.tif utm.tif
refuses 2 "is in EPSG:32616 instead of EPSG:4326" simplify -e 20 --mask utm.tif
refuses 2 "gdalwarp -t_srs EPSG:4326" simplify -e 20 --mask utm.tif
make_raster negative.tif 'col - 5'
refuses 2 "--mask negative.tif: the value -5 at column 0, row 0 is negative" simplify -e 20 --mask negative.tif
refuses 2 "--tolerance negative.tif: the value -5" simplify --tolerance negative.tif
make_raster zeros.tif 0
refuses 2 "no weight is above 0" simplify -e 20 --mask zeros.tif
refuses 2 "--mask none.tif: no weight is above 0" simplify -e 20 --mask none.tif
refuses 2 "missing.tif" simplify -e 20 --mask missing.tif
make_raster holes.tif 'nan if col % 20 == row % 20 == 0 else row'
refuses 1 "or simplify the outline with --nodata-policy outline" "$scarp" simplify holes.tif x.obj -t 1
refuses 1 "--mask cannot be combined with --tolerance" simplify -e 20 --mask weights.tif --tolerance bounds.tif
refuses 1 "--mask cannot be combined with --tolerance" "$scarp" measure "$dem" t.glb --mask weights.tif --tolerance bounds.tif
refuses 1 "no goal is given" simplify --mask weights.tif
cp weights.tif copy.tif
refuses 1 "input file" simplify -e 20 --mask copy.tif --error-raster copy.tif --overwrite
for line in 'x 1 1' 's 1' 's one 2' 's 403 0' 'i 0 344' 's -1 0' 's 1.5 2'; do
  printf 's 1 1\n%s\n' "$line" > bad.txt
  refuses 2 "bad.txt: line 2" simplify -e 20 --script bad.txt
done
printf 'i 1 2\ns 3 4\ns 1 2\n' > bad.txt
refuses 2 "bad.txt: line 3: sample (1, 2) is inserted, but line 1 ignores it: remove one of the two" simplify -e 20 --script bad.txt
echo '# nothing' > nothing.txt
succeeds simplify -e 100 --script nothing.txt --overwrite
grep -q '^scarp: warning: --script nothing.txt holds no step' "$logs/err" || fail "no word about an empty script"
rm out.glb
refuses 2 "missing.txt" simplify -e 20 --script missing.txt
echo "masks, tolerances and scripts are kept"
