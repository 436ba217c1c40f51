#!/usr/bin/env bash
# The same bytes from every run, independent of threads, folder, name and other outputs.
source "$(dirname "$0")/lib.sh"
need gdal_translate

# A raster with nodata and a bound that requires some thousand vertices.
gdal_translate -q -a_nodata 300 "$dem" holes.tif
for format in glb obj ply stl; do
  mkdir "$format"
  for input in "$dem" holes.tif; do
    name=$(basename "$input" .tif)
    first=$format/$name.1.$format
    succeeds "$scarp" simplify "$input" "$first" -e 20 -j 1
    for threads in 2 7 0; do
      succeeds "$scarp" simplify "$input" "$format/$name.$threads.$format" -e 20 -j "$threads"
      cmp "$first" "$format/$name.$threads.$format" || fail "$threads threads change $format"
    done
    succeeds "$scarp" simplify "$input" "$format/$name.again.$format" -e 20 -q --report "$format/$name.json" --json-progress
    cmp "$first" "$format/$name.again.$format" || fail "a second run or another output changes $format"
  done
done
# Every instruction set; unsupported names are ignored.
for kernel in scalar ssse3 sse4 avx2 avx3 neon unknown; do
  SCARP_KERNEL=$kernel succeeds "$scarp" simplify holes.tif "kernel.$kernel.glb" -e 20
  cmp glb/holes.1.glb "kernel.$kernel.glb" || fail "the instruction set $kernel changes the mesh"
  SCARP_KERNEL=$kernel "$scarp" measure holes.tif glb/holes.1.glb --json |
    grep -v -e '"read"' -e '"measure"' -e '"total"' > "judged.$kernel"
  cmp judged.scalar "judged.$kernel" || fail "the instruction set $kernel changes the verdict"
done
# Another folder, a relative path, the format by --of.
mkdir elsewhere
cp "$dem" elsewhere/
(cd elsewhere && succeeds "$scarp" simplify jacksboro_fault.tif mesh -e 20 --of glb)
cmp glb/jacksboro_fault.1.glb elsewhere/mesh || fail "the folder or --of changes the bytes"
# Options that add content.
for options in "--normals" "--crs EPSG:32616" "--crs source" "-t 3000" "-p 900"; do
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify "$dem" a.glb -e 20 $options -j 1 --overwrite
  # shellcheck disable=SC2086
  succeeds "$scarp" simplify "$dem" b.glb -e 20 $options -j 7 --overwrite
  cmp a.glb b.glb || fail "threads change the bytes with $options"
done
succeeds "$scarp" simplify "$dem" a.stl -e 20 --base 0 -j 1
succeeds "$scarp" simplify "$dem" b.stl -e 20 --base 0 -j 7
cmp a.stl b.stl || fail "threads change the solid"
# Also the judge and the pictures.
for threads in 1 7; do
  "$scarp" measure "$dem" a.glb --json --map "map.$threads.png" -j "$threads" |
    grep -v -e '"command"' -e '"read"' -e '"measure"' -e '"total"' > "judged.$threads"
  succeeds "$scarp" simplify "$dem" p.glb -e 20 -j "$threads" --preview "preview.$threads.png" --overwrite
done
cmp judged.1 judged.7
cmp map.1.png map.7.png
cmp preview.1.png preview.7.png
