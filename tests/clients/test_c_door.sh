#!/bin/bash
# The C library (bindings/c): its exports, a C99 caller, an earlier caller's header, the bytes of the program.
. "$(dirname "$0")/../program/lib.sh"
need cc nm
library=$SCARP_BUILD/bindings/c
[ -e "$library/libscarp_c.so" ] || skip "needs the C library: -DSCARP_BUILD_C=ON"
export LD_LIBRARY_PATH=$library

# 1. It exports only the functions of its header.
nm -D --defined-only "$library/libscarp_c.so" | awk '$2 == "T" { sub(/@.*/, "", $3); print $3 }' | sort > shown
grep -oE '\bscarp_[a-z0-9_]+\(' "$SCARP_SOURCE/bindings/c/scarp_c.h" | tr -d '(' | sort -u |
  grep -vE '^scarp_(progress_fn|options_set)$' > declared
echo scarp_options_set >> declared
sort -o declared declared
diff shown declared > "$logs/err" || fail "the library does not show what its header declares"
nm -D --defined-only "$library/libscarp_c.so" | grep -qE ' [BDRVW] ' && fail "the library shows more than functions"

# 2. A caller in C99, compiled with the header and with that of the first version.
flags=(-std=c99 -pedantic -Wall -Wextra -Werror -O1 "-L$library" -lscarp_c -lm)
succeeds "$scarp" simplify "$dem" of_program.glb -e 5 -q
succeeds "$scarp" simplify "$dem" of_program.obj -e 5 -q
mkdir old
cp "$SCARP_SOURCE/tests/abi/scarp_c_1.h" old/scarp_c.h
for header in "$SCARP_SOURCE/bindings/c" old; do
  newest=()
  [ "$header" = old ] || newest=(-DIS_NEWEST)
  succeeds cc "$SCARP_SOURCE/tests/abi/door.c" -o door "-I$header" "${newest[@]}" "${flags[@]}"
  succeeds ./door "$dem" of_program.glb of_program.obj out.glb
  grep -q "the C library holds" "$logs/out" || fail "the caller did not finish"
done
echo '#include <scarp_c.h>' > twice.cpp
echo '#include <scarp_c.h>' >> twice.cpp
# The padding of tiles is written before it is read, and nothing leaks: memcheck finds no error in a client.
# Highway's library may use, as it is loaded, an instruction that valgrind does not know: then no client runs in it.
highway=$(ldd "$library/libscarp_c.so" | awk '/libhwy/ { print $3 }')
if ! command -v valgrind > /dev/null; then
  echo "memcheck: skipped, needs valgrind"
elif ! LD_PRELOAD=$highway valgrind -q "$(command -v true)" 2> /dev/null; then
  echo "memcheck: skipped, valgrind does not know an instruction of this processor"
else
  succeeds cc "$SCARP_SOURCE/tests/abi/door.c" -o door "-I$SCARP_SOURCE/bindings/c" -DIS_NEWEST "${flags[@]}"
  try valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite ./door
  [ "$code" = 0 ] || fail "memcheck of a caller complains"
  [ ! -s "$logs/err" ] || fail "memcheck prints something"
fi
succeeds c++ -std=c++11 -Wall -Wextra -Werror -fsyntax-only "-I$SCARP_SOURCE/bindings/c" twice.cpp

# 3. The library without GDAL: it does not link GDAL, and prints a message where GDAL is needed.
alone=$SCARP_BUILD/bindings/python
if [ -e "$alone/libscarp_c.so" ]; then
  ldd "$alone/libscarp_c.so" | grep -q libgdal && fail "the library without GDAL is linked to it"
  export LD_LIBRARY_PATH=$alone
  succeeds cc "$SCARP_SOURCE/tests/abi/door.c" -o door_alone "-I$SCARP_SOURCE/bindings/c" -std=c99 "-L$alone" -lscarp_c -lm
  succeeds ./door_alone
  try ./door_alone "$dem" of_program.glb of_program.obj out.glb
  [ "$code" = 1 ] || fail "a library without GDAL read a GeoTIFF"
  grep -q "built without GDAL" "$logs/err" || fail "no sentence about GDAL"
fi
echo "the C library shows what it declares, and holds"
