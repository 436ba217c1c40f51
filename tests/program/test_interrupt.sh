#!/usr/bin/env bash
# Ctrl-C: exit code 5, one message, and no file, partial or complete.
source "$(dirname "$0")/lib.sh"
make_big_raster big.tif

# start COMMAND...: runs in the background with PID $pid.
start() {
  : > "$logs/err"  # the last run's messages are not this one's
  # A background job of a script ignores SIGINT unless job control is on.
  set -m
  "$@" > "$logs/out" 2> "$logs/err" &
  pid=$!
  set +m
}

# is_ready SIGNAL: the program handles the signal itself; if the system does not show this: it has started to work.
is_ready() {
  local caught
  if [ ! -r "/proc/$pid/status" ]; then is_in_pass; return; fi
  [ "$(readlink -f "/proc/$pid/exe")" = "$(readlink -f "$scarp")" ] || return 1
  caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$pid/status")
  (((0x${caught:-0} >> ($(kill -l "$1") - 1)) & 1))
}

# is_in_pass [NAME]: the run, with --json-progress, is in this pass.
is_in_pass() { grep -q "\"pass\":\"${1-}" "$logs/err"; }

# stop SIGNAL: sets $code to the exit code and writes all messages except progress to $logs/said.
stop() {
  kill "-$1" "$pid" 2> /dev/null || fail "the run ended by itself"
  code=0
  wait "$pid" || code=$?
  grep -v '^{' "$logs/err" > "$logs/said" || true
}

for signal in INT TERM HUP; do
  for moment in "is_ready $signal" "is_in_pass refine" $([ $signal != INT ] || echo is_in_pass); do
    start "$scarp" simplify big.tif out.glb -e 0 --preview p.png --report r.json \
      $([[ $moment = is_ready* ]] || echo --json-progress)
    # shellcheck disable=SC2086  # words of a command
    await "$pid" $moment
    stop $signal
    [ "$code" = 5 ] || fail "exit code $code instead of 5 after $signal when $moment"
    [ "$(wc -l < "$logs/said")" = 1 ] || fail "not one line on stderr after $signal when $moment"
    grep -q '^scarp: interrupted; nothing was written$' "$logs/said" || fail "the sentence is missing"
    [ ! -s "$logs/out" ] || fail "something on stdout"
    [ "$(find . -type f)" = ./big.tif ] || fail "files are left: $(find . -type f)"
  done
done

# Even a signal during initialization of libraries, before main(); sanitizers are not ready then.
if [ "$(uname)" = Linux ] && command -v cc > /dev/null && bash -c 'ulimit -v 1000000; exec "$1" --version' - "$scarp" > /dev/null 2>&1; then
  printf '#include <signal.h>\n__attribute__((constructor)) static void first(void) { raise(SIGINT); }\n' > "$logs/early.c"
  cc -shared -fPIC -o "$logs/early.so" "$logs/early.c"
  try env LD_PRELOAD="$logs/early.so" "$scarp" simplify big.tif out.glb -e 0
  [ "$code" = 5 ] || fail "exit code $code instead of 5 where the signal comes before main()"
  grep -q '^scarp: interrupted; nothing was written$' "$logs/err" || fail "the sentence is missing before main()"
fi

# The second signal does not wait for the reaction to the first; it may still come too late to matter.
for wait in 0 0.01 0.05; do
  start "$scarp" simplify big.tif out.glb -e 0 --json-progress
  await "$pid" is_in_pass refine
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
start "$scarp" simplify big.tif out.glb -e 0 --overwrite --json-progress
await "$pid" is_in_pass
stop INT
[ "$code" = 5 ] || fail "exit code $code instead of 5 with --overwrite"
[ "$(cat out.glb)" = mine ] || fail "the old file is gone"
[ "$(find . -type f | sort | tr '\n' ' ')" = "./big.tif ./out.glb " ] || fail "files are left"

# A long effort ends with the mesh so far; without a mesh, or with a budget, it stops.
succeeds "$scarp" generate fractal 500 500 hills.tif --seed 7
cut_short() {
  local signal=$1 effort=$2
  start "$scarp" simplify hills.tif cut.glb -e 0.2% --effort "$effort" --report cut.json --json-progress
  await "$pid" is_in_pass fit
  stop "$signal"
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
  start "$scarp" simplify hills.tif cut.glb --effort max $option --json-progress
  await "$pid" is_in_pass
  stop INT
  [ "$code" = 5 ] || fail "exit code $code instead of 5 with $option"
  [ ! -e cut.glb ] || fail "a file is left with $option"
done

# measure and info stop as well.
start "$scarp" info big.tif
until is_ready INT || ! kill -0 "$pid" 2> /dev/null; do :; done
kill -INT "$pid" 2> /dev/null || true
code=0
wait "$pid" || code=$?
[ "$code" = 5 ] || [ "$code" = 0 ] || fail "info ends with $code"
succeeds "$scarp" simplify big.tif big.obj -e 20
start "$scarp" measure big.tif big.obj --json-progress
await "$pid" is_ready INT
stop INT
[ "$code" = 5 ] || fail "measure ends with $code"
