#!/usr/bin/env bash
# generate: reproducible synthetic rasters that read back unchanged; refusals.
source "$(dirname "$0")/lib.sh"
need python3 gdalinfo

for style in cliff step sharp-step diagonal-step sharp-diagonal-step parabola paraboloid scaled-paraboloid pyramid \
  diagonal-pyramid fractal smooth; do
  succeeds "$scarp" generate $style 60 40 $style.tif
  succeeds "$scarp" generate $style 60 40 again.tif --overwrite
  cmp $style.tif again.tif || fail "$style is not the same twice"
  succeeds "$scarp" info $style.tif --json
  cp "$logs/out" info.json
  [ "$(json info.json input cols)" = 60 ] && [ "$(json info.json input rows)" = 40 ] || fail "$style has another size"
  [ "$(json info.json input valid)" = 2400 ] || fail "$style has missing samples"
done

# genstm's letters; PGM has the same integer heights.
succeeds "$scarp" generate X 60 40 letter.pgm
succeeds "$scarp" generate X 60 40 letter.tif
cmp letter.tif sharp-step.tif || fail "X is not sharp-step"
succeeds "$scarp" simplify letter.pgm pgm.ply -e 0 --crs grid
succeeds "$scarp" measure letter.tif pgm.ply --crs grid --fail-above 0

# Seed, range, size.
succeeds "$scarp" generate fractal 60 40 other.tif --seed 1 --range 250 --size 30
if cmp -s other.tif fractal.tif; then fail "the seed changes nothing"; fi
succeeds "$scarp" generate smooth 60 40 waves.tif --seed 1
if cmp -s waves.tif smooth.tif; then fail "the seed does not change the smooth field"; fi
succeeds "$scarp" info other.tif --json
cp "$logs/out" info.json
[ "$(json info.json input max)" = 250.0 ] && [ "$(json info.json input min)" = 0.0 ] || fail "--range 250 is not kept"
[ "$(json info.json input cell_x)" = 30.0 ] || fail "--size 30 is not kept"
gdalinfo other.tif | grep -q 'Lower Left  ( *0.0000000, *0.0000000)' || fail "the lower left corner is not 0, 0"
succeeds "$scarp" generate cliff 8 8 quiet.pgm -q
[ ! -s "$logs/out" ] && [ ! -s "$logs/err" ] || fail "-q is not quiet"
succeeds "$scarp" generate cliff 8 8 /dev/stdout --of pgm
head -c 2 "$logs/out" | grep -q P5 || fail "no raster on stdout"

refuses 1 'STYLE hills is unknown' "$scarp" generate hills 8 8 x.tif
refuses 1 'COLS 1 is not' "$scarp" generate cliff 1 8 x.tif
refuses 1 'ROWS many is not' "$scarp" generate cliff 8 many x.tif
refuses 1 'COLS 70000 is above 65536' "$scarp" generate cliff 70000 8 x.tif
refuses 1 'at most 1073741824 samples' "$scarp" generate cliff 60000 60000 x.tif
refuses 1 '--seed is for fractal and smooth only' "$scarp" generate cliff 8 8 x.tif --seed 2
refuses 1 '--range 0 is not above 0' "$scarp" generate cliff 8 8 x.tif --range 0
refuses 1 '--size needs a GeoTIFF' "$scarp" generate cliff 8 8 x.pgm --size 2
refuses 1 'tells no format' "$scarp" generate cliff 8 8 x.stm
refuses 1 '--of png is unknown' "$scarp" generate cliff 8 8 x.png --of png
refuses 4 'exists already' "$scarp" generate cliff 8 8 cliff.tif
refuses 4 'there is no folder' "$scarp" generate cliff 8 8 nowhere/x.tif
refuses 4 'x.pgm' "$scarp" generate paraboloid 600 600 x.pgm
