#!/bin/bash
# within_cpu.sh SECONDS COMMAND...: the command's exit code, but 1 where it takes more CPU time: a fast test has to stay
# one. Not by the clock, for a busy machine is no fault of the test.
most=$1
shift
"$@"
code=$?
# The second line of `times`: user and system time of the children, such as 0m1.234s 0m0.056s.
log=$(mktemp)
times >"$log"  # of this shell: a pipe would have a shell of its own
awk -v most="$most" -v name="${*: -1}" 'NR == 2 {
  for (k = 1; k <= 2; ++k) { split($k, part, /[ms]/); taken += 60 * part[1] + part[2] }
  if (taken > most) {
    printf "FAILED: %s took %.1f s of CPU time, more than the %s s of a fast test: make it smaller, or take it from the list in tests/CMakeLists.txt\n", name, taken, most
    exit 1
  }
}' "$log" || code=1
rm "$log"
exit $code
