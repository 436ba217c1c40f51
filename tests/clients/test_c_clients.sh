#!/bin/bash
# The clients of the C library in examples/: each compiles and prints the same lines, if its tools are installed.
. "$(dirname "$0")/../program/lib.sh"
need cc pkg-config python3
library=$SCARP_BUILD/bindings/c
[ -e "$library/libscarp_c.so" ] || skip "needs the C library: -DSCARP_BUILD_C=ON"
export LD_LIBRARY_PATH=$library PKG_CONFIG_PATH=$PWD
examples=$SCARP_SOURCE/examples
printf 'Name: scarp_c\nDescription: of the build\nVersion: 0\nLibs: -L%s -lscarp_c\nCflags: -I%s\n' \
  "$library" "$SCARP_SOURCE/bindings/c" > scarp_c.pc

# shellcheck disable=SC2046
succeeds cc -std=c99 -pedantic -Wall -Wextra -Werror "$examples/c/client.c" $(pkg-config --cflags --libs scarp_c) -o client
succeeds ./client from_c.glb
cp "$logs/out" expected
grep -q "did you mean effort" expected || fail "no advice on a wrong name"
grep -qE "max error ([0-4]\.[0-9]+|5\.000) " expected || fail "the bound is not kept"
succeeds "$scarp" info from_c.glb

# The lines of docs/guide/c.md, with a raster around them.
{
  printf '#include <math.h>\n#include <scarp_c.h>\n#include <stdio.h>\n\nstatic float heights[512 * 512];\n\nint main(void) {\n'
  printf 'for (int i = 0; i < 512 * 512; ++i) heights[i] = 100 * sinf(i %% 512 / 40.0f) * cosf(i / 512 / 50.0f);\n'
  python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$SCARP_SOURCE/docs/guide/c.md" c
  printf '(void)positions, (void)triangles;\nreturn 0;\n}\n'
} > guide.c
# shellcheck disable=SC2046
succeeds cc -std=c99 -pedantic -Wall -Wextra -Werror guide.c $(pkg-config --cflags --libs scarp_c) -lm -o guide
succeeds ./guide
succeeds "$scarp" info hills.glb

compare() {
  diff expected "$logs/out" > "$logs/err" || fail "the client in $1 prints other lines than the one in C"
  echo "$1: the same lines"
}

if command -v rustc > /dev/null && rustc --version > /dev/null 2>&1; then
  succeeds rustc -O -D warnings -L native="$library" "$examples/rust/main.rs" -o rust_client
  succeeds ./rust_client
  compare Rust
else
  echo "Rust: skipped, no rustc"
fi
if command -v mcs > /dev/null && command -v mono > /dev/null; then
  succeeds mcs -warnaserror "$examples/csharp/Client.cs" -out:Client.exe
  succeeds mono Client.exe
  compare C#
else
  echo "C#: skipped, no mcs and mono"
fi
if command -v go > /dev/null; then
  cp "$examples/go/main.go" .
  GOCACHE=$PWD/cache GO111MODULE=off succeeds go run main.go
  compare Go
else
  echo "Go: skipped, no go"
fi
