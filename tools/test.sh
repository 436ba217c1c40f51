#!/bin/bash
# usage: tools/test.sh test|rest|full
#
# test: everything needed to verify this tree on this machine. Release: unit tests, laws with 10 cases each, and the
#       scripts of labels fast and full: program, Python, npm, viewer.
# rest: what `make test-full` adds.
#   1. Release: laws with 100 cases each; comparisons of whole meshes; scripts of label rest: packages, installs,
#      clients of other languages, other programs, clusters.
#   2. AddressSanitizer and UndefinedBehaviorSanitizer: unit tests, and laws with 8 cases each, with asserts and a share
#      of the samples of real rasters (tests/laws/sanitized.h). One process runs many tests to save starts. With clang
#      this is the fuzzers' build, so the library is compiled once. The C library, called by C (tests/abi/door.c) and,
#      with clang, by Python.
#   3. Fuzzers, SCARP_FUZZ_SECONDS (10) each; needs clang.
#   4. ThreadSanitizer: the tests that use threads.
# full: both.
#
# A failed stage does not skip the next. Random seeds are fixed: tests/laws/fixed_seed.cpp, SCARP_FUZZ_SEED;
# tools/soak.sh uses fresh ones. The CPU seconds of each stage and script go to BUILD/times, which tools/test_times.py
# prints; above 1,900 s for `test` it fails.
#
# Environment: BUILD (build), JOBS (cores). The last line counts the tests of all stages; exit 1 if one failed.
set -uo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build}
jobs=${JOBS:-$(nproc 2>/dev/null || echo 2)}
what=${1:-full}
case $what in test | rest | full) ;; *) sed -n '2s/^# //p' "$0" >&2; exit 1 ;; esac
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

# timed STAGE COMMAND...: notes the CPU time of the command in BUILD/times.
timed() {
  local stage=$1 status=0 TIMEFORMAT='%U %S'
  shift
  mkdir -p "$build/times"
  { time "$@" >&3 2>&4; } 3>&1 4>&2 2>"$build/times/$stage" || status=$?
  awk '{ printf "%.2f\n", $1 + $2 }' "$build/times/$stage" >"$build/times/$stage.sum"
  mv "$build/times/$stage.sum" "$build/times/$stage"
  return $status
}

