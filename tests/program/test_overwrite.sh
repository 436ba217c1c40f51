#!/usr/bin/env bash
# Existing files are unchanged unless --overwrite is given; then they are replaced as a whole.
source "$(dirname "$0")/lib.sh"

for name in out.glb p.png r.json m.png; do echo "mine" > "$name"; done
refuses 4 "out.glb exists already: --overwrite" "$scarp" simplify "$dem" out.glb -e 100
refuses 4 "p.png exists already" "$scarp" simplify "$dem" new.glb -e 100 --preview p.png
refuses 4 "r.json exists already" "$scarp" simplify "$dem" new.glb -e 100 --report r.json
# Refused before the work: the raster does not even exist.
refuses 4 "exists already" "$scarp" simplify missing.tif out.glb -e 100

succeeds "$scarp" simplify "$dem" out.glb -e 100 --preview p.png --report r.json --overwrite
for name in out.glb p.png r.json; do
  if grep -q mine "$name"; then fail "$name was not replaced"; fi
done
[ "$(head -c 4 out.glb)" = glTF ] || fail "out.glb is no GLB"
refuses 4 "m.png exists already" "$scarp" measure "$dem" out.glb --map m.png
succeeds "$scarp" measure "$dem" out.glb --map m.png --overwrite

# A failed run keeps the old file even with --overwrite.
cp out.glb before.glb
refuses 2 "missing.tif" "$scarp" simplify missing.tif out.glb -e 1 --overwrite
cmp out.glb before.glb

# A symbolic link is followed, and stays a link.
ln -s out.glb link.glb
succeeds "$scarp" simplify "$dem" link.glb -e 50 --overwrite
[ -L link.glb ] || fail "the link was replaced"
if cmp -s out.glb before.glb; then fail "the link's target was not written"; fi

# With data on standard output, the summary moves elsewhere.
"$scarp" simplify "$dem" /dev/stdout --of ply -e 100 2> "$logs/err" > piped.ply
grep -q '^Reached the error goal' "$logs/err" || fail "no summary on stderr"
succeeds "$scarp" simplify "$dem" file.ply -e 100
cmp piped.ply file.ply
[ -z "$(find . -name '.scarp-*')" ] || fail "a temporary file is left"
