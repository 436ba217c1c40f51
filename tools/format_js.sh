#!/bin/bash
# Formats JavaScript and TypeScript by prettier, in the style of .prettierrc.
#
# usage: tools/format_js.sh --write|--check [PRETTIER]      PRETTIER: the program; without it npx fetches the version
# that tests/js/package.json names. --check changes no file and fails if one is not formatted.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ $# -gt 1 ]; then
  prettier=("$2")
else
  prettier=(npx --yes "prettier@$(sed -n 's/.*"prettier": "\(.*\)".*/\1/p' tests/js/package.json)")
fi
"${prettier[@]}" "$1" --log-level warn --no-error-on-unmatched-pattern \
  '{bench,bindings,examples,tests,tools,web}/**/*.{js,mjs,cjs,ts,mts}'
