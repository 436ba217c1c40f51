#!/usr/bin/env bash
# paper: the experiments on small rasters; the same page twice, every picture that it names, refusals.
source "$(dirname "$0")/lib.sh"

mkdir rasters empty
succeeds "$scarp" generate fractal 100 90 rasters/hills.tif --seed 5
succeeds "$scarp" generate sharp-step 60 70 rasters/step.pgm

# gnuplot is searched for first.
mkdir bin
refuses 4 'install the Debian package gnuplot-nox' env PATH="$scratch/bin" "$scarp" paper --data rasters --out out
need gnuplot

refuses 2 'is not a folder' "$scarp" paper --data nowhere --out out
refuses 2 'holds no raster' "$scarp" paper --data empty --out out -q

if [ -d /proc ]; then refuses 4 '/proc/x' "$scarp" paper --data rasters --out /proc/x; fi  # before any experiment
succeeds "$scarp" paper --data rasters --out out --no-timing
grep -q '^paper: ' "$logs/err" || fail "nothing tells what is being done"
succeeds "$scarp" paper --data rasters --out out/again --no-timing -q
[ ! -s "$logs/err" ] && [ ! -s "$logs/out" ] || fail "-q is not quiet"
cmp out/paper.md out/again/paper.md || fail "two runs write different pages"
for picture in illustration edges surfaces; do
  cmp out/images/paper/$picture.png out/again/images/paper/$picture.png || fail "two runs draw different pictures"
  [ "$(wc -c < out/images/paper/$picture.png)" -gt 5000 ] || fail "$picture.png shows nothing"
done
refuses 4 'exists already' "$scarp" paper --data rasters --out out --no-timing -q

for heading in 'A field and its TIN (figures 1 and 2)' 'What is worth inserting (section 3' 'Algorithms I, II and III (section 4, page' \
  'The cost of Algorithm III (section 4, page' 'Insertion in batches (section 4' \
  'Data-dependent triangulation, Algorithm IV (section 4.4, page' 'Supersampling' 'Swaps over the whole mesh' 'Meshes and surfaces' \
  'Fields curved in one direction' 'Results (section 5, page' 'Error against vertices' 'Delaunay and data-dependent edges against vertices'; do
  grep "^##" out/paper.md | grep -qF "$heading" || fail "the page has no section $heading"
done
if grep -qi 'measured once' out/paper.md; then fail "--no-timing leaves times"; fi
if grep -qE '\b(nan|inf)\b' out/paper.md; then fail "a number is none"; fi
for picture in $(grep -oE 'images/paper/[a-z_]+\.png' out/paper.md); do
  head -c 8 "out/$picture" | tail -c 7 | grep -q '^PNG' || fail "$picture is no picture"
done
[ "$(grep -c '^!\[' out/paper.md)" -ge 5 ] || fail "hardly any picture"
grep -q '| hills |' out/paper.md && grep -q '| step |' out/paper.md || fail "a raster is missing"

# Rasters of one's own are compared with Scape on the synthetic fields alone, and tiny ones have no bytes a vertex.
head=$(sed '/Fields curved in one direction/,$d' out/paper.md)
if grep -qE '64-bit build|Scape.s by|\*Scape\*|Crater' <<< "$head"; then fail "figures of Scape without its fields"; fi
succeeds "$scarp" paper --data rasters --out timed -q
if grep -qE 'bytes a vertex|64-bit build|workstation' timed/paper.md; then fail "memory or claims of other fields"; fi
grep -qE '^\*Measured once, on the machine that wrote this page \([0-9]{4}-[0-9]{2}-[0-9]{2}, .*logical' timed/paper.md ||
  fail "seconds without a machine and a date"
grep -qE '^\| hills \| 90 \| [0-9]+\.[0-9]{3} \|' timed/paper.md || fail "no seconds for hills"

grep -q '^- Attenuated against plain global error: RMS ' out/paper.md || fail "the attenuated error is not compared"

# Both views of the same insertion: settled swaps never raise the RMS, and a cell far from Scape's is explained.
awk -F'|' '/^### Swaps over/ { on = 1 } /^### Meshes/ { on = 0 }
  on && $3 + 0 > 0 { rows++; if ($4 + 0 > $3 + 0 || $6 + 0 > $5 + 0) bad = 1 } END { exit !(rows >= 5 && !bad) }' out/paper.md ||
  fail "settled swaps raise an error"
tr '\n' ' ' < out/paper.md | grep -qE '\*\*Max error of sharp-step, sum, q 0 \(−[0-9]+ %\)' || fail "sharp-step is not explained"

# A row of the reference table is what simplify makes.
grep -qE '^\| hills \| 90 \|' out/paper.md || fail "no row for 1 % of hills"
grep -q 'yes |$' out/paper.md || fail "Algorithms I, II and III disagree"

# The paper's fields are known by name, and then nothing else is read.
cp rasters/step.pgm rasters/scape_ozark.pgm
cp rasters/hills.tif rasters/crater.tif
succeeds "$scarp" paper --data rasters --out named --no-timing -q
grep -q '| ozark |' named/paper.md || fail "scape_ozark.pgm is not found"
grep -qE '^\| crater \| 1542 \| Terra 0.7 \| 24.25 \| 7.058 \|' named/paper.md || fail "no cross-check with Terra"
if grep -q '| hills |' named/paper.md; then fail "other rasters are read beside the paper's"; fi
