#!/usr/bin/env bash
# scarp tile: changing sources (--changed-since, --hash), and parts of a globe (--only).
source "$(dirname "$0")/lib.sh"
need gdal_translate python3
few=(--vertical ellipsoid --cells 16 --effort fast --zoom 15)
hills='400 + 60 * math.sin(col / 9) * math.cos(row / 13) + (col * 7 + row * 3) % 5'
make_raster before.tif "$hills"
make_raster after.tif "400 if 300 < col < 330 and 40 < row < 60 else $hills"
made() { sed -n 's/.*: \([0-9]*\) blocks\? made.*/\1/p' "$logs/out"; }
there() { sed -n 's/.* made, \([0-9]*\) there before.*/\1/p' "$logs/out"; }
same() { sed -n 's/.* before, \([0-9]*\) of the same nodes.*/\1/p' "$logs/out"; }

cp before.tif land.tif
succeeds "$scarp" tile land.tif first "${few[@]}" -q
succeeds "$scarp" tile land.tif first.pmtiles "${few[@]}" -q --json-progress
# Progress ends with all tiles and bytes, and no time left.
python3 - "$logs/err" "$(find first -name '*.terrain' | wc -l)" "$(find first -name '*.terrain' -printf '%s\n' | awk '{ n += $1 } END { print n }')" <<'PYTHON'
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
last = [line for line in lines if line["pass"] == "tiles"][-1]
assert (last["tiles"], last["bytes"]) == (int(sys.argv[2]), int(sys.argv[3])), last
assert last["fraction"] == 1 and last["seconds_left"] == 0, last
PYTHON
succeeds "$scarp" tile plan land.tif a.json "${few[@]}" -q
succeeds "$scarp" tile run a.json
blocks=$(made)
holds "$blocks > 8"
succeeds "$scarp" tile finish a.json set.pmtiles --report r.json
grep -q "took/planned   tiles [01]" "$logs/out" || fail "the summary does not compare the plan with what it took"
for what in tiles bytes parts; do holds "$(json r.json model $what ratio) > 0.5 && $(json r.json model $what ratio) < 2"; done
holds "$(json r.json model core_seconds took) > 0 && $(json r.json model memory took) > 1e7"
cmp first.pmtiles set.pmtiles || fail "the parts make another set"

# A corner changes: only its blocks are made again, and the set equals one made from the new raster.
cp after.tif land.tif
refuses 2 "plan again" "$scarp" tile run a.json
succeeds "$scarp" tile plan land.tif b.json --changed-since a.json -q
[ ! -e b.parts ] || fail "parts of its own"
refuses 2 "blocks are not in" "$scarp" tile finish b.json no
succeeds "$scarp" tile run b.json --shard 1/2
succeeds "$scarp" tile run b.json --shard 2/2
succeeds "$scarp" tile run b.json
[ "$(there)" = "$blocks" ] || fail "the second run of a plan makes blocks again"
succeeds "$scarp" tile finish b.json set.pmtiles --overwrite -q
succeeds "$scarp" tile land.tif whole.pmtiles "${few[@]}" -q
cmp whole.pmtiles set.pmtiles || fail "blocks that were kept make another set"
cmp -s first.pmtiles set.pmtiles && fail "the set is the same"
records=$(find a.parts -name '*.part' | wc -l)
[ "$records" = 3 ] || fail "$records parts instead of 3"

# A new time on the same file: nothing is made; then the original state.
touch land.tif
succeeds "$scarp" tile plan land.tif c.json --changed-since b.json -q
succeeds "$scarp" tile run c.json
[ "$(made)" = 0 ] && [ "$(same)" = "$blocks" ] || fail "a new time alone makes tiles: $(cat "$logs/out")"
cp before.tif land.tif
succeeds "$scarp" tile plan land.tif d.json --changed-since c.json -q
succeeds "$scarp" tile run d.json
[ "$(made)" = 0 ] || fail "blocks of an earlier time are made again"
succeeds "$scarp" tile finish d.json back.pmtiles -q
cmp first.pmtiles back.pmtiles || fail "back to the first raster"

