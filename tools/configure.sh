#!/bin/bash
# Configures a build folder: with Ninja if available, Release unless a preset or option changes it.
#
# usage: tools/configure.sh FOLDER [cmake arguments, such as --preset asan]
set -euo pipefail
folder=$1
shift
if [ ! -f "$folder/CMakeCache.txt" ] && [ -z "${CMAKE_GENERATOR-}" ] && command -v ninja >/dev/null; then
  export CMAKE_GENERATOR=Ninja
fi
exec cmake --log-level=WARNING -S "$(dirname "$0")/.." -B "$folder" "$@"
