#!/usr/bin/env bash
# The lines of docs/tiles.md that make a set with Dask, on a scheduler and two workers. One worker is killed.
source "$(dirname "$0")/../program/lib.sh"
need gdal_translate
"$python_program" -c 'import distributed' 2> /dev/null || skip "needs Debian's python3-distributed"

gdal_translate -q -r bilinear -outsize 200% 200% -ot Float32 -a_srs EPSG:4979 -a_ullr 11.0 45.3 11.5 44.7 "$dem" dem.tif
few=(--cells 16 --effort fast --zoom 14)
succeeds "$scarp" tile dem.tif whole.pmtiles "${few[@]}" -q
succeeds "$scarp" tile plan dem.tif world.json "${few[@]}" -q
# Eight shares instead of 200.
sed -n '/^    from distributed import Client$/,/^    subprocess.run.*finish/s/^    //p' "$SCARP_SOURCE/docs/tiles.md" |
  sed 's/200/8/; s/201/9/; s/"world"\]/"world.pmtiles"]/' > shares.py
[ "$(grep -c . shares.py)" = 6 ] || fail "docs/tiles.md has not the lines that are to run"

PATH=$(dirname "$scarp"):$PATH
export PATH
daemons=()
stop() {
  kill "${daemons[@]}" 2> /dev/null || true
  wait "${daemons[@]}" 2> /dev/null || true
}
ends=$(trap -p EXIT | sed "s/^trap -- '//; s/' EXIT$//")
trap 'stop; eval "$ends"' EXIT
"$python_program" -m distributed.cli.dask_scheduler --host 127.0.0.1 --port 0 --no-dashboard --scheduler-file scheduler.json > scheduler.log 2>&1 &
daemons+=($!)
for worker in 1 2; do
  "$python_program" -m distributed.cli.dask_worker --scheduler-file scheduler.json --nthreads 1 --nworkers 1 --no-dashboard \
    --local-directory "$PWD" --name "w$worker" > "w$worker.log" 2>&1 &
  daemons+=($!)
done

"$python_program" shares.py > shares.log 2>&1 & client=$!
# The process under the first worker's nanny dies once a block is on disk; the nanny starts another.
for _ in $(seq 1200); do
  if [ -n "$(find world.parts -name '*.part' -size +8k 2> /dev/null)" ]; then break; fi
  kill -0 $client 2> /dev/null || break
  sleep 0.05
done
for status in /proc/[0-9]*/status; do
  if grep -qs "^PPid:[[:space:]]*${daemons[1]}$" "$status" && grep -qsa "spawn_main" "${status%status}cmdline"; then
    kill -KILL "$(basename "${status%/status}")" 2> /dev/null || true
    echo killed >> killed
  fi
done
code=0
wait $client || code=$?
[ $code = 0 ] || fail "exit code $code: $(tail -5 shares.log w1.log w2.log)"
[ -s killed ] || fail "no worker was killed"
cmp whole.pmtiles world.pmtiles || fail "Dask makes other tiles"