# By content: a copy with another time is the same file; an edit that preserves size and time is a change.
cp before.tif seen.tif
touch -d 2020-02-02 seen.tif
succeeds "$scarp" tile plan seen.tif e.json "${few[@]}" --hash content -q
succeeds "$scarp" tile run e.json -q
touch seen.tif
succeeds "$scarp" tile plan seen.tif f.json --changed-since e.json --hash content -q
succeeds "$scarp" tile run f.json
[ "$(there)" = "$blocks" ] || fail "the same content counts as another"
cp after.tif seen.tif
touch -d 2020-02-02 seen.tif
succeeds "$scarp" tile plan seen.tif g.json --changed-since e.json --hash content -q
succeeds "$scarp" tile run g.json
again=$(made)
holds "$again >= 1 && $again < $blocks / 2"
[ $((again + $(same))) = "$blocks" ] || fail "not all blocks are accounted for"
succeeds "$scarp" tile finish g.json hashed.pmtiles -q
cp after.tif seen.tif
succeeds "$scarp" tile seen.tif anew.pmtiles "${few[@]}" -q
cmp anew.pmtiles hashed.pmtiles || fail "an edit that keeps size and time"

# Impossible requests.
refuses 1 "does not go with --changed-since" "$scarp" tile plan land.tif no.json --changed-since a.json --effort high
refuses 2 "cannot read missing.json" "$scarp" tile plan land.tif no.json --changed-since missing.json
make_raster high.tif "1900 if col == 5 and row == 5 else $hills"
refuses 1 "make the set anew" "$scarp" tile plan high.tif no.json --changed-since a.json
refuses 1 "--hash" "$scarp" tile plan land.tif no.json "${few[@]}" --hash md5

# Only a box: its blocks' tiles equal those of the whole set.
box=-84.28,36.25,-84.2,36.3
succeeds "$scarp" tile land.tif few "${few[@]}" --only "$box" -q
tiles=$(find few/15 -name '*.terrain' | wc -l)
holds "$tiles > 10 && $tiles < $(find first/15 -name '*.terrain' | wc -l)"
for tile in $(cd few && find 10 11 12 13 14 15 -name '*.terrain'); do
  [ "$(stat -c %s "few/$tile")" -lt 200 ] || cmp "few/$tile" "first/$tile" || fail "$tile is another tile"
done
succeeds "$scarp" tile plan land.tif h.json "${few[@]}" -q
succeeds "$scarp" tile run h.json --only "$box"
some=$(made)
holds "$some >= 1 && $some < $blocks"
succeeds "$scarp" tile run h.json
[ "$(there)" = "$some" ] || fail "blocks of the box are made again"
succeeds "$scarp" tile finish h.json rest.pmtiles -q
cmp first.pmtiles rest.pmtiles || fail "first a box and then the rest"
for wrong in 1,2,3 1,2,3,4,5 a,b,c,d 1,5,2,4; do refuses 1 "--only" "$scarp" tile run h.json --only $wrong; done
refuses 1 "nothing in that box" "$scarp" tile land.tif no "${few[@]}" --only 10,10,11,11

# A survey finds the blocks with heights and divides shares by it; the set is the same.
make_raster corner.tif "$hills if col > 300 and row > 100 else nan"
succeeds "$scarp" tile corner.tif corner.pmtiles "${few[@]}" -q
succeeds "$scarp" tile plan corner.tif s.json "${few[@]}" --survey
found=$(sed -n 's/.*survey  *\([0-9]*\) blocks\? with heights, \([0-9]*\) without/\1 \2/p' "$logs/out")
read -r with without <<< "$found"
holds "$with >= 1 && $with <= 4 && $with + $without == $blocks"
[ "$(python3 -c 'import json; costs = json.load(open("s.json"))["costs"]; print(sum(c > 1 for c in costs), max(costs) <= 1001)')" = "$with True" ] || fail "the plan's costs"
for shard in 3/3 1/3 2/3; do succeeds "$scarp" tile run s.json --shard $shard -q; done
succeeds "$scarp" tile finish s.json surveyed.pmtiles -q
cmp corner.pmtiles surveyed.pmtiles || fail "a survey makes another set"
