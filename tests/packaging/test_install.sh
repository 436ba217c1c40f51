#!/bin/bash
# `make install` is complete and usable outside the tree: by find_package, pkg-config and by hand. Scarp inside another
# project (add_subdirectory) works without GDAL; illegal options fail to configure.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
build=${SCARP_BUILD:?}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export CMAKE_GENERATOR="Unix Makefiles"

fail() { echo "FAILED: $1"; exit 1; }

# 1. Every file in its place, DESTDIR honoured.
prefix=$scratch/prefix
DESTDIR="$scratch/stage" cmake --install "$build" --prefix /opt/scarp >/dev/null
[ -x "$scratch/stage/opt/scarp/bin/scarp" ] || fail "DESTDIR was not honoured"
cmake --install "$build" --prefix "$prefix" >"$scratch/install.log"
for file in bin/scarp include/scarp/scarp.h share/man/man1/scarp.1 share/doc/scarp/LICENSE \
  share/bash-completion/completions/scarp share/zsh/site-functions/_scarp share/fish/vendor_completions.d/scarp.fish; do
  [ -s "$prefix/$file" ] || fail "not installed: $file"
done
diff <(cd "$source_tree/include/scarp" && ls) <(cd "$prefix/include/scarp" && ls) || fail "other headers are installed than are public"
package=$(dirname "$(find "$prefix" -name scarpConfig.cmake)")
pkgconfig=$(dirname "$(find "$prefix" -name scarp.pc)")
[ -n "$package" ] && [ -n "$pkgconfig" ] || fail "no CMake package or no scarp.pc"
grep -rlF -e "$source_tree" -e "$build" "$package" "$pkgconfig" "$prefix/include" && fail "installed files name the build"
"$prefix/bin/scarp" --version | grep -q '[0-9]\.[0-9]' || fail "the installed program does not run"

# 2. Each public header compiles alone, as does its example.
examples=$scratch/examples
python3 "$source_tree/tests/packaging/header_examples.py" "$prefix/include/scarp" "$source_tree/docs/guide/library.md" "$examples" ||
  fail "the examples of the headers"
