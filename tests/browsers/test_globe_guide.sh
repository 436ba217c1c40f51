#!/usr/bin/env bash
# The unchanged page of docs/guide/globe.md in a browser, with tiles from scarp serve; its lines for 3D Tiles and nginx,
# and the three.js lines of globe.md and games.md.
source "$(dirname "$0")/../program/lib.sh"
need python3 gdallocationinfo node "$browser"
npm_judges cesium playwright-core || skip "npm could not fetch CesiumJS"
shots=${SCARP_SHOTS:-$scratch/shots}
mkdir -p "$shots"
succeeds "$scarp" tile "$dem" globe --vertical egm96 -q --report r.json
trap 'kill $servers 2> /dev/null; rm -rf "$root"' EXIT
servers=
# serve OUTPUT COMMAND...: a server whose address ends a line of OUTPUT.
serve() {
  local output=$1
  shift
  "$@" > "$output" &
  servers="$servers $!"
  await $! grep -qs "http://" "$output"
}
address_of() { grep -o 'http://[^ ]*/$' "$1"; }
serve packages "$python_program" "$SCARP_SOURCE/tools/globe/serve.py" "$js/node_modules" 0
# Requests of the pages to other hosts are answered from npm's packages.
python3 - "$SCARP_SOURCE/docs/guide/globe.md" "$(address_of packages)" << 'E2'
import re, sys
guide, packages = open(sys.argv[1], encoding="utf-8").read(), sys.argv[2]
pages = re.findall(r"```html\n(.*?)```", guide, re.DOTALL)
for name, page in zip(["globe/page.html"], pages, strict=True):
    page = page.replace("https://cesium.com/downloads/cesiumjs/releases/1.140/", packages + "cesium/")
    open(name, "w", encoding="utf-8").write(page)
E2
# The same page with the lines for 3D Tiles.
succeeds "$scarp" tile "$dem" city --of 3dtiles --vertical egm96 -q
serve tileset "$scarp" serve city --port 0
blocks=$SCARP_SOURCE/tools/guide_blocks.py
python3 "$blocks" "$SCARP_SOURCE/docs/guide/globe.md" js 0 | sed "s#http://127.0.0.1:8080/#$(address_of tileset)#" > lines
sed -e '/^  window.viewer = viewer;/{r lines
N}' globe/page.html > globe/city.html
grep -q Cesium3DTileset globe/city.html || fail "the page has no place for the lines of 3D Tiles"
serve folder "$scarp" serve globe --port 0
succeeds node "$js/guide.mjs" -84.25,36.3 "$shots" "$browser" "$(address_of folder)page.html" "$(address_of folder)city.html"
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

# Another server accepts the lines for nginx.
if command -v nginx > /dev/null || [ -x /usr/sbin/nginx ]; then
  {
    printf 'pid %s/pid;\nerror_log stderr;\nevents {}\nhttp {\nserver {\nlisten unix:%s/socket;\nroot %s/globe;\n' "$PWD" "$PWD" "$PWD"
    python3 "$blocks" "$SCARP_SOURCE/docs/guide/globe.md" nginx
    printf '}\n}\n'
  } > nginx.conf
  PATH=$PATH:/usr/sbin try nginx -t -q -e stderr -p "$PWD" -c "$PWD/nginx.conf"
  [ "$code" = 0 ] || fail "nginx does not understand the guide's lines"
else
  echo "left out: nginx (not installed)"
fi

# three.js: a GLB, also compressed, and a local tileset.
npm_judges three 3d-tiles-renderer esbuild || skip "npm could not fetch three.js"
mkdir three
cp "$js/guide_scene.mjs" three/
python3 "$blocks" "$SCARP_SOURCE/docs/guide/games.md" js > three/games.mjs
{ python3 "$blocks" "$SCARP_SOURCE/docs/guide/globe.md" js 1; echo 'window.tiles = tiles;'; } > three/tiles.mjs
succeeds "$scarp" simplify "$dem" three/terrain.glb -t 20k --normals --uvs -q
mkdir packed
succeeds "$scarp" simplify "$dem" packed/terrain.glb -t 20k --normals --compress -q
succeeds gdalwarp -q -t_srs EPSG:32616 -r cubic -dstnodata -9999 "$dem" city_utm.tif
succeeds "$scarp" tile city_utm.tif three/town --grid local --vertical egm96 -q
for page in games tiles; do
  printf 'import "./guide_scene.mjs";\nimport "./%s.mjs";\n' $page > three/$page.js
  NODE_PATH=$js/node_modules succeeds "$js/node_modules/.bin/esbuild" three/$page.js --bundle --format=esm --log-level=warning --outfile=three/$page.bundle.js
  printf '<!doctype html><meta charset=utf-8><link rel=icon href=data:,><body><script type=module src=%s.bundle.js></script>' $page > three/$page.html
done
cp three/games.* packed/
serve scenes "$python_program" "$SCARP_SOURCE/tools/globe/serve.py" . 0
at=$(address_of scenes)
succeeds node "$js/guide_three.mjs" "$shots" "$browser" "${at}three/games.html" "${at}packed/games.html" "${at}three/tiles.html"
cp "$logs/out" scenes.json
python3 - << 'E2'
import json
answers = json.load(open("scenes.json"))
print(answers)
assert len(answers) == 3
for answer in answers:
    assert not answer["errors"] and answer["drawn"] > 0.02, answer
E2
