#!/bin/bash
# JavaScript and TypeScript are formatted by prettier (make format) and use camelCase; planted lines are found.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
npm_judges prettier || skip "npm could not fetch prettier"

# snake_case TREE: prints snake_case declarations in it.
snake_case() {
  grep -rnE --include='*.'{js,mjs,cjs,ts,mts} --exclude-dir=node_modules \
    '^[^/*]*\b(const|let|function|async) +[a-z][A-Za-z0-9]*_|^ +[a-z][A-Za-z0-9]*_\w*\([^)]*\) \{$' \
    "$1"/{bench,bindings,tests,web} | grep -vE 'bindings/wasm/package/module\.js:[0-9]+:  (clock|environ|emscripten)_'
}

succeeds "$SCARP_SOURCE/tools/format_js.sh" --check "$js/node_modules/.bin/prettier"
! snake_case "$SCARP_SOURCE" || fail "these names are not in camelCase"

mkdir -p tree/{bench,bindings,tests,tools,web}
cp "$SCARP_SOURCE/.prettierrc" tree/
cp "$SCARP_SOURCE/tools/format_js.sh" tree/tools/
printf "const fine = 'text';\n" > tree/web/fine.js
printf 'const planted = "text"\n' > tree/tests/planted.mjs
try tree/tools/format_js.sh --check "$js/node_modules/.bin/prettier"
[ "$code" = 1 ] && grep -q tests/planted.mjs "$logs/err" || fail "a file that is not formatted was not noticed"
! grep -q fine.js "$logs/err" || fail "a formatted file is refused"
succeeds tree/tools/format_js.sh --write "$js/node_modules/.bin/prettier"
[ "$(cat tree/tests/planted.mjs)" = "const planted = 'text';" ] || fail "the file was not formatted"
! snake_case tree || fail "camelCase is refused"
printf 'function of_planted() {}\n' > tree/web/planted.js
snake_case tree > /dev/null || fail "a name in snake_case was not noticed"
echo "JavaScript is formatted, and named in camelCase"
