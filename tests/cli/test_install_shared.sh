#!/bin/bash
# The same as a shared library: installed, found by CMake and pkg-config, used, and found by the installed program
# wherever its prefix is moved to.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export CMAKE_GENERATOR="Unix Makefiles"

fail() { echo "FAILED: $1"; exit 1; }

cmake -S "$source_tree" -B "$scratch/build" -DBUILD_SHARED_LIBS=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 >/dev/null
cmake --build "$scratch/build" -j 2 >"$scratch/log" 2>&1 || { cat "$scratch/log"; fail "the shared build"; }
cmake --install "$scratch/build" --prefix "$scratch/first" >/dev/null
rm -rf "$scratch/build"
mv "$scratch/first" "$scratch/prefix"
prefix=$scratch/prefix
libdir=$(dirname "$(find "$prefix" -name 'libscarp.so')")
[ -e "$libdir/libscarp.so" ] || fail "no libscarp.so"
"$prefix/bin/scarp" --version >/dev/null || fail "the program does not find its library"

cmake -S "$source_tree/tests/consume/find_package" -B "$scratch/find" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$scratch/find" >/dev/null
"$scratch/find/consumer" || fail "find_package"
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$libdir/pkgconfig"
  # shellcheck disable=SC2046
  c++ -std=c++20 "$source_tree/tests/consume/main.cpp" -o "$scratch/by_pkg_config" $(pkg-config --cflags --libs scarp)
  LD_LIBRARY_PATH="$libdir" "$scratch/by_pkg_config" || fail "pkg-config"
fi
echo "the shared library is installed, found and used"
