#!/usr/bin/env bash
# view: the page and its refusals; then a real browser opens it from disk: the numbers of measure, no request, no error of
# the console, axe-core, damaged files, a browser without WebAssembly. SCARP_SHOTS=FOLDER keeps the pictures.
source "$(dirname "$0")/lib.sh"
need python3 node npm
"$SCARP_SOURCE/tools/build_viewer.sh" "$SCARP_BUILD" > build.log 2>&1 || skip "the viewer's page cannot be built: $(tail -1 build.log)"
shots=${SCARP_SHOTS:-$scratch/shots}
mkdir -p "$shots"

succeeds "$scarp" simplify "$dem" plain.glb -e 20 -q
succeeds "$scarp" simplify "$dem" packed.glb -e 5 --compress --html by_simplify.html
grep -qF by_simplify.html "$logs/out" || fail "the summary does not name the page"
succeeds "$scarp" simplify "$dem" levels.glb -e 5 --lods 3:4 --html levels.html -q
succeeds "$scarp" simplify "$dem" plain.obj -e 20 --crs source -q
succeeds "$scarp" simplify "$dem" bent.glb -e 20 --crs EPSG:32616 -q

# The page: beside the mesh, or where -o says; nothing is replaced.
succeeds "$scarp" view plain.glb "$dem"
grep -q '^plain.html: .* open it in a browser$' "$logs/out" || fail "the page is not named: $(cat "$logs/out")"
refuses 4 'plain.html' "$scarp" view plain.glb "$dem"
succeeds "$scarp" view plain.glb "$dem" --overwrite -q
[ ! -s "$logs/out" ] || fail "-q is not quiet"
succeeds "$scarp" view plain.glb -o alone.html
succeeds "$scarp" view plain.obj "$dem" -o obj.html
succeeds "$scarp" view levels_lod0.glb "$dem"
succeeds "$scarp" view bent.glb "$dem"
grep -q 'holds no raster' "$logs/err" || fail "a raster that is left out is not told"
succeeds "$scarp" view plain.glb "$dem" -o - -q
cmp "$logs/out" plain.html || fail "standard output holds another page"
mkdir tools
printf '#!/bin/sh\nprintf "%%s" "$1" > opened\n' > tools/xdg-open
chmod +x tools/xdg-open
PATH=$PWD/tools:$PATH succeeds "$scarp" view plain.glb -o opened.html --open
[ "$(cat opened)" = "$PWD/opened.html" ] || fail "another page was opened: $(cat opened)"
printf '#!/bin/sh\nexit 3\n' > tools/xdg-open
PATH=$PWD/tools:$PATH try "$scarp" view plain.glb -o opened.html --open --overwrite
[ "$code" = 4 ] && grep -q 'open it in a browser' "$logs/err" || fail "a browser that does not open is not told"
refuses 2 'no_such.glb' "$scarp" view no_such.glb
refuses 2 'no_such.tif' "$scarp" view plain.glb no_such.tif -o x.html
refuses 1 '--html cannot be combined with --solid' "$scarp" simplify "$dem" x.stl -e 20 --solid size=100mm --html x.html
# Elsewhere, without its page: a sentence that tells how to build it.
mkdir -p other/bin
cp "$scarp" other/bin/
refuses 2 "'make viewer'" other/bin/scarp view plain.glb -o x.html
# Not more than text: what a name holds begins no script.
cp plain.glb '<!--<script>.glb'
succeeds "$scarp" view '<!--<script>.glb' -o name.html
if grep -qF '<!--<script>' name.html; then fail "a name begins a script"; fi

# Of Python: the same mesh and raster.
library=$SCARP_BUILD/bindings/c/libscarp_c.so
if [ -e "$library" ] && /usr/bin/python3 -c 'import numpy, rasterio' 2> /dev/null; then
  PATH=$SCARP_BUILD/bin:$PATH PYTHONPATH=$SCARP_SOURCE/bindings/python/src PYTHONDONTWRITEBYTECODE=1 SCARP_LIBRARY=$library succeeds /usr/bin/python3 -c '
import scarp, sys
print(scarp.simplify(sys.argv[1], 20).view(sys.argv[1], "python.html", open=False))' "$dem"
else
  echo "left out: Mesh.view() of Python (needs the C library, numpy and rasterio)"
fi

need chromium
npm_judges playwright-core axe-core || skip "npm could not fetch playwright-core and axe-core"
for name in plain packed; do
  succeeds "$scarp" measure "$dem" $name.glb --json
  cp "$logs/out" $name.json
