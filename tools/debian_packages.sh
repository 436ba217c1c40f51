#!/bin/bash
# Builds Debian packages from a tarball of sources in the folder WORK, which is emptied first. The packages are in WORK,
# the build in WORK/scarp-VERSION/obj-*.
#
# usage: tools/debian_packages.sh TARBALL WORK
# Environment: JOBS (cores), DEB_BUILD_OPTIONS.
set -euo pipefail
tarball=$(realpath "$1")
rm -rf "$2"
mkdir -p "$2"
cd "$2"
tar -xzf "$tarball"
cd scarp-*
DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS-nocheck} parallel=${JOBS:-$(nproc)}" dpkg-buildpackage -us -uc -b </dev/null
