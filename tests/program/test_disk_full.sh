#!/usr/bin/env bash
# A full disk and a file-size limit: exit code 4, one message, no partial file.
source "$(dirname "$0")/lib.sh"

# 8 blocks of 1024 bytes: less than these files need. The logs of the test stay below it.
limited() { bash -c 'ulimit -f 8; exec "$@"' - "$@"; }
for format in glb obj ply stl 2dm vtu xml dxf gpkg; do
  refuses 4 "out.$format" limited "$scarp" simplify "$dem" "out.$format" -e 20
done
refuses 4 "out.tif" limited "$scarp" simplify "$dem" out.tif -e 20
# Rows that are written while samples stay in their file.
if command -v gdal_translate > /dev/null; then
  gdal_translate -q -r cubic -ot Float32 -co TILED=YES -outsize 300% 300% "$dem" tall.tif
  refuses 4 "errors.tif" limited "$scarp" simplify tall.tif out.obj -p 100 --error-raster errors.tif --memory 75M -q
  refuses 4 "out.tif" limited "$scarp" simplify tall.tif out.tif -p 100 --memory 75M -q
  rm tall.tif
fi
echo mine > old.glb
refuses 4 "old.glb" limited "$scarp" simplify "$dem" old.glb -e 20 --overwrite

# The first file fits and the second does not: they belong together, so both are removed.
try limited "$scarp" simplify "$dem" tiny.ply -p 20 --preview big.png
[ "$code" = 4 ] || fail "exit code $code instead of 4 for the preview"
[ "$(wc -l < "$logs/err")" = 1 ] || fail "not one line on stderr"
grep -q big.png "$logs/err" || fail "the sentence does not name the preview"
[ "$(find . -type f | sort | tr '\n' ' ')" = "./old.glb " ] || fail "files are left: $(find . -type f)"

# A tiny file system, if this user may mount one.
mkdir disk
if mount -t tmpfs -o size=64k none disk 2> /dev/null; then
  trap 'cd /; umount "$root/run/disk"; rm -rf "$root"' EXIT
  for format in glb obj ply stl 2dm vtu xml dxf gpkg; do
    refuses 4 "full" "$scarp" simplify "$dem" "disk/out.$format" -e 10
  done
  [ -z "$(ls -A disk)" ] || fail "something is left on the full disk"
else
  echo "no tmpfs here: only the file-size limit was tried"
fi
