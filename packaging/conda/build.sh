#!/bin/bash
# Run by conda-build in the sources; see meta.yaml for what was tested.
set -euo pipefail
cmake -S . -B build-conda -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DCMAKE_INSTALL_PREFIX="$PREFIX" \
  -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_PREFIX_PATH="$PREFIX"
cmake --build build-conda -j "${CPU_COUNT:-2}" --target scarp scarp_program scarp_c
cmake --install build-conda
# The package for Python finds the library in PREFIX/lib by its name.
cp -r bindings/python/src/scarp "$SP_DIR/"
cd bindings/python
"$PYTHON" -B -c 'import backend, sys; backend.prepare_metadata_for_build_wheel(sys.argv[1])' "$SP_DIR"
