#!/bin/bash
# timed.sh NAME SECONDS COMMAND...: returns the command's exit code, or 1 if it uses more than SECONDS of CPU time (0:
# no limit). CPU time, not wall time, so that a busy machine fails no test. Writes the time to SCARP_BUILD/times/NAME
# for tools/test_times.py.
name=$1
most=$2
shift 2
"$@"
code=$?
mkdir -p "$SCARP_BUILD/times"
log=$SCARP_BUILD/times/$name
times >"$log.$$"  # the times of this shell: a pipe would have a shell of its own
# The second line of `times`: user and system time of the children, such as 0m1.234s 0m0.056s.
awk 'NR == 2 { for (k = 1; k <= 2; ++k) { split($k, part, /[ms]/); taken += 60 * part[1] + part[2] } printf "%.2f\n", taken }' \
  "$log.$$" >"$log"
rm "$log.$$"
if [ "$most" != 0 ] && awk -v most="$most" '$1 <= most { exit 1 }' "$log"; then
  echo "FAILED: $name took $(cat "$log") s of CPU time, more than the $most s of a fast test: make it smaller, or take it from the list in tests/CMakeLists.txt"
  code=1
fi
exit $code
