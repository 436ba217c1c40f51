#!/bin/bash
# Searches for rare faults. Compiles each source alone, and runs info, simplify and measure on every file in DATA. Then,
# with fresh random seeds, repeats the laws with ten times their cases, and runs the fuzzers (with clang). Prints each
# failure with the command that repeats it.
#
# Environment: SOAK_MINUTES (10), half for the laws (the last round is finished), half for the fuzzers; BUILD (build),
# JOBS (cores), DATA (../shared/data, skipped if missing), SCARP_FUZZ_SEED (fresh). Exit 1 if something failed.
set -uo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build}
jobs=${JOBS:-$(nproc 2>/dev/null || echo 2)}
seconds=$((${SOAK_MINUTES:-10} * 60))
exec </dev/null

fresh_seed() { od -An -N4 -tu4 /dev/urandom | tr -d ' '; }

# Prints the laws that RC_GTEST_PROP(SUITE, NAME, ...) declares, as SUITE.NAME, in random order.
laws() {
  cat tests/laws/*.cpp tests/unit/*.cpp | tr '\n' ' ' |
    grep -o 'RC_GTEST_PROP( *[A-Za-z_0-9]*, *[A-Za-z_0-9]*' | sed 's/.*( *//; s/, */./' | shuf
}

tools/configure.sh "$build" --preset release && cmake --build "$build" -j "$jobs" --target scarp_tests scarp_program || exit 1
fuzz=no
if command -v clang++ >/dev/null; then
  tools/configure.sh "$build-fuzz" --preset fuzz && cmake --build "$build-fuzz" -j "$jobs" --target fuzzers || exit 1
  fuzz=yes
else
  echo "clang++ is missing: the fuzzers are skipped, the laws get all the time"
fi
[ $fuzz = no ] || seconds=$((seconds / 2))

# try_law PROGRAM LAW SEED: prints a failure and the command to repeat it.
try_law() {
  local log
  log=$(RC_PARAMS="seed=$3 max_success=1000" "$1" --gtest_brief=1 --gtest_filter="$2" 2>&1) && return 0
  printf '%s\n' "$log"
  printf 'FAILED: RC_PARAMS="seed=%s max_success=1000" %s --gtest_filter=%s\n' "$3" "$1" "$2"
  return 1
}
export -f try_law

failed=0
data=${DATA:-../shared/data}
if [ -d "$data" ]; then
  tools/try_files.py "$build/bin/scarp" "$data" --jobs "$jobs" --timeout 600 || failed=1
else
  echo "there is no folder $data: its files are skipped"
fi

ctest --test-dir "$build" -L soak --output-on-failure || failed=1

rounds=0 end=$((SECONDS + seconds))
while [ $SECONDS -lt $end ]; do
  seed=$(fresh_seed)
  laws | xargs -P "$jobs" -I{} bash -c 'try_law "$@"' try_law "$build/bin/scarp_tests" {} "$seed" || failed=1
  rounds=$((rounds + 1))
  echo "round $rounds of $(laws | wc -l) laws, seed $seed"
done

if [ $fuzz = yes ]; then
  fuzzers=$(ls tests/fuzz/fuzz_*.cpp | xargs -n 1 basename -s .cpp)
  export SCARP_FUZZ_SEED=${SCARP_FUZZ_SEED:-$(fresh_seed)}
  export SCARP_FUZZ_SECONDS=$((seconds * jobs / $(echo "$fuzzers" | wc -l) + 1))
  echo "fuzzers, $SCARP_FUZZ_SECONDS s each, seed $SCARP_FUZZ_SEED; findings: $build-fuzz/fuzz/NAME/crash-*"
  echo "$fuzzers" | xargs -P "$jobs" -n 1 tests/fuzz/run_fuzzers.sh "$build-fuzz" || failed=1
fi
[ $failed = 0 ] && echo "nothing was found" || { echo "faults were found"; exit 1; }
