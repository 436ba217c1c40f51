#!/bin/bash
# Debian packages: built from a tarball of this checkout without lintian messages, unpacked and used, installed and
# removed again. Then the shared library of that build in a moved prefix: found by CMake, by pkg-config, and by the
# program next to it. Without Debian's tools only the second part runs.
. "$(dirname "$0")/../program/lib.sh"
need c++ cmake
source_tree=$SCARP_SOURCE
work=$SCARP_BUILD/debian
jobs=${JOBS:-2}

# use_library PREFIX LIBDIR: from CMake and from pkg-config.
use_library() {
  local folder=$scratch/use
  rm -rf "$folder"
  succeeds cmake -S "$source_tree/tests/consume/find_package" -B "$folder" -DCMAKE_PREFIX_PATH="$1"
  succeeds cmake --build "$folder"
  LD_LIBRARY_PATH=$2 succeeds "$folder/consumer"
  command -v pkg-config > /dev/null || { echo "pkg-config: skipped, it is not there"; return; }
  # shellcheck disable=SC2046
  succeeds c++ -std=c++20 "$source_tree/tests/consume/main.cpp" -o cpp_client \
    $(PKG_CONFIG_PATH=$2/pkgconfig pkg-config --cflags --libs scarp)
  LD_LIBRARY_PATH=$2 succeeds ./cpp_client
  # shellcheck disable=SC2046
  succeeds cc -std=c99 "$source_tree/examples/c/client.c" -o c_client \
    $(PKG_CONFIG_PATH=$2/pkgconfig pkg-config --cflags --libs scarp_c)
  LD_LIBRARY_PATH=$2 succeeds ./c_client
}

# The packages as on a user's machine: unpacked into a folder.
use_packages() {
  local root=$scratch/root libraries package
  for package in "$work"/*.deb; do succeeds dpkg-deb -x "$package" "$root"; done
  cmp "$SCARP_VIEWER_PAGE" "$root/usr/share/scarp/viewer.html" || fail "the package lacks the viewer's page"
  libraries=$(dirname "$(echo "$root"/usr/lib/*/libscarp.so.0)")
  export LD_LIBRARY_PATH=$libraries
  # Optimized or not: the same bytes.
  succeeds "$root/usr/bin/scarp" simplify "$dem" of_package.obj -e 60 -q
  succeeds "$scarp" simplify "$dem" of_build.obj -e 60 -q
  cmp of_package.obj of_build.obj || fail "the program of the package makes other bytes"
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/usr/lib/python3/dist-packages succeeds /usr/bin/python3 -c '
import importlib.metadata, sys
import scarp
assert scarp.__file__.startswith(sys.argv[1]) and scarp.has_gdal
assert importlib.metadata.version("scarp") == scarp.__version__
assert scarp.simplify(sys.argv[2], 60, of="obj").encode() == open("of_build.obj", "rb").read()
' "$root" "$dem"
  unset LD_LIBRARY_PATH
  use_library "$root/usr" "$libraries"
}

# dpkg on a temporary copy of this machine: an overlay in a separate namespace.
install_packages() {
  mkdir copy
  cat > install.sh <<'SCRIPT'
set -eu
mount -t tmpfs tmpfs "$1"
mkdir "$1/upper" "$1/work" "$1/all"
mount -t overlay overlay -o "lowerdir=/,upperdir=$1/upper,workdir=$1/work" "$1/all"
echo "a copy is mounted"
mkdir "$1/all/packages"
cp "$2"/*.deb "$1/all/packages/"
PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$1/all" /bin/sh -eu -c '
  dpkg -i --ignore-depends=sse4.2-support /packages/*.deb
  cd /tmp
  scarp --version
  man -w scarp
  python3 -c "import scarp; print(scarp.__file__)" | grep -x /usr/lib/python3/dist-packages/scarp/__init__.py
  dpkg -P scarp python3-scarp libscarp-dev libscarp0 libscarp-c1
  if ls -d /usr/bin/scarp /usr/lib/python3/dist-packages/scarp; then exit 1; fi'
SCRIPT
  try unshare -m bash install.sh "$scratch/copy" "$work"
  if ! grep -q "a copy is mounted" "$logs/out"; then
    echo "installing them: skipped, no overlay can be mounted here"
    return
  fi
  [ "$code" = 0 ] || { cat "$logs/out" >&2; fail "the packages cannot be installed and removed"; }
}

has_debian() {
  local tool
  for tool in dpkg-buildpackage dh dh_python3 lintian; do command -v $tool > /dev/null || return 1; done
  git -C "$source_tree" rev-parse --is-inside-work-tree > /dev/null 2>&1
}

if has_debian; then
  version=$(sed -n 's/^project(scarp VERSION \([0-9.]*\).*/\1/p' "$source_tree/CMakeLists.txt")
  head -n 1 "$source_tree/debian/changelog" | grep -qF "scarp ($version-" || fail "debian/changelog has another version"
  grep -qxF "  version: $version" "$source_tree/packaging/conda/meta.yaml" || fail "packaging/conda/meta.yaml has another version"
  # All packages that the build needs. make and g++ are build-essential.
  awk '$1 == "build" { print $2 }' "$source_tree/tools/packages.txt" | grep -vxE 'make|g\+\+' | while read -r package; do
    sed -n '/^Build-Depends:/,/^[A-Z].*:/p' "$source_tree/debian/control" | grep -qwF "$package" ||
      fail "$package is no Build-Depends"
  done
  succeeds "$source_tree/tools/source_tarball.sh" .
  # Unoptimized code compiles faster, with clang in 0.6 of GCC's time.
  if command -v clang++ > /dev/null; then export CC=clang CXX=clang++; fi
  export DEB_BUILD_OPTIONS="nocheck noopt noautodbgsym" DEB_CXXFLAGS_STRIP=-g SCARP_VIEWER_PAGE=$scratch/page.html
  export DPKG_DEB_COMPRESSOR_LEVEL=1
  echo "<!DOCTYPE html>" > "$SCARP_VIEWER_PAGE"
  JOBS=$jobs try "$source_tree/tools/debian_packages.sh" "scarp-$version-source.tar.gz" "$work"
  [ "$code" = 0 ] || { tail -n 50 "$logs/out" >&2; fail "the packages are not built"; }
  succeeds lintian --fail-on error,warning "$work"/*.changes
  [ ! -s "$logs/out" ] || { cat "$logs/out" >&2; fail "lintian complains"; }
  use_packages
  install_packages
  build=$(echo "$work"/scarp-*/obj-*)
  succeeds cmake "$build" -DCMAKE_SKIP_INSTALL_RPATH=OFF -DCMAKE_INSTALL_LIBDIR=lib
  echo "packages: $(cd "$work" && ls ./*.deb | wc -l), built, used, installed"
else
  echo "Debian's packages: skipped, they need dpkg-dev, debhelper, dh-python, lintian and git"
  build=$work/build
  succeeds cmake -S "$source_tree" -B "$build" -DBUILD_SHARED_LIBS=ON -DSCARP_BATCH=60 -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0
fi
succeeds cmake --build "$build" -j "$jobs" --target scarp scarp_program scarp_c
succeeds cmake --install "$build" --prefix "$scratch/first"
mv "$scratch/first" "$scratch/moved"
succeeds "$scratch/moved/bin/scarp" --version
use_library "$scratch/moved" "$(dirname "$(find "$scratch/moved" -name libscarp.so)")"
rm -rf "$work"
echo "the shared library is installed, found and used"
