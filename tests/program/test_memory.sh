#!/usr/bin/env bash
# Too little memory at any moment on any thread: one message and exit code 2, or the right mesh; never an abort.
source "$(dirname "$0")/lib.sh"

# A sanitizer's address space exceeds all these limits.
try bash -c 'ulimit -v 1000000; exec "$1" --version' - "$scarp"
[ "$code" = 0 ] || skip "this build does not run in 1 GB of address space"

succeeds "$scarp" simplify "$dem" whole.glb -e 5 -j 1 -q
good=0
for kilobytes in 60000 100000 120000 140000 160000 180000 200000 220000 240000 260000 300000 400000 600000; do
  for threads in 1 64; do
    rm -f o.glb
    try bash -c 'ulimit -v "$1"; shift; exec "$@"' - "$kilobytes" "$scarp" simplify "$dem" o.glb -e 5 -j "$threads"
    if [ "$code" = 0 ]; then
      good=$((good + 1))
      cmp -s whole.glb o.glb || fail "another mesh in $kilobytes kB with $threads threads"
      continue
    fi
    if [ "$code" = 127 ] || grep -q 'error while loading shared libraries' "$logs/err"; then continue; fi
    [ "$code" = 2 ] || fail "exit code $code with $kilobytes kB and $threads threads"
    [ "$(grep -c '^scarp: [^ ]' "$logs/err")" = 1 ] || fail "not one sentence with $kilobytes kB and $threads threads"
    [ ! -e o.glb ] || fail "a file is left with $kilobytes kB and $threads threads"
  done
done
[ "$good" -gt 0 ] || fail "no run had enough memory"
[ -z "$(find . -name '.scarp-*')" ] || fail "temporary files are left"
echo "$good runs had enough memory, the others said so"