done
succeeds "$scarp" measure "$dem" levels_lod2.glb --json
cp "$logs/out" level2.json

# Damaged files to drop: cut off, no GLB, a vertex that is NaN, a triangle that names no vertex.
head -c 4000 plain.glb > cut.glb
head -c 4000 "$dem" > other.glb
cp "$dem" raster.tif
python3 - << 'E2'
import json, struct
plain = bytearray(open("plain.glb", "rb").read())
length = struct.unpack_from("<I", plain, 12)[0]
binary = 20 + length + 8
views = json.loads(plain[20:20 + length])["bufferViews"]
broken = bytearray(plain)
struct.pack_into("<f", broken, binary + 12 * 17, float("nan"))
open("nan.glb", "wb").write(broken)
broken = bytearray(plain)
struct.pack_into("<H", broken, binary + views[1]["byteOffset"], 65535)
open("index.glb", "wb").write(broken)
E2

cat > judge.py << 'E2'
import json, os, sys
READ = "[document.getElementById('readout').innerText, document.title]"
READY = "window.scarp_page?.drawn > 0"
NOTICE = "document.getElementById('notice').hidden ? '' : document.getElementById('notice').textContent"
jobs, checks = [], []


def job(check, name, steps, axe=False, **words):
    jobs.append({"page": os.path.abspath(name), "steps": steps, "axe": axe, **words})
    checks.append(check)


def told(report):
    """What the readout says, as `measure` knows it."""
    words = json.load(open(report))
    unit = words["input"]["unit"]
    six = lambda value: repr(float(f"{value:.6g}")).removesuffix(".0") + (f" {unit}" if unit else "")
    return {"triangles": f"{words['triangles']:,}", "max error": six(words["max_error"]), "RMSE": six(words["rmse"]),
            "samples judged": f"{words['samples']:,}", "at column, row": ", ".join(map(str, words["max_error_at"]))}


def same(report, text):
    lines = text.split("\n")
    found = dict(zip(lines[::2], lines[1::2]))
    for key, value in told(report).items():
        assert found.get(key) == value, (key, found.get(key), value)


def plain(values):
    same("plain.json", values[0][0])
    assert values[0][1] == "plain.glb", values[0]
    picture, wire, errors, after, profile, shared, state = values[1:]
    assert wire != picture and errors != wire and after != errors, "a key changes nothing"
    assert "Distance" in profile[0] and "slope" in profile[0] and profile[1] > 50 and profile[2] > 50, profile
    assert shared > 0, "no PNG"
    assert "errors=1" in state and "view=" in state, state


CANVAS = "document.getElementById('canvas').toDataURL()"
MEASURED = ("[document.getElementById('measured-text').textContent, (document.querySelector('#profile .mesh')?.getAttribute('d') ?? '')"
            ".split('L').length, document.getElementById('profile').getBoundingClientRect().height]")
job(plain, "plain.html", [
    {"until": READY, "read": READ, "shot": "light"},
    {"read": CANVAS},
    {"keys": ["w"], "until": "scarp_page.scene.views[0].edges.visible", "read": CANVAS, "shot": "wireframe"},
    {"keys": ["w", "e"], "until": "scarp_page.scene.views[0].uniforms.errors.value", "read": CANVAS, "shot": "errors"},
    {"keys": ["ArrowLeft", "ArrowUp", "PageUp"], "until": "!scarp_page.scene.asked", "read": CANVAS},
    {"keys": ["r", "m"], "clicks": [[600, 330], [800, 450]], "until": "scarp_page.measuring.points.length === 2", "read": MEASURED,
     "shot": "profile"},
    {"do": "scarp_page.scene.png().then(blob => blob.size)"},
    {"until": "location.hash.includes('errors=1')", "read": "location.hash"}], axe=True)


def restored(values):
    errors, exaggeration, orbit, words = values[0]
    assert errors and exaggeration == 3, values
    assert all(abs(a - b) < 0.01 for a, b in zip(orbit, (30, 45, 20000))), orbit
    assert "3 ×" in words, words


job(restored, "plain.html", [
    {"until": READY, "read": "[scarp_page.look.errors, scarp_page.look.exaggeration, (o => [o.azimuth, o.altitude, o.distance])"
                             "(scarp_page.scene.orbit()), document.getElementById('panel').innerText]", "shot": "fragment"}],
    fragment="#errors=1&exaggeration=3&view=30,45,20000,0,0,0")
