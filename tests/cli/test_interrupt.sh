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
  for seconds in 0.2 1 $([ $signal != INT ] || echo 2); do
    interrupt_after "$signal" "$seconds" "$scarp" simplify big.tif out.glb -e 0 --preview p.png --report r.json
    [ "$code" = 5 ] || fail "exit code $code instead of 5 after $signal at $seconds s"
    [ "$(wc -l < "$logs/err")" = 1 ] || fail "not one line on stderr after $signal at $seconds s"
    grep -q '^scarp: interrupted; nothing was written$' "$logs/err" || fail "the sentence is missing"
    [ ! -s "$logs/out" ] || fail "something on stdout"
    [ "$(find . -type f)" = ./big.tif ] || fail "files are left: $(find . -type f)"
  done
done

# Even what arrives while libraries make themselves ready, before main(); sanitizers are not ready then themselves.
if [ "$(uname)" = Linux ] && command -v cc > /dev/null && bash -c 'ulimit -v 1000000; exec "$1" --version' - "$scarp" > /dev/null 2>&1; then
  printf '#include <signal.h>\n__attribute__((constructor)) static void first(void) { raise(SIGINT); }\n' > "$logs/early.c"
  cc -shared -fPIC -o "$logs/early.so" "$logs/early.c"
  try env LD_PRELOAD="$logs/early.so" "$scarp" simplify big.tif out.glb -e 0
  [ "$code" = 5 ] || fail "exit code $code instead of 5 where the signal comes before main()"
  grep -q '^scarp: interrupted; nothing was written$' "$logs/err" || fail "the sentence is missing before main()"
fi

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

# A long effort ends with the mesh so far, but stops without one as long as there is none, and where there is a budget.
succeeds "$scarp" generate fractal 500 500 hills.tif --seed 7
wait_for_pass() {
  for ((i = 0; i < 600; ++i)); do
    grep -q "\"pass\":\"$1\"" "$logs/err" && return
    sleep 0.1
  done
  fail "the pass $1 does not begin"
}
cut_short() {
  local signal=$1 effort=$2
  set -m
  "$scarp" simplify hills.tif cut.glb -e 0.2% --effort "$effort" --report cut.json --json-progress > "$logs/out" 2> "$logs/err" &
  pid=$!
  set +m
  wait_for_pass fit
  kill "-$signal" "$pid" || fail "$effort effort ended by itself"
  code=0
  wait "$pid" || code=$?
  [ "$code" = 0 ] || fail "exit code $code after $signal in $effort effort"
  grep -q "when the interrupt ended the effort" "$logs/out" || fail "the summary does not tell of the interrupt"
  [ "$(json cut.json strategy cut_short)" = true ] || fail "the report does not tell that the effort was cut short"
  succeeds "$scarp" measure hills.tif cut.glb --fail-above "$(json cut.json goal max_error)"
  rm cut.glb cut.json
}
cut_short INT high
cut_short TERM max
for option in "-t 20000" "-e 0.2% --memory 200M"; do
  # shellcheck disable=SC2086  # options are meant to be split
  interrupt_after INT 1 "$scarp" simplify hills.tif cut.glb --effort max $option
  [ "$code" = 5 ] || fail "exit code $code instead of 5 with $option"
  [ ! -e cut.glb ] || fail "a file is left with $option"
done

# measure and info stop as well.
succeeds "$scarp" simplify "$dem" small.obj -e 1
interrupt_after INT 0.3 "$scarp" info big.tif
[ "$code" = 5 ] || [ "$code" = 0 ] || fail "info ends with $code"