for source in "$examples"/*.cpp; do
  c++ -std=c++20 -Wall -Wextra -Werror -I"$prefix/include" -c "$source" -o "${source%.cpp}.o" ||
    fail "the example of $(basename "${source%.cpp}").h"
done

# 3. find_package, after the prefix has been moved.
mv "$prefix" "$scratch/moved prefix"
prefix="$scratch/moved prefix"
cmake -S "$source_tree/tests/consume/find_package" -B "$scratch/find" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$scratch/find" >/dev/null
"$scratch/find/consumer" || fail "find_package"

# 4. pkg-config; its paths follow the prefix too (pkg-config wants one without blanks).
mv "$prefix" "$scratch/moved"
prefix=$scratch/moved
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$prefix/${pkgconfig#"$scratch/prefix/"}"
  # shellcheck disable=SC2046
  c++ -std=c++20 "$source_tree/tests/consume/main.cpp" -o "$scratch/by_pkg_config" $(pkg-config --cflags --libs scarp)
  LD_LIBRARY_PATH="$prefix/lib" "$scratch/by_pkg_config" || fail "pkg-config"
  # shellcheck disable=SC2046
  c++ -std=c++20 "$source_tree/docs/guide/library.cpp" -o "$scratch/guide" $(pkg-config --cflags --libs scarp)
  (cd "$scratch" && LD_LIBRARY_PATH="$prefix/lib" ./guide) || fail "the program of docs/guide/library.md"
  # shellcheck disable=SC2046
  c++ -std=c++20 -Wall -Wextra -Werror "$source_tree/examples/live/rolling_map.cpp" -o "$scratch/rolling_map" $(pkg-config --cflags --libs scarp)
  (cd "$scratch" && LD_LIBRARY_PATH="$prefix/lib" ./rolling_map 2 map.glb >rolling.log && grep 'sound: yes' rolling.log) || fail "examples/live"
  # The examples of the headers, in a folder with their files.
  # shellcheck disable=SC2046
  c++ "$examples"/*.o -o "$examples/run" $(pkg-config --libs scarp)
  cp -L "$source_tree"/data/examples/* "$examples/"
  (
    cd "$examples"
    "$prefix/bin/scarp" simplify dem.tif hills.glb -e 20 -q &&
      "$prefix/bin/scarp" tile dem.tif hills.pmtiles --cells 16 --zoom 11 --vertical egm96 -q &&
      LD_LIBRARY_PATH="$prefix/lib" ./run >run.log
  ) || { cat "$examples/run.log"; fail "an example of the headers"; }
  # The program of README.md; and that of library.md by the guide's lines of CMake.
  mkdir "$scratch/by_guide"
  blocks="$source_tree/tools/guide_blocks.py"
  python3 "$blocks" "$source_tree/README.md" cpp >"$scratch/by_guide/readme.cpp"
  # shellcheck disable=SC2046
  c++ -std=c++20 "$scratch/by_guide/readme.cpp" -o "$scratch/by_guide/readme" $(pkg-config --cflags --libs scarp)
  cp "$source_tree/data/examples/dem.tif" "$scratch/by_guide/"
  (cd "$scratch/by_guide" && LD_LIBRARY_PATH="$prefix/lib" ./readme) || fail "the program of README.md"
  {
    printf 'cmake_minimum_required(VERSION 3.20)\nproject(app CXX)\nset(CMAKE_CXX_STANDARD 20)\n'
    printf 'add_executable(app guide.cpp)\n'
    python3 "$blocks" "$source_tree/docs/guide/library.md" cmake
  } >"$scratch/by_guide/CMakeLists.txt"
  python3 "$blocks" "$source_tree/docs/guide/library.md" cpp >"$scratch/by_guide/guide.cpp"
  cmake -S "$scratch/by_guide" -B "$scratch/by_guide/build" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null &&
    cmake --build "$scratch/by_guide/build" >/dev/null && (cd "$scratch" && ./by_guide/build/app >/dev/null) ||
    fail "the lines of CMake of docs/guide/library.md"
  if [ -e "$prefix/include/scarp_c.h" ]; then
    # shellcheck disable=SC2046
    cc -std=c99 "$source_tree/examples/c/client.c" -o "$scratch/c_client" $(pkg-config --cflags --libs scarp_c)
    (cd "$scratch" && LD_LIBRARY_PATH="$prefix/lib" ./c_client >c_client.out) || fail "a client of the C library"
    # shellcheck disable=SC2046
    cc -std=c99 "$source_tree/examples/c/client.c" -o "$scratch/static_client" -I"$prefix/include" \
      "$prefix/lib/libscarp_c.a" $(pkg-config --libs --static scarp_c | sed 's/-lscarp_c //')
    (cd "$scratch" && ./static_client | cmp - c_client.out) || fail "a client of the static C library"
  else
    echo "the C library is not built: that part is skipped"
  fi
  [ "$(pkg-config --modversion scarp)" = "$("$prefix/bin/scarp" --version | grep -o '[0-9][0-9.]*' | head -n 1)" ] ||
    fail "scarp.pc and the program disagree about the version"
else
  echo "pkg-config is missing: that part is skipped"
fi

# 5. add_subdirectory without GDAL, tiles and strategies, with every name defined. Without optimization clang needs 0.6
# of GCC's time.
CXX=$(command -v clang++ || command -v c++) cmake -S "$source_tree/tests/consume/add_subdirectory" -B "$scratch/sub" \
  -DSCARP_SOURCE="$source_tree" -DSCARP_INSTALL=ON -DBUILD_SHARED_LIBS=ON -DCMAKE_SHARED_LINKER_FLAGS=-Wl,-z,defs \
  -DSCARP_WITH_TILES=OFF -DSCARP_WITH_PAPER=OFF \
  -DSCARP_WITH_GDAL=OFF -DCMAKE_UNITY_BUILD=ON -DSCARP_BATCH=60 -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 >/dev/null
cmake --build "$scratch/sub" -j 2 >"$scratch/sub.log" 2>&1 || { cat "$scratch/sub.log"; fail "add_subdirectory without GDAL"; }
"$scratch/sub/consumer" >"$scratch/sub.out" || fail "add_subdirectory"
grep -q "knows no strategies" "$scratch/sub.out" || fail "no sentence for a strategy in a library without them"
if ldd "$scratch/sub/consumer" | grep -qE 'libgdal|libsqlite3'; then fail "the small library is linked to GDAL or SQLite"; fi
cmake --install "$scratch/sub" --prefix "$scratch/small" >/dev/null
if [ -e "$scratch/small/include/scarp/tile.h" ]; then fail "tile.h is installed without tiles"; fi
c++ -std=c++20 -fsyntax-only -I"$scratch/small/include" "$source_tree/tests/consume/main.cpp" || fail "scarp.h without tiles"

# 6. An illegal combination of options is refused, with a sentence.
if cmake -S "$source_tree" -B "$scratch/illegal" -DSCARP_BUILD_APPS=ON -DSCARP_WITH_GDAL=OFF >"$scratch/illegal.log" 2>&1; then
  fail "SCARP_BUILD_APPS=ON with SCARP_WITH_GDAL=OFF was configured"
fi
tr -s ' \n' ' ' <"$scratch/illegal.log" | grep -q "SCARP_BUILD_APPS needs SCARP_WITH_GDAL=ON" || fail "no sentence for illegal options"
if cmake -S "$source_tree" -B "$scratch/illegal" -DSCARP_BUILD_APPS=ON -DSCARP_WITH_GDAL=ON -DSCARP_WITH_TILES=OFF >"$scratch/illegal.log" 2>&1; then
  fail "SCARP_BUILD_APPS=ON with SCARP_WITH_TILES=OFF was configured"
fi
tr -s ' \n' ' ' <"$scratch/illegal.log" | grep -q "SCARP_WITH_TILES=OFF needs SCARP_BUILD_APPS=OFF" || fail "no sentence for a program without tiles"
echo "installed, found and used"
