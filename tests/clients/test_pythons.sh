#!/bin/bash
# The wheel in every other installed Python from 3.8 on.
. "$(dirname "$0")/../program/lib.sh"
source "$(dirname "$0")/python_tests.sh"
need python3 cc
[ -e "$SCARP_BUILD/bindings/python/libscarp_c.so" ] || skip "needs the C library: -DSCARP_BUILD_C=ON"
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1 PYTHONDONTWRITEBYTECODE=1
succeeds "$SCARP_SOURCE/tools/build_python.sh" "$SCARP_BUILD" dist
tested=0
for python in $(ls /usr/local/bin/python3 "$HOME"/.pyenv/versions/*/bin/python3 2> /dev/null | sort -u); do
  version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])') || continue
  case $version in 3.[0-7] | 2.*) continue ;; esac
  ! passes_in "$python" "env-$tested" "$(echo dist/*-py3-none-*.whl)" 50 || tested=$((tested + 1))
done
[ $tested -gt 0 ] || skip "no other Python is here"
