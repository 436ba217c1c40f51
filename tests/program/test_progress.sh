#!/usr/bin/env bash
# Progress of a run: nothing if it is quick or unwatched, a line on a terminal, JSON on request.
source "$(dirname "$0")/lib.sh"
need python3
make_big_raster big.tif

succeeds "$scarp" simplify big.tif out.glb -e 40
[ ! -s "$logs/err" ] || fail "progress although stderr is no terminal"

# -q prints nothing at all.
succeeds "$scarp" simplify big.tif out.glb -e 40 -q --overwrite
[ ! -s "$logs/err" ] && [ ! -s "$logs/out" ] || fail "-q is not quiet"

# JSON: one object a line, at most five a second plus one at the end of each pass; fractions never decrease in a pass.
succeeds "$scarp" simplify big.tif out.glb -e 40 --json-progress --overwrite
python3 - "$logs/err" <<'PYTHON'
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
assert lines, "no progress"
passes, last = [], None
for line in lines:
    assert list(line) == ["pass", "fraction", "vertices", "max_error", "seconds"], line
    assert 0 <= line["fraction"] <= 1
    if not passes or passes[-1] != line["pass"]:
        assert last is None or last["fraction"] == 1, f"{last} does not end its pass"
        passes.append(line["pass"])
    elif last["fraction"] < 1:
        assert line["fraction"] >= last["fraction"], (last, line)
    if last:
        assert line["seconds"] >= last["seconds"]
    last = line
assert last["fraction"] == 1, last
assert passes[-4:] == ["refine", "fit", "measure", "write"], passes
assert any(line["vertices"] > 0 for line in lines), "no vertices"
running = [line for line in lines if line["fraction"] < 1]
assert len(running) <= 5 * lines[-1]["seconds"] + 1, "more than five a second"
PYTHON

# A terminal: a line that is rewritten, and erased at the end.
if command -v script > /dev/null; then
  # The line appears after a second; a fast machine needs a smaller error to run that long.
  for error in 5 1 0.2 0; do
    script -qec "'$scarp' simplify big.tif out.glb -e $error --order greedy --overwrite" typescript < /dev/null > /dev/null
    if grep -aq 'refine.*%.*vertices' typescript; then break; fi
  done
  grep -aq 'refine.*%.*vertices' typescript || fail "no progress on a terminal"
  grep -aq 'Reached the error goal' typescript || fail "no summary on a terminal"
  script -qec "'$scarp' simplify '$dem' out.glb -e 100 --report quick.json --overwrite" typescript < /dev/null > /dev/null
  # A busy machine may be slower, and then show it.
  if awk "BEGIN { exit !($(json quick.json seconds total) < 1) }" && grep -aq 'vertices.*left' typescript; then
    fail "progress for a run below one second"
  fi
  script -qec "'$scarp' simplify big.tif out.glb -e 40 --overwrite -q" typescript < /dev/null > /dev/null
  if grep -aq '%' typescript; then fail "progress on a terminal in spite of -q"; fi
fi
