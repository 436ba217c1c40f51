#!/usr/bin/env bash
# scarp tile plan, run and finish under faults: one message, an exit code, nothing lost, and the same set afterwards.
source "$(dirname "$0")/lib.sh"
need gdal_translate python3
few=(--vertical ellipsoid --cells 16 --effort fast --zoom 14)
gdal_translate -q -r bilinear -outsize 200% 200% -ot Float32 -a_srs EPSG:4979 -a_ullr 11.0 45.3 11.5 44.7 "$dem" land.tif
succeeds "$scarp" tile land.tif whole.pmtiles "${few[@]}" -q
succeeds "$scarp" tile plan land.tif plan.json "${few[@]}" -q

# has_block PARTS: a block is on disk.
has_block() { [ -n "$(find "$1" -name '*.part' -size +8k 2> /dev/null)" ]; }
finishes() {
  succeeds "$scarp" tile finish "$1" again.pmtiles --parts "$2" --overwrite -q
  cmp whole.pmtiles again.pmtiles || fail "another set: $3"
}

# Two concurrent processes make one share: the second begins at its end, and each block is stored once.
"$scarp" tile run plan.json --parts two -j 1 > one.out 2>&1 & first=$!
await $first has_block two
succeeds "$scarp" tile run plan.json --parts two -j 1
grep -q "another process made share 1 of 1" "$logs/err" || fail "nobody tells of the other process"
wait $first || fail "the first of two processes fails: $(cat one.out)"
finishes plan.json two "two processes on one share"

# The raster disappears or changes while its blocks are made.
for fault in "mv land.tif away.tif" "touch -d 2020-02-02 land.tif"; do
  rm -rf gone
  cp -p land.tif kept.tif
  "$scarp" tile run plan.json --parts gone -j 1 -q 2> said & process=$!
  await $process has_block gone
  $fault
  code=0
  wait $process || code=$?
  [ $code = 2 ] || fail "exit code $code after $fault"
  [ "$(wc -l < said)" = 1 ] && grep -q '^scarp: /.*/land.tif \(is not there any more\|has changed since\)' said || fail "$(cat said)"
  [ -z "$(find gone -name '*.part' -size -8k)" ] || fail "a part without a block is left"
  try "$scarp" tile run plan.json --parts gone -q
  [ "$code" = 2 ] || fail "a run without its raster"
  rm -f land.tif
  mv kept.tif land.tif
  succeeds "$scarp" tile run plan.json --parts gone
  grep -q " 0 there before" "$logs/out" && fail "blocks were lost"
  finishes plan.json gone "$fault"
done

# Parts that a crash of the machine truncated, or filled with zeros or old disk contents.
part=$(find gone -name '*.part' -printf '%s %p\n' | sort -rn | head -1 | cut -d' ' -f2)
cp -r gone good
for end in cut zeros noise head; do
  rm -r gone
  cp -r good gone
  case $end in
    cut) truncate -s -1000 "$part" ;;
    zeros) truncate -s -1000 "$part"; truncate -s +5000 "$part"; truncate -s +100k "$part" ;;
    noise) head -c 70000 land.tif | tail -c 5000 >> "$part" ;;
    head) truncate -s 17 "$part" ;;
  esac
  if [ $end = zeros ]; then
    # The last record has its full length but wrong contents: this is reported with the file.
    succeeds "$scarp" tile run plan.json --parts gone -q
    try "$scarp" tile finish plan.json no.pmtiles --parts gone
    [ "$code" = 2 ] && grep -q "$part is damaged: delete it" "$logs/err" || fail "$(cat "$logs/err")"
    [ ! -e no.pmtiles ] || fail "a set of a damaged part"
    rm "$part"
  fi
  succeeds "$scarp" tile run plan.json --parts gone -q
  finishes plan.json gone "a part's end: $end"
done

# Plans and parts of other versions.
sed 's/"scarp_tile_plan": [0-9]*/"scarp_tile_plan": 99/' plan.json > later.json
for command in "run later.json" "finish later.json no"; do
  refuses 2 "later.json is no plan of tiles of this version: make one first (scarp tile plan RASTER " "$scarp" tile $command
done
head -c 2000 plan.json > torn.json
refuses 2 "torn.json is no plan of tiles" "$scarp" tile run torn.json
rm -r gone
mv good gone
printf '\x63' | dd of="$part" bs=1 seek=8 conv=notrunc 2> /dev/null
refuses 2 "another version of scarp: delete it" "$scarp" tile run plan.json --parts gone

# A file-size limit, and a full disk if this user may mount one.
limited() { bash -c 'ulimit -f "$1"; shift; exec "$@"' - "$@"; }
try limited 400 "$scarp" tile run plan.json --parts limited -q
[ "$code" = 4 ] && [ "$(wc -l < "$logs/err")" = 1 ] && grep -q "cannot write limited/0001" "$logs/err" || fail "$code: $(cat "$logs/err")"
succeeds "$scarp" tile run plan.json --parts limited
grep -q " 0 there before" "$logs/out" && fail "blocks before the limit were lost"
finishes plan.json limited "after a limit"
refuses 4 "of set: " limited 4 "$scarp" tile finish plan.json set --parts limited
for output in set set.pmtiles set.mbtiles set.3tz; do
  [ $output = set ] || refuses 4 "set" limited 40 "$scarp" tile finish plan.json $output --parts limited
done
mkdir disk
if mount -t tmpfs -o size=1500k none disk 2> /dev/null; then
  trap 'cd /; umount "$root/run/disk"; rm -rf "$root"' EXIT
  try "$scarp" tile run plan.json --parts disk/parts -q
  [ "$code" = 4 ] && [ "$(wc -l < "$logs/err")" = 1 ] && grep -q "full" "$logs/err" || fail "$code: $(cat "$logs/err")"
  mount -o remount,size=100m disk
  succeeds "$scarp" tile run plan.json --parts disk/parts
  grep -q " 0 there before" "$logs/out" && fail "blocks before the full disk were lost"
  finishes plan.json disk/parts "after a full disk"
  mv disk/parts there
  mount -o remount,size=300k disk
  for output in set set.pmtiles set.mbtiles set.3tz; do
    refuses 4 "full" "$scarp" tile finish plan.json disk/$output --parts there
    refuses 4 "full" "$scarp" tile land.tif disk/$output "${few[@]}"
    [ -z "$(ls -A disk)" ] || fail "something is left on the full disk: $(ls -A disk)"
  done
else
  echo "no tmpfs here: only the file-size limit was tried"
fi
