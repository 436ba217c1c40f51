#!/usr/bin/env bash
# --effort with textures, images and simplified outlines: fewer triangles, the same bounds on norms, and the same bytes
# on any number of threads.
source "$(dirname "$0")/lib.sh"
need python3 gdal_translate

waves='128 + 60 * math.sin(col / 17) * math.cos(row / 13)'
make_image photo.tif "$waves + 40 * math.sin(col * row / 4000)" "$waves" '60 + row // 4 + 30 * math.sin((col + row) / 9)'

# compare INPUT BOUND OPTION...: the mesh of each effort has fewer triangles and keeps its bound.
compare() {
  local input=$1 bound=$2 level last=fast
  shift 2
  for level in fast normal high; do
    succeeds "$scarp" simplify "$input" "$level.glb" -e "$bound" --effort "$level" "$@" --report "$level.json" --overwrite
    succeeds "$scarp" measure "$input" "$level.glb" --fail-above "$bound" "$@"
    holds "$(json "$level.json" combined_max_error) <= $bound * 1.000001"
    [ "$(json "$level.json" strategy effort) $(json "$level.json" strategy vertices)" = "\"$level\" \"samples\"" ] ||
      fail "the report tells $(json "$level.json" strategy)"
    [ $level = fast ] || holds "$(json "$level.json" triangles) < 0.9 * $(json $last.json triangles)"
    last=$level
  done
  holds "$(json normal.json triangles) < 0.7 * $(json fast.json triangles)"
}

compare photo.tif 12 --image
compare photo.tif 30 --image --norm l1
compare "$dem" 60 --texture photo.tif --texture-weight 0.3
compare "$dem" 60 --texture photo.tif --norm l2 --channel-weights 1,0,3

# It is the default, also for single bands, bounds of 0 and percentages.
succeeds "$scarp" simplify photo.tif default.glb -e 8 --image --report default.json
[ "$(json default.json strategy effort)" = '"normal"' ] || fail "the default effort of images is $(json default.json strategy effort)"
gdal_translate -q -srcwin 100 100 60 50 photo.tif crop.tif
succeeds "$scarp" simplify crop.tif exact.ply -e 0 --image --effort high
succeeds "$scarp" measure crop.tif exact.ply --image --fail-above 0
succeeds "$scarp" simplify photo.tif grey.ply -e 2% --image --band 2 --effort high --report grey.json
succeeds "$scarp" measure photo.tif grey.ply --image --band 2 --fail-above "$(json grey.json goal max_error)"

# Budgets reduce the norm; with textures, bounds of samples hold.
for level in fast normal high; do
  succeeds "$scarp" simplify photo.tif "$level.ply" -t 1000 --image --effort "$level" --report "$level.json" --overwrite
  holds "$(json "$level.json" triangles) <= 1000"
done
holds "$(json normal.json combined_max_error) < 0.9 * $(json fast.json combined_max_error)"
holds "$(json high.json combined_max_error) < $(json normal.json combined_max_error)"
make_raster falling.tif '40 + 100 * col / 402'
succeeds "$scarp" simplify "$dem" bounded.glb --tolerance falling.tif --texture photo.tif --effort high
succeeds "$scarp" measure "$dem" bounded.glb --tolerance falling.tif --texture photo.tif

# Simplified outlines, with and without free vertices; the surface is the same.
make_raster island.tif '200 + 100 * math.sin(col / 9) * math.cos(row / 11) if math.hypot(col - 201, row - 172) < 150 + 9 * math.sin(col / 9) else nan'
last=0
for level in fast "high --vertices samples" high normal; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify island.tif island.obj -e 4 --outline-tolerance 3 --effort $level --report island.json --overwrite
  succeeds "$scarp" measure island.tif island.obj --fail-above 4
  [ "$level" = fast ] && last=$(json island.json triangles)
  [ "$level" = fast ] || holds "$(json island.json triangles) < 0.85 * $last"
done
succeeds "$scarp" simplify island.tif default.obj -e 4 --outline-tolerance 3 --report default.json --overwrite
[ "$(json default.json strategy effort)" = '"normal"' ] || fail "normal is not the default with an outline tolerance"

for threads in 1 2 7; do
  succeeds "$scarp" simplify photo.tif "threads$threads.glb" -e 12 --image --effort high -j "$threads"
  cmp threads1.glb "threads$threads.glb" || fail "-j $threads makes another mesh"
done

refuses 1 "no value between samples" "$scarp" simplify photo.tif never.glb -e 8 --image --effort high --vertices free
refuses 1 "--vertices free cannot be combined with --texture" "$scarp" simplify "$dem" never.glb -e 60 --texture photo.tif --effort high --vertices free
refuses 1 "--edges data cannot be combined with --effort normal" "$scarp" simplify photo.tif never.glb -e 8 --image --effort normal --edges data
echo "efforts keep norms and simplified outlines"
