#!/usr/bin/env bash
# paper: the experiments on small rasters; the same page twice, every picture that it names, refusals.
source "$(dirname "$0")/lib.sh"

mkdir rasters empty
succeeds "$scarp" generate fractal 100 90 rasters/hills.tif --seed 5
succeeds "$scarp" generate sharp-step 60 70 rasters/step.pgm

# gnuplot is looked for first.
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
refuses 4 'exists already' "$scarp" paper --data rasters --out out --no-timing -q

for heading in 'What is worth inserting' 'Algorithms I, II and III' 'The cost of Algorithm III' 'Insertion in batches' \
  'Data-dependent triangulation, Algorithm IV' 'Fields curved in one direction' 'Results' 'Error against vertices'; do
  grep -qF "$heading" out/paper.md || fail "the page has no section $heading"
done
if grep -qi 'measured once' out/paper.md; then fail "--no-timing leaves times"; fi
if grep -qE '\b(nan|inf)\b' out/paper.md; then fail "a number is none"; fi
for picture in $(grep -oE 'images/paper/[a-z_]+\.png' out/paper.md); do
  head -c 8 "out/$picture" | tail -c 7 | grep -q '^PNG' || fail "$picture is no picture"
done
[ "$(grep -c '^!\[' out/paper.md)" -ge 5 ] || fail "hardly any picture"
grep -q '| hills |' out/paper.md && grep -q '| step |' out/paper.md || fail "a raster is missing"

# A row of the reference table is what simplify makes.
grep -qE '^\| hills \| 90 \|' out/paper.md || fail "no row for 1 % of hills"
grep -q 'yes |$' out/paper.md || fail "Algorithms I, II and III disagree"

# The paper's fields are known by name, and then nothing else is read.
cp rasters/step.pgm rasters/scape_ozark.pgm
succeeds "$scarp" paper --data rasters --out named --no-timing -q
grep -q '| ozark |' named/paper.md || fail "scape_ozark.pgm is not found"
if grep -q '| hills |' named/paper.md; then fail "other rasters are read beside the paper's"; fi
