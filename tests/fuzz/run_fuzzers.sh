#!/bin/bash
# Fuzzes for a while and keeps its corpus in BUILD/fuzz/NAME, with findings as crash-*.
#
# usage: tests/fuzz/run_fuzzers.sh BUILD [NAME...]      all fuzzers of BUILD/bin where no name is given
# SCARP_FUZZ_SECONDS: seconds for each (default 20). SCARP_FUZZ_SEED: the random seed (default 1; 0: a fresh one).
#
# Starts from tests/fuzz/corpus/NAME and tests/fuzz/NAME.dict where they exist; fixed findings remain in that corpus and
# are retried in every run.
set -uo pipefail
if [ $# -eq 0 ]; then
  echo "usage: $0 BUILD [NAME...]" >&2
  exit 1
fi
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd) || exit 1
shift
seconds=${SCARP_FUZZ_SECONDS:-20}
if [ $# -eq 0 ]; then
  set -- $(cd "$build/bin" && ls -d fuzz_*)
fi

passed=0
failed=0
for name in "$@"; do
  corpus=$build/fuzz/$name
  mkdir -p "$corpus"
  # Without the entropic schedule, whose arithmetic dominates our runs: fuzz_lines runs 5 times as often.
  arguments=(-entropic=0 -seed="${SCARP_FUZZ_SEED:-1}" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048
    -print_final_stats=1 -artifact_prefix="$corpus/")
  [ -f "$here/$name.dict" ] && arguments+=(-dict="$here/$name.dict")
  seeds=()
  [ -d "$here/corpus/$name" ] && seeds=("$here/corpus/$name")
  log=$build/fuzz/$name.log
  if "$build/bin/$name" "${arguments[@]}" "$corpus" ${seeds[@]+"${seeds[@]}"} >"$log" 2>&1 </dev/null; then
    passed=$((passed + 1))
    echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") runs, no finding"
  else
    failed=$((failed + 1))
    echo "$name: FOUND a fault; its log ends:"
    tail -n 40 "$log"
  fi
done
echo "$passed fuzzers passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
