#!/usr/bin/env bash
# The page of docs/guide/globe.md in a browser, as it stands, beside tiles that scarp serve serves.
source "$(dirname "$0")/lib.sh"
need python3 gdallocationinfo node chromium
npm_judges cesium playwright-core || skip "npm could not fetch CesiumJS"
shots=${SCARP_SHOTS:-$scratch/shots}
mkdir -p "$shots"
succeeds "$scarp" tile "$dem" globe --vertical egm96 -q --report r.json
trap 'kill $servers 2> /dev/null; rm -rf "$root"' EXIT
servers=
# serve OUTPUT COMMAND...: a server whose address is the last word of a line of OUTPUT.
serve() {
  local output=$1
  shift
  "$@" > "$output" &
  servers="$servers $!"
  for _ in $(seq 400); do grep -qs "http://" "$output" && break; sleep 0.05; done
}
address_of() { grep -o 'http://[^ ]*/$' "$1"; }
serve packages "$python_program" "$SCARP_SOURCE/tools/globe/serve.py" "$js/node_modules" 0
# What the pages ask of other hosts comes from npm's packages.
python3 - "$SCARP_SOURCE/docs/guide/globe.md" "$(address_of packages)" << 'E2'
import re, sys
guide, packages = open(sys.argv[1], encoding="utf-8").read(), sys.argv[2]
pages = re.findall(r"```html\n(.*?)```", guide, re.DOTALL)
for name, page in zip(["globe/page.html"], pages, strict=True):
    page = page.replace("https://cesium.com/downloads/cesiumjs/releases/1.140/", packages + "cesium/")
    open(name, "w", encoding="utf-8").write(page)
E2
serve folder "$scarp" serve globe --port 0
succeeds node "$js/guide.mjs" -84.25,36.3 "$shots" "$(command -v chromium)" "$(address_of folder)page.html"
cp "$logs/out" answers.json
# The sea lies 31 m below the ellipsoid here.
wanted=$(gdallocationinfo -valonly -wgs84 "$dem" -84.25 36.3)
python3 - "$wanted" << 'E2'
import json, sys
answers, levels = json.load(open("answers.json")), json.load(open("r.json"))["levels"]
print(answers)
for answer in answers:
    assert not answer["errors"], answer
    assert abs(answer["height"] - (float(sys.argv[1]) - 31)) <= levels[8]["bound"], (answer, sys.argv)
E2
