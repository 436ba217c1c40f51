#!/usr/bin/env bash
# tools/try_files.py reports the results of a program on a folder of files, and finds each kind of fault.
source "$(dirname "$0")/lib.sh"
need python3
try_files() { try env PYTHONDONTWRITEBYTECODE=1 python3 "$SCARP_SOURCE/tools/try_files.py" "$@"; }
mkdir files
cp "$dem" files/dem.tif
echo "no raster" > files/words.bin
try_files "$scarp" files --jobs 1
[ "$code" = 0 ] || fail "faults are found where there is none: $(cat "$logs/out")"
grep -q '^| exit code 0 | 1 | 1 | 1 |$' "$logs/out" || fail "the raster is not in the table"
grep -q '^| exit code 2 | 1 | 1 | 0 |$' "$logs/out" || fail "the refusal is not in the table"
grep -q '^2 files, 0 faults$' "$logs/out" || fail "the last line is another"

# fake SCRIPT WORDS: a program that runs the script; the table prints WORDS.
fake() {
  printf '#!/bin/sh\n%s\n' "$1" > "$logs/fake"
  chmod +x "$logs/fake"
  try_files "$logs/fake" files --jobs 1 --timeout 2
  [ "$code" = 1 ] || fail "exit code $code instead of 1: $1"
  grep -qF "$2" "$logs/out" || fail "'$2' is not told: $(cat "$logs/out")"
}
fake 'kill -SEGV $$' 'info: SIGSEGV'
fake 'exec sleep 20' 'simplify: time-out'
fake 'echo one >&2; exit 70' 'info: exit code 70: one'
fake 'printf "one\ntwo\n" >&2; exit 2' 'info: 2 lines instead of one sentence'
fake '[ $1 = info ] && exit 0; echo no >&2; exit 2' 'info and simplify disagree'
fake 'echo half > "$3"; echo no >&2; exit 2' 'simplify: leaves mesh.glb'
fake '[ $1 = measure ] && { echo no >&2; exit 3; }; [ $1 = info ] && exit 0
      echo x > "$3"; echo "{\"goal\": {\"max_error\": 1}}" > "$7"' 'measure: does not confirm the mesh'
fake 'touch "$2.gfs"; echo no >&2; exit 2' 'files/dem.tif.gfs: appeared beside the inputs'
