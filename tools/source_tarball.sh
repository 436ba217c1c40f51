#!/bin/bash
# Packs the sources of this checkout: tracked files and new ones that are not ignored. The same tree gives the same
# bytes. Prints the path.
#
# usage: tools/source_tarball.sh FOLDER
set -euo pipefail
mkdir -p "$1"
folder=$(realpath "$1")
cd "$(dirname "$0")/.."
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || { echo "$0: needs a checkout of git" >&2; exit 1; }
version=$(sed -n 's/^project(scarp VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
out=$folder/scarp-$version-source.tar.gz
# Removed files that are not committed are listed, too.
git ls-files -zco --exclude-standard | while IFS= read -rd '' file; do
  if [ -e "$file" ]; then printf '%s\0' "$file"; fi
done | LC_ALL=C sort -zu | tar -c --format=gnu --no-recursion --transform="s,^,scarp-$version/," --owner=0 --group=0 \
  --numeric-owner --mode=u+rw,go+r-w --mtime="@$(git log -1 --format=%ct)" --null --files-from=- | gzip -9n >"$out.part"
mv "$out.part" "$out"
echo "$out"