# build_stage FOLDER PRESET TARGET...: configures and builds; a failure counts as one failed test.
build_stage() {
  local folder=$1 preset=$2
  shift 2
  tools/configure.sh "$folder" --preset "$preset" && cmake --build "$folder" -j "$jobs" --target "$@" && return 0
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

# run_gtest PROGRAM [PARTS]: runs its tests in PARTS (1) processes, as many at once as there are jobs. Tests that an
# abort prevented count as failed.
run_gtest() {
  local program=$1 parts=${2:-1} passed=0 failed=0 skipped=0 part
  run_part() {
    local log=$1.$3.log status=0
    GTEST_TOTAL_SHARDS=$2 GTEST_SHARD_INDEX=$3 timeout 1800 "$1" --gtest_color=no >"$log" 2>&1 || status=$?
    echo "exit status $status" >>"$log"
  }
  export -f run_part
  seq 0 $((parts - 1)) | xargs -P "$jobs" -I{} bash -c 'run_part "$@"' run_part "$program" "$parts" {}
  for ((part = 0; part < parts; ++part)); do
    local log=$program.$part.log tests fine left bad
    tests=$(sed -n 's/^\[==========\] Running \([0-9]*\) tests\? .*/\1/p' "$log")
    fine=$(grep -c '^\[       OK \] ' "$log")
    left=$(grep -c '^\[  SKIPPED \] .* ms)$' "$log")
    bad=$((${tests:-0} - fine - left))
    if ! tail -n 1 "$log" | grep -qx 'exit status 0'; then
      [ "$bad" -gt 0 ] || bad=1
      grep -v -e '^\[       OK \]' -e '^\[-*\]' "$log" | awk '/^\[ RUN / { run = $0; next } run != "" { print run; run = "" } { print }'
    fi
    passed=$((passed + fine)) failed=$((failed + bad)) skipped=$((skipped + left))
  done
  echo "$(basename "$program"): $passed passed, $failed failed, $skipped skipped"
  [ $((passed + failed + skipped)) -gt 0 ] || failed=1
  add "$passed" "$failed" "$skipped"
}

# run_callers FOLDER PROGRAM: calls the sanitized C library of that build from C and Python.
run_callers() {
  local folder=$1 program=$2 scratch runtime
  # passes NAME COMMAND...
  passes() {
    local name=$1
    shift
    if "$@" >"$scratch/log" 2>&1; then add 1 0 0; else cat "$scratch/log"; echo "FAILED: $name"; add 0 1 0; fi
  }
  scratch=$(mktemp -d)
  "$program" simplify data/jacksboro_fault.tif "$scratch/of.glb" -e 5 -q
  "$program" simplify data/jacksboro_fault.tif "$scratch/of.obj" -e 5 -q
  passes "the C library called by C" "$folder/bin/scarp_c_caller" data/jacksboro_fault.tif "$scratch/of.glb" "$scratch/of.obj" \
    "$scratch/out.glb"
  runtime=$(clang -print-file-name="libclang_rt.asan-$(uname -m).so" 2>/dev/null || true)
  if [ -e "$folder/bindings/c/libscarp_c.so" ] && [ -e "$runtime" ]; then
    # Leaks are searched for above: an interpreter frees little at exit.
    # Not xarray: its tests call the library as those of arrays do.
    basename -a tests/python/test_*.py | grep -v xarray >"$scratch/files"
    passes "the C library called by Python" env ASAN_OPTIONS=detect_leaks=0 PYTHONDONTWRITEBYTECODE=1 \
      PYTHONPATH="$PWD/bindings/python/src" SCARP_LIBRARY="$(realpath "$folder")/bindings/c/libscarp_c.so" \
      SCARP_PROGRAM="$(realpath "$program")" SCARP_DEM="$PWD/data/jacksboro_fault.tif" xargs -a "$scratch/files" -P "$jobs" -I{} \
      env LD_PRELOAD="$runtime" /usr/bin/python3 -m unittest discover -v -s tests/python -p {}
  else
    echo "the C library called by Python: skipped, it needs clang and its shared runtime"
    add 0 0 1
  fi
  rm -rf "$scratch"
}

# names_of_laws: the laws as a filter of GoogleTest, from RC_GTEST_PROP(SUITE, NAME, ...).
names_of_laws() {
  cat tests/laws/*.cpp tests/unit/*.cpp | tr '\n' ' ' | grep -o 'RC_GTEST_PROP( *[A-Za-z_0-9]*, *[A-Za-z_0-9]*' |
    sed 's/.*( *//; s/, */./' | paste -sd:
}

# Tests that compare sizes or errors of whole meshes: for make test-rest, without sanitizers. Laws run the same code on
# smaller ones.
compared=(
  bounds.that_are_all_but_one_the_same_take_as_many_triangles_as_a_threshold
  bounds.that_fall_across_a_field_take_fewer_triangles_with_each_effort
  budget_search.a_much_larger_budget_never_has_a_larger_error
  budget_search.uses_the_budget_and_lowers_the_error_of_greedy_insertion
  channels_of_efforts.take_fewer_triangles_with_each_level
  effort.each_level_takes_fewer_triangles
  line_budget.is_used_where_triangles_grow_smoothly
  norms.of_the_same_field_thrice_take_as_many_triangles_as_heights_alone
  point_squares.fall_against_the_mesh_of_the_least_max_error
  shape.high_effort_gives_up_short_edges
  squares.fall_by_a_tenth_against_the_mesh_of_the_least_max_error
  squares.have_a_cap_which_is_that_of_fast_effort_or_the_one_that_was_asked_for
  squares.patches_keep_the_budget_and_nearly_reach_the_error_of_one
  streamed_bounds.take_about_as_many_triangles_as_in_memory_at_the_public_door
  tolerance_budget.is_used_and_effort_lowers_the_factor
)

run_test() {
  announce "Release: build"
  rm -rf "$build/times" "$build/gauge"
  mkdir -p "$build"
  tools/test_times.py "$build" --gauge
  timed build build_stage "$build" release all || return
  tools/test_times.py "$build" --gauge
  announce "Release: unit tests, and laws with 10 cases"
  GTEST_FILTER=-$(IFS=: && echo "${compared[*]}") SCARP_LAW_CASES=10 timed units run_gtest "$build/bin/scarp_tests" 40
  tools/test_times.py "$build" --gauge
  announce "Release: scripts"
  run_ctest "$build" -L 'fast|full' -E '^(few_cases|all_cases)[.]'  # what has just run
}

run_rest() {
  announce "1/4 Release: laws with 100 cases; packages, installs, clients, clusters"
  if timed rest_build build_stage "$build" release all scarp_rest_programs; then
    GTEST_FILTER=$(names_of_laws):$(IFS=: && echo "${compared[*]}") timed rest_laws run_gtest "$build/bin/scarp_tests" 40
    run_ctest "$build" -L rest
  fi

  announce "2/4 address and undefined behaviour sanitizers: unit tests and laws"
  local sanitized=asan targets=(scarp_tests scarp_c_caller)
  if command -v clang++ >/dev/null; then sanitized=fuzz targets+=(scarp_c fuzzers); fi
  if timed rest_sanitized_build build_stage "$build-$sanitized" "$sanitized" "${targets[@]}"; then
    GTEST_FILTER=-$(IFS=: && echo "${compared[*]}") timed rest_sanitized run_gtest "$build-$sanitized/bin/scarp_tests" 40
    timed rest_sanitized_callers run_callers "$build-$sanitized" "$build/bin/scarp"
    announce "3/4 fuzzers"
    if [ "$sanitized" = fuzz ]; then
      SCARP_FUZZ_SECONDS=${SCARP_FUZZ_SECONDS:-10} timed rest_fuzzers run_ctest "$build-fuzz" -R '^fuzz[.]'
    else
      echo "clang++ is missing: the fuzzers are skipped"
      add 0 0 1
    fi
  fi

  announce "4/4 thread sanitizer: tests that use threads"
  # Without optimization clang needs 0.6 of GCC's time.
  if CXX=$(command -v clang++ || command -v c++) timed rest_threads_build build_stage "$build-tsan" tsan scarp_thread_tests; then
    TSAN_OPTIONS="suppressions=$PWD/tools/tsan.supp ${TSAN_OPTIONS-}" timed rest_threads run_gtest "$build-tsan/bin/scarp_thread_tests"
  fi
}

start=$(date +%s)
if [ "$what" != rest ]; then
  run_test
  tools/test_times.py "$build" --most 1900 && add 1 0 0 || add 0 1 0
fi
if [ "$what" != test ]; then
  run_rest
  tools/test_times.py "$build" --rest
fi

printf '\nAll stages, in %d s:\n' $(($(date +%s) - start))
echo "$total_passed passed, $total_failed failed, $total_skipped skipped"
[ "$total_failed" -eq 0 ]
