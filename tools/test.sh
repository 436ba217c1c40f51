#!/bin/bash
# Everything that `make test` runs, in four stages; a stage that fails does not hide the next.
#
#   1. Release: all tests through ctest (unit tests, laws, scripts that drive the program).
#   2. AddressSanitizer and UndefinedBehaviorSanitizer: unit tests and laws again, asserts on.
#   3. ThreadSanitizer: the tests that use threads.
#   4. Fuzzers, SCARP_FUZZ_SECONDS (20) each; needs clang.
#
# Environment: BUILD (build), JOBS (cores). The last line counts the tests of all stages; exit 1 if one failed.
set -uo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build}
jobs=${JOBS:-$(nproc 2>/dev/null || echo 2)}
exec </dev/null

total_passed=0
total_failed=0
total_skipped=0

announce() { printf '\n=== %s ===\n' "$1"; }

# add PASSED FAILED SKIPPED
add() {
  total_passed=$((total_passed + $1))
  total_failed=$((total_failed + $2))
  total_skipped=$((total_skipped + $3))
}

# build_stage FOLDER PRESET TARGET...: configures and builds; a failure counts as one failed test.
build_stage() {
  local folder=$1 preset=$2
  shift 2
  if tools/configure.sh "$folder" --preset "$preset" && cmake --build "$folder" -j "$jobs" --target "$@"; then
    return 0
  fi
  echo "FAILED: the $preset build"
  add 0 1 0
  return 1
}

# run_ctest FOLDER [ctest arguments]
run_ctest() {
  local folder=$1 status=0 junit
  shift
  junit=$(cd "$folder" && pwd)/tests.xml
  rm -f "$junit"
  ctest --test-dir "$folder" -j "$jobs" --output-on-failure --no-tests=error --output-junit "$junit" "$@" || status=$?
  attribute() {
    local value
    value=$(grep -o "\b$1=\"[0-9]*\"" "$junit" 2>/dev/null | head -n 1 | tr -dc 0-9)
    echo "${value:-0}"
  }
  local tests failed skipped
  tests=$(attribute tests)
  failed=$(attribute failures)
  skipped=$(($(attribute skipped) + $(attribute disabled)))
  if [ "$status" -ne 0 ] && [ "$failed" -eq 0 ]; then failed=1 tests=$((tests + 1)); fi
  add $((tests - failed - skipped)) "$failed" "$skipped"
}

# run_gtest PROGRAM: one process for all its tests.
run_gtest() {
  local log=$1.log status=0
  "$1" --gtest_brief=1 >"$log" 2>&1 || status=$?
  count() { sed -n "s/^\[  $1 *\] \([0-9]*\) tests\?[.,].*/\1/p" "$log" | head -n 1; }
  local passed failed skipped
  passed=$(count PASSED) failed=$(count FAILED) skipped=$(count SKIPPED)
  if [ "$status" -ne 0 ]; then
    cat "$log"
    [ "${failed:-0}" -gt 0 ] || failed=1
  fi
  echo "$(basename "$1"): ${passed:-0} passed, ${failed:-0} failed, ${skipped:-0} skipped"
  add "${passed:-0}" "${failed:-0}" "${skipped:-0}"
}

install_validator() {
  [ -f tests/js/package.json ] && [ ! -d tests/js/node_modules ] || return 0
  if ! command -v npm >/dev/null || ! (cd tests/js && npm ci --no-audit --no-fund --silent); then
    echo "npm could not install tests/js: the tests that need the Khronos glTF validator will be skipped"
  fi
}

start=$(date +%s)
announce "1/4 Release: all tests"
install_validator
if build_stage "$build" release all; then run_ctest "$build"; fi

announce "2/4 address and undefined behaviour sanitizers: unit tests and laws"
if build_stage "$build-asan" asan scarp_tests; then run_ctest "$build-asan" -E '^cli\.'; fi

announce "3/4 thread sanitizer: tests that use threads"
if build_stage "$build-tsan" tsan scarp_thread_tests; then
  TSAN_OPTIONS="suppressions=$PWD/tools/tsan.supp ${TSAN_OPTIONS-}" run_gtest "$build-tsan/bin/scarp_thread_tests"
fi

announce "4/4 fuzzers"
if ! command -v clang++ >/dev/null; then
  echo "clang++ is missing: the fuzzers are skipped"
  add 0 0 1
elif build_stage "$build-fuzz" fuzz all; then
  run_ctest "$build-fuzz"
fi

printf '\nAll stages, in %d s:\n' $(($(date +%s) - start))
echo "$total_passed passed, $total_failed failed, $total_skipped skipped"
[ "$total_failed" -eq 0 ]
