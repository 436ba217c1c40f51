#!/usr/bin/env bash
# Ctrl-C: exit code 5, one sentence, and no file, half or whole.
source "$(dirname "$0")/lib.sh"
make_big_raster big.tif

# Interrupts COMMAND after the given seconds; its exit code goes to $code.
interrupt_after() {
  local signal=$1 seconds=$2 pid
  shift 2
  # A background job of a script ignores SIGINT unless job control is on.
  set -m
  "$@" > "$logs/out" 2> "$logs/err" &
  pid=$!
  set +m
  sleep "$seconds"
  kill "-$signal" "$pid" 2> /dev/null || fail "the run ended by itself before $seconds s"
  code=0
  wait "$pid" || code=$?
}

for signal in INT TERM HUP; do
  for seconds in 0.2 1 2; do
    interrupt_after "$signal" "$seconds" "$scarp" simplify big.tif out.glb -e 0 --preview p.png --report r.json
    [ "$code" = 5 ] || fail "exit code $code instead of 5 after $signal at $seconds s"
    [ "$(wc -l < "$logs/err")" = 1 ] || fail "not one line on stderr after $signal at $seconds s"
    grep -q '^scarp: interrupted; nothing was written$' "$logs/err" || fail "the sentence is missing"
    [ ! -s "$logs/out" ] || fail "something on stdout"
    [ "$(find . -type f)" = ./big.tif ] || fail "files are left: $(find . -type f)"
  done
done

# The second signal does not wait for the run to notice the first; it may still come too late to matter.
for wait in 0 0.01 0.05; do
  set -m
  "$scarp" simplify big.tif out.glb -e 0 > "$logs/out" 2> "$logs/err" &
  pid=$!
  set +m
  sleep 1
  kill -INT "$pid"
  sleep "$wait"
  kill -INT "$pid" 2> /dev/null || true
  code=0
  wait "$pid" 2> /dev/null || code=$?
  [ "$code" = 5 ] || [ "$code" = 130 ] || fail "exit code $code after two signals"
  [ "$(find . -type f)" = ./big.tif ] || fail "files are left after two signals: $(find . -type f)"
done

# An old file survives.
echo mine > out.glb
interrupt_after INT 1 "$scarp" simplify big.tif out.glb -e 0 --overwrite
[ "$code" = 5 ] || fail "exit code $code instead of 5 with --overwrite"
[ "$(cat out.glb)" = mine ] || fail "the old file is gone"
[ "$(find . -type f | sort | tr '\n' ' ')" = "./big.tif ./out.glb " ] || fail "files are left"

# measure and info stop as well.
succeeds "$scarp" simplify "$dem" small.obj -e 1
interrupt_after INT 0.3 "$scarp" info big.tif
[ "$code" = 5 ] || [ "$code" = 0 ] || fail "info ends with $code"
