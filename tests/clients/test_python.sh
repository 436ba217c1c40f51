#!/bin/bash
# Scarp for Python: the wheel is installed into a fresh environment, where its tests run. The package is typed, the
# sdist is complete, and the guide's code runs.
. "$(dirname "$0")/../program/lib.sh"
need python3 cc
[ -x /usr/bin/python3 ] || skip "needs /usr/bin/python3"
alone=$SCARP_BUILD/bindings/python/libscarp_c.so
with_gdal=$SCARP_BUILD/bindings/c/libscarp_c.so
[ -e "$alone" ] && [ -e "$with_gdal" ] || skip "needs the C library: -DSCARP_BUILD_C=ON"
package=$SCARP_SOURCE/bindings/python
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1 PYTHONDONTWRITEBYTECODE=1

# 1. The wheel and the sdist: reproducible, without folders of this machine.
succeeds "$SCARP_SOURCE/tools/build_python.sh" "$SCARP_BUILD" dist
succeeds "$SCARP_SOURCE/tools/build_python.sh" "$SCARP_BUILD" dist2
for file in dist/*; do cmp -s "$file" "dist2/${file#dist/}" || fail "$file differs from one build to the next"; done
wheel=$(echo dist/*-py3-none-*.whl)
[ -s "$wheel" ] || fail "no wheel for every Python"
mkdir sdist
tar -xzf dist/scarp-*.tar.gz -C sdist --strip-components=1
[ -s sdist/PKG-INFO ] && [ -s sdist/source/bindings/c/scarp_c.h ] || fail "the sdist is not whole"
diff -rq "$SCARP_SOURCE/src" sdist/source/src > "$logs/err" || fail "the sdist has other sources"

# 2. This system's Python; the others are for test_pythons.sh.
source "$(dirname "$0")/python_tests.sh"
passes_in /usr/bin/python3 env "$wheel" 10 || fail "the system's Python makes no environment"

# 3. With the library with GDAL: files equal the program's byte by byte.
if /usr/bin/python3 -c 'import numpy' 2> /dev/null; then
  export PYTHONPATH=$package/src
  (cd "$SCARP_SOURCE/tests/python" && SCARP_LIBRARY=$with_gdal SCARP_PROGRAM=$scarp SCARP_DEM=$dem \
    try /usr/bin/python3 -m unittest -v test_files test_arrays test_points test_xarray
    [ "$code" = 0 ] || fail "the tests fail with GDAL")
  if /usr/bin/python3 -c 'import matplotlib' 2> /dev/null; then
    SCARP_LIBRARY=$with_gdal succeeds /usr/bin/python3 "$SCARP_SOURCE/tools/python_guide.py"
    cat "$logs/out"
  else
    echo "the guide: skipped, no matplotlib"
  fi
  unset PYTHONPATH
fi

# The command of docs/guide/python.md, with the built library.
install=$(python3 "$SCARP_SOURCE/tools/guide_blocks.py" "$SCARP_SOURCE/docs/guide/python.md" sh)
succeeds env/bin/python -m pip uninstall --quiet --yes scarp
try env/bin/python -I -c 'import scarp'
[ "$code" != 0 ] || fail "scarp is there after it was removed"
(cd "$SCARP_SOURCE" && PATH=$scratch/env/bin:$PATH PIP_NO_INDEX=1 SCARP_C_LIBRARY=$(realpath "$alone") succeeds bash -c "$install")
succeeds env/bin/python -c 'import scarp'

# 4. It is typed, and its reference explains every public name.
succeeds python3 "$SCARP_SOURCE/tools/python_reference.py" reference.md
succeeds python3 - "$SCARP_SOURCE/bindings/python/src/scarp/__init__.py" reference.md << 'E2'
import ast, re, sys
tree = ast.parse(open(sys.argv[1], encoding="utf-8").read())
names, = [ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign) and node.targets[0].id == "__all__"]
sections = dict(re.findall(r"^## (\w+)[^\n]*\n(.*?)(?=^## |\Z)", open(sys.argv[2], encoding="utf-8").read(), re.M | re.S))
assert len(names) > 10, names
for name in set(names) - {"has_gdal", "__version__"}:
    assert "```text\n" in sections.get(name, ""), f"the reference does not explain {name}"
E2
if command -v mypy > /dev/null; then
  (cd "$package" && try mypy --cache-dir "$scratch/mypy" --python-version 3.9
    [ "$code" = 0 ] || { cat "$logs/out" >&2; fail "mypy complains"; })
else
  echo "mypy: skipped, it is not there"
fi
