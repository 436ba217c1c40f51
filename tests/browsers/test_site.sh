#!/usr/bin/env bash
# The static site: all links and pictures exist, and a browser opens its pages from disk without external requests.
source "$(dirname "$0")/../program/lib.sh"
need python3 node npm
[ -e "$SCARP_BUILD-wasm/npm/inline-data.js" ] || skip "needs the engine of make npm"
"$SCARP_SOURCE/tools/build_viewer.sh" "$SCARP_BUILD" > build.log 2>&1 || skip "the viewer's page cannot be built: $(tail -1 build.log)"
succeeds "$SCARP_SOURCE/tools/build_site.sh" "$SCARP_BUILD" site
python3 - << 'E2'
import html.parser, pathlib
site, links = pathlib.Path("site"), 0


class Links(html.parser.HTMLParser):
    def handle_starttag(self, tag, attributes):
        global links
        for name, value in attributes:
            if name in ("href", "src") and ":" not in value.split("/")[0]:
                path = (self.page.parent / value.split("#")[0]) if value.split("#")[0] else self.page
                assert path.exists(), (self.page, value)
                links += 1


pages = [page for page in site.rglob("*.html") if page.name not in ("try.html", "example.html", "dig.html")]
for page in pages:
    reader = Links()
    reader.page = page
    reader.feed(page.read_text())
assert len(pages) > 20 and links > 300, (len(pages), links)
print(len(pages), "pages,", links, "links")
E2
need "$browser"
npm_judges playwright-core axe-core || skip "npm could not fetch playwright-core and axe-core"
python3 - > jobs.json << 'E2'
import json, os
folder = os.path.abspath("site")
ready = {"until": "document.readyState === 'complete'"}
jobs = [{"page": f"{folder}/{name}", "folder": folder, "steps": [ready | {"shot": os.path.basename(name)}], "axe": True, "dark": dark}
        for name, dark in (("index.html", False), ("docs/guide/viewer.html", True))]
jobs.append({"page": f"{folder}/try.html", "steps": [{"until": "!document.getElementById('notice').hidden", "read": "document.getElementById('notice').textContent"}]})
jobs.append({"page": f"{folder}/example.html", "steps": [{"until": "window.scarpPage?.drawn > 0", "read": "document.title"}]})
# Strokes of each tool, at a border and in a corner, and a coarser mesh: the page's numbers against its field's.
DIG = """(() => {
  const {stroke, heights, live} = digPage, read = id => document.getElementById(id).textContent;
  for (const [x, y, metres] of [[200, 200, -0.6], [205, 204, -0.6], [0, 300, 0.6], [512, 512, 0.6], [256.5, 256.5, 0]]) stroke(x, y, 14, metres);
  const changed = Number(read('changed').replaceAll(',', '')), fine = live().triangleCount, same = live().heights().every((z, k) => z === heights()[k]);
  document.getElementById('error').value = 1;
  document.getElementById('error').dispatchEvent(new Event('change'));
  return [parseFloat(read('milliseconds')) > 0, changed, fine, live().triangleCount, live().maxError, parseFloat(read('largest')), same];
})()"""
jobs.append({"page": f"{folder}/dig.html", "steps": [{"until": "window.digPage !== undefined", "shot": "dig"},
             {"clicks": [[700, 400]], "read": "digPage.live().maxError"}, {"do": DIG, "shot": "dug"}], "axe": True})
print(json.dumps(jobs))
E2
succeeds node "$js/viewer.mjs" jobs.json "${SCARP_SHOTS-}" "$browser"
python3 - "$logs/out" << 'E2'
import json, sys
answers = json.load(open(sys.argv[1]))
for answer in answers:
    assert "failed" not in answer and not answer["errors"] and not answer["elsewhere"] and not answer["violations"], answer
assert "Drop a GeoTIFF" in answers[2]["values"][0] and answers[3]["values"] == ["jacksboro.glb"], answers
first, (took, changed, fine, coarse, error, told, same) = answers[4]["values"]
print(answers[4]["values"])
assert first <= 0.25 and took and 0 < changed < fine / 20 and coarse < 0.6 * fine and error <= 1 and abs(told - error) < 0.001 and same, answers[4]
E2