job(lambda values: same("packed.json", values[0][0]), "by_simplify.html", [{"until": READY, "read": READ, "shot": "dark"}], axe=True, dark=True)


def levels(values):
    assert values[0] == 3, values
    same("level2.json", values[1][0])


job(levels, "levels_lod0.html", [
    {"until": READY, "read": "scarp_page.document.levels.length", "shot": "phone"},
    {"keys": ["-", "+", "+"], "after": "document.getElementById('fold').click()"},
    {"read": READ, "shot": "phone_controls"}], axe=True, width=390, height=780)
job(lambda values: same("plain.json", values[0][0]), "obj.html", [{"until": READY, "read": READ}])


if os.path.exists("python.html"):
    job(lambda values: same("plain.json", values[0][0]), "python.html", [{"until": READY, "read": READ}])


def named(values):
    assert values[0][1] == "<!--<script>.glb", values


job(named, "name.html", [{"until": READY, "read": READ}])


def alone(values):
    assert "its file says" in values[0][0] and "samples judged" not in values[0][0], values


job(alone, "alone.html", [{"until": READY, "read": READ}])


def sentences(values):
    for name, words in (("cut.glb", "cut off"), ("other.glb", "no GLB file"), ("nan.glb", "Vertex 17"), ("index.glb", "vertex 65535"),
                        ("raster.tif", "no GLB file")):
        told = values.pop(0)
        assert name in told and words in told, (name, told)
    same("packed.json", values[0][0])  # a good file is shown after them, and judged by the same raster
    assert values[1] == "", values


job(sentences, "plain.html", [{"until": READY}] + [
    {"drop": [{"name": name, "path": os.path.abspath(name)}], "until": NOTICE,
     "read": NOTICE, "after": "document.getElementById('notice').hidden = true"} for name in ("cut.glb", "other.glb", "nan.glb", "index.glb", "raster.tif")] + [
    {"drop": [{"name": "packed.glb", "path": os.path.abspath("packed.glb")}], "until": "document.title === 'packed.glb'", "read": READ},
    {"read": NOTICE}])
job(lambda values: values[0].index("refuses WebAssembly"), "by_simplify.html", [{"until": NOTICE, "read": NOTICE, "shot": "refused"}],
    before="delete window.WebAssembly")
job(lambda values: values[0].index("WebGL"), "plain.html", [{"until": NOTICE, "read": NOTICE}],
    before="HTMLCanvasElement.prototype.getContext = () => null", errors_are_expected=True)
empty = open(os.environ["SCARP_BUILD"] + "/share/scarp/viewer.html").read()
open("empty.html", "w").write(empty)
job(lambda values: values[0].index("holds no mesh"), "empty.html", [{"until": NOTICE, "read": NOTICE}])


def loads(values):
    first, last = values[0]
    assert first == last and 0 < last["geometries"] < 10, values


# Each load replaces what the last one holds.
job(loads, "plain.html", [{"until": READY}, {"do": """(async () => {
  const data = JSON.parse(document.getElementById('scarp-data').textContent), page = scarp_page, memory = page.scene.renderer.info.memory;
  const buffer = Uint8Array.from(atob(data.meshes[0].glb), letter => letter.charCodeAt(0)).buffer, seen = [];
  for (let k = 0; k < 50; ++k) {
    await page.load([new File([buffer], 'again.glb')]);
    page.change({errors: true, edges: true});
    page.scene.draw();
    if (k === 9 || k === 49) seen.push({geometries: memory.geometries, textures: memory.textures, programs: page.scene.renderer.info.programs.length});
  }
  return seen;
})()"""}], width=300, height=200)

if sys.argv[1:] == ["jobs"]:
    print(json.dumps(jobs))
else:
    for job, check, answer in zip(jobs, checks, json.load(open("answers.json")), strict=True):
        assert "failed" not in answer, answer
        assert not answer["elsewhere"], answer["elsewhere"]
        assert job.get("errors_are_expected") or not answer["errors"], answer["errors"]
        assert not answer["violations"], answer["violations"]
        check(answer["values"])
        print(os.path.basename(job["page"]), "ok")
E2
python3 judge.py jobs > jobs.json
succeeds node "$js/viewer.mjs" jobs.json "$shots" "$(command -v chromium)"
cp "$logs/out" answers.json
python3 judge.py
