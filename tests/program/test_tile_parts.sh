#!/usr/bin/env bash
# scarp tile plan, run and finish: shares in any order, killed and restarted, make the set of scarp tile.
source "$(dirname "$0")/lib.sh"
need gdal_translate gdalwarp

# A few blocks: a raster in the middle of four blocks of level 6, with nodata at its ends.
succeeds gdal_translate -q -a_srs EPSG:4979 -a_ullr 11.0 45.3 11.5 44.7 "$dem" placed.tif
succeeds "$scarp" tile placed.tif whole -q
succeeds "$scarp" tile plan placed.tif plan.json --slurm run.sh
grep -q "4 blocks" "$logs/out" || fail "the plan does not tell its blocks"
bash -n run.sh || fail "the script is none"

refuses 2 "blocks are not in" "$scarp" tile finish plan.json no
[ ! -e no ] || fail "a set without its blocks"
for shard in 5/7 1/7 7/7 2/7 6/7 3/7 4/7; do succeeds "$scarp" tile run plan.json --shard $shard -j 1 -q; done
succeeds "$scarp" tile run plan.json --shard 2/3
grep -q " 0 blocks made" "$logs/out" || fail "blocks are made again"
succeeds "$scarp" tile finish plan.json set --report r.json
diff -r whole set || fail "7 shares make other tiles"
[ "$(json r.json levels 10 tiles)" -gt 8 ] || fail "no tiles in the report"

# Killed repeatedly: blocks on disk are kept and not made again.
succeeds "$scarp" tile plan placed.tif killed.json -q
for seconds in 0.2 0.4 0.6 0.8; do
  timeout -s KILL $seconds "$scarp" tile run killed.json -j 2 -q && break
done
before=$(find killed.parts -name '*.part' -size +1k 2>/dev/null | wc -l)
succeeds "$scarp" tile run killed.json -j 1
succeeds "$scarp" tile finish killed.json killed
diff -r whole killed || fail "a run that was killed makes other tiles ($before parts before)"

# A torn record is made again; a damaged one is detected.
rm -r killed
part=$(find killed.parts -name '*.part' -printf '%s %p\n' | sort -rn | head -1 | cut -d' ' -f2)
truncate -s -1000 "$part"
refuses 2 "are not in" "$scarp" tile finish killed.json killed
succeeds "$scarp" tile run killed.json
succeeds "$scarp" tile finish killed.json killed
diff -r whole killed || fail "after a torn record"
printf 'damage' | dd of="$part" bs=1 seek=5000 conv=notrunc 2>/dev/null
refuses 2 "is damaged" "$scarp" tile finish killed.json again

# Parts of another plan, another raster, no plan.
succeeds "$scarp" tile plan placed.tif other.json --effort fast -q
refuses 2 "another plan" "$scarp" tile run other.json --parts plan.parts
cp placed.tif moved.tif
succeeds "$scarp" tile plan moved.tif moved.json -q
touch moved.tif
refuses 2 "plan again" "$scarp" tile run moved.json
echo '{}' > none.json
refuses 2 "no plan of tiles" "$scarp" tile run none.json
refuses 1 "--shard" "$scarp" tile run plan.json --shard 3
refuses 1 "no such share" "$scarp" tile run plan.json --shard 4/3
refuses 1 "at least 1" "$scarp" tile run plan.json --shard 0/3
refuses 4 "--overwrite" "$scarp" tile plan placed.tif plan.json
refuses 4 "--overwrite" "$scarp" tile finish plan.json set

# A raster that stays in its file gives the same tiles.
succeeds "$scarp" tile run plan.json --parts streamed --memory 100k -q
succeeds "$scarp" tile finish plan.json streamed_set --parts streamed -q
diff -r whole streamed_set || fail "a streamed raster makes other tiles"
