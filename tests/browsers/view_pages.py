# The queries to the browser about each page of test_view.sh, and checks of its answers: view_pages.py [jobs].
import base64, functools, json, os, subprocess, sys
READ = "[document.getElementById('readout').innerText, document.title]"
JUDGED = "scarpPage.shown.every(terrain => terrain.isJudged)"
READY = "window.scarpPage?.drawn > 0 && !document.body.classList.contains('empty') && " + JUDGED
NOTICE = "document.getElementById('notice').hidden ? '' : document.getElementById('notice').textContent"
jobs, checks = [], []


def job(check, name, steps, axe=False, **words):
    jobs.append({"page": os.path.abspath(name), "steps": steps, "axe": axe, **words})
    checks.append(check)


def told(report):
    """The readout, from the report of `measure`."""
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
    picture, wire, errors, after, moved, profile, shared, state = values[1:]
    assert [abs(moved[0][0]) < 1e-6, moved[0][1] > 0, moved[1] < 0, moved[2]] == [True, True, True, True], moved
    assert wire != picture and errors != wire and after != errors, "a key changes nothing"
    assert "Distance" in profile[0] and "slope" in profile[0] and profile[1] > 50 and profile[2] > 50, profile
    assert shared > 0, "no PNG"
    assert "errors=1" in state and "view=" in state, state


CANVAS = "document.getElementById('canvas').toDataURL()"
# Ahead is north there: one step right and two back end south-east of the middle, at the same distance.
MOVED = """(first => {
  const press = key => dispatchEvent(new KeyboardEvent('keydown', {key, shiftKey: true})), far = scarpPage.scene.orbit().distance;
  for (const key of ['ArrowRight', 'ArrowDown', 'ArrowDown']) press(key);
  const {target: [x, y, z], distance} = scarpPage.scene.orbit();
  return [first, y / x, x > 0 && Math.abs(x + y) < 1e-6 * x && z === 0 && Math.abs(distance / far - 1) < 1e-6];
})(scarpPage.scene.orbit().target)"""
MEASURED = ("[document.getElementById('measured-text').textContent, (document.querySelector('#profile .mesh')?.getAttribute('d') ?? '')"
            ".split('L').length, document.getElementById('profile').getBoundingClientRect().height]")
job(plain, "plain.html", [
    {"until": READY, "read": READ, "shot": "light"},
    {"read": CANVAS},
    {"keys": ["w"], "until": "scarpPage.scene.views[0].edges.visible", "read": CANVAS, "shot": "wireframe"},
    {"keys": ["w", "e"], "until": "scarpPage.scene.views[0].uniforms.errors.value", "read": CANVAS, "shot": "errors"},
    {"keys": ["ArrowLeft", "ArrowUp", "PageUp"], "until": "!scarpPage.scene.asked", "read": CANVAS},
    {"keys": ["r"], "after": "scarpPage.scene.setOrbit({...scarpPage.scene.orbit(), azimuth: 0})"}, {"keys": ["Shift+ArrowUp"], "read": MOVED},
    {"keys": ["r", "m"], "clicks": [[600, 330], [800, 450]], "until": "scarpPage.measuring.points.length === 2", "read": MEASURED,
     "shot": "profile"},
    {"do": "scarpPage.scene.png().then(blob => blob.size)"},
    {"until": "location.hash.includes('errors=1')", "read": "location.hash"}], axe=True)


def restored(values):
    errors, smooth, exaggeration, orbit, words = values[0]
    assert errors and smooth and exaggeration == 3, values
    assert all(abs(a - b) < 0.01 for a, b in zip(orbit, (30, 45, 20000))), orbit
    assert "3 ×" in words, words


job(restored, "plain.html", [
    {"until": READY, "read": "[scarpPage.look.errors, scarpPage.look.smooth, scarpPage.look.exaggeration, (o => [o.azimuth, o.altitude, o.distance])"
                             "(scarpPage.scene.orbit()), document.getElementById('panel').innerText]", "shot": "fragment"}],
    fragment="#errors=1&smooth=1&exaggeration=3&view=30,45,20000,0,0,0")


def unmoved(values):
    exaggeration, orbit, sun, shown, first = values[0]
    assert exaggeration == 1 and sun == [315, 40] and shown == 1 and orbit == first, values


# A value that is not a number in its range does not change the page's initial state.
for fragment in ("#view=0,0,0,0,0,0&exaggeration=1,2&azimuth=NaN&altitude=&level=x", "#view=,,,,,&exaggeration=1e300", "#view=1e300,1,1,1,1,1&constructor=1"):
    job(unmoved, "plain.html", [{"until": READY, "read": "[scarpPage.look.exaggeration, Object.values(scarpPage.scene.orbit()).flat().map(x => x.toFixed(4)),"
                                 " Object.values(scarpPage.look.sun), scarpPage.level + 1, (scarpPage.scene.reset(), Object.values(scarpPage.scene.orbit()).flat()"
                                 ".map(x => x.toFixed(4)))]"}], fragment=fragment, width=400, height=300)
job(lambda values: values[0].index("gradient"), "plain.html", [{"until": READY, "read": "getComputedStyle(document.getElementById('legend-bar')).backgroundImage", "shot": "forced"}],
    forced_colors=True, axe=True)
job(lambda values: values[0] == ["none", "none"] and values[0], "plain.html", [
    {"read": "['main', '#panel'].map(name => getComputedStyle(document.querySelector(name)).display)", "shot": "no_script"}], no_script=True)
job(lambda values: same("packed.json", values[0][0]), "by_simplify.html", [{"until": READY, "read": READ, "shot": "dark"}], axe=True, dark=True)


def levels(values):
    count, (left, right, top, bottom) = values[0]
    assert count == 3 and left > 0 and right < 390 and top > 0 and bottom < 780, values[0]  # everything is visible
    same("level2.json", values[2][0])
    # With the engine the slider starts at the level's error.
    without_engine, error = values[3]
    assert without_engine or abs(float(error) / json.load(open("level2.json"))["max_error"] - 1) < 0.01, values[3]


job(levels, "levels_lod0.html", [
    {"until": READY, "read": "[scarpPage.document.levels.length, (() => { const at = scarpPage.shown[0].scene, found = [[], []]; for (let v = 0; v < at.length; v += 3)"
                             " scarpPage.scene.project(at.subarray(v, v + 3)).forEach((value, k) => found[k].push(value));"
                             " return found.flatMap(values => [Math.min(...values), Math.max(...values)]); })()]", "shot": "phone"},
    {"do": "(slider => { slider.value = '2'; slider.dispatchEvent(new Event('input')); })(document.getElementById('level'))",
     "after": "document.getElementById('fold').click()"},
    {"until": JUDGED, "read": READ, "shot": "phone_controls"}, {"read": "[document.getElementById('slider-row').hidden, parseFloat(document.getElementById('error-text').textContent)]"}], axe=True, width=390, height=780)


def tile_levels(name, values):
    page = open(f"{name}.html").read()
    meshes = json.loads(page.split('id="scarp-data">')[1].split("</script>")[0])["meshes"]
    held, kept = (sum(sizes) for sizes in zip(*((len(mesh["glb"]), mesh["bytes"]) for mesh in meshes)))
    assert held < 1.5 * kept, (held, kept)
    levels, notes, reaches = values[0]
    assert len(levels) > 2 and all(0 < coarse < fine for (_, fine), (_, coarse) in zip(levels, levels[1:])), levels
    numbers = [int(name.split()[-1]) for name, _ in levels]
    assert numbers == list(range(numbers[0], numbers[0] - len(levels), -1)), levels
    assert "flat map" in notes and "scarp view MESH RASTER" not in notes, notes
    # The raster is 30 km wide; its heights above the ellipsoid are 30 m lower here.
    assert 15000 < reaches[0] < 60000 and reaches == sorted(reaches), reaches
    assert 980 < values[1] < 1070, values[1]
    assert all(outer > 0 and cracks == 0 for outer, cracks in values[2]), values[2]


TILES = ("[scarpPage.document.levels.map(l => [l.name, l.triangles]), document.getElementById('notes').textContent,"
         " scarpPage.document.levels.map(l => l.reach)]")
# Edges of only one triangle, except those around all tiles of a level.
CRACKS = """scarpPage.document.levels.map(({positions, indices, firsts}) => {
  const used = new Map(), corner = k => firsts[indices[k]], ends = [0, 1].map(c => positions.reduce(([low, high], value, k) => k % 3 === c ? [Math.min(low, value), Math.max(high, value)] : [low, high], [Infinity, -Infinity]));
  const is_outer = (a, b) => [0, 1].some(c => ends[c].some(end => [a, b].every(v => Math.abs(positions[3 * v + c] - end) < 1e-3 * (ends[c][1] - ends[c][0]))));
  indices.forEach((_, k) => {
    const pair = [corner(k), corner(k % 3 === 2 ? k - 2 : k + 1)].sort((a, b) => a - b);
    used.set(String(pair), [...(used.get(String(pair)) ?? []), pair]);
  });
  const open = [...used.values()].filter(found => found.length === 1);
  return [open.length, open.filter(([[a, b]]) => !is_outer(a, b)).length];
})"""
TOP = "scarpPage.document.place.high[2]"
COARSE = "(slider => { slider.value = '2'; slider.dispatchEvent(new Event('input')); })(document.getElementById('level'))"


def plane(values):
    east, north = values[0]
    assert abs(east - 149 * 90) < 2 and abs(north - 149 * 90) < 2, values


job(plane, "plane.html", [{"until": READY, "read": "[0, 1].map(k => scarpPage.document.place.high[k] - scarpPage.document.place.low[k])", "shot": "tiles_plane"}])
for name in ("set", "archive"):
    job(functools.partial(tile_levels, name), f"{name}.html", [
        {"until": READY, "read": TILES, "shot": f"tiles_{name}"}, {"read": TOP}, {"read": CRACKS},
        {"do": COARSE, "until": "scarpPage.level === 2 && !scarpPage.scene.asked", "shot": f"tiles_{name}_coarse"}])
# Colours drawn in the middle of each quarter of the land, north-west, north-east, south-west, south-east, and outside;
# and the parts of the page that show the image.
QUARTERS = """(() => {
  const {scene, shown: [terrain], document: {place}} = scarpPage, land = [0, 1].map(c => terrain.positions.filter((_, k) => k % 3 === c && terrain.positions[k - c + 2] > 100).sort()), picture = document.createElement('canvas'), ratio = scene.canvas.width / scene.canvas.clientWidth;
  scene.draw();
  [picture.width, picture.height] = [scene.canvas.width, scene.canvas.height];
  picture.getContext('2d').drawImage(scene.canvas, 0, 0);
  const between = (k, share) => land[k][0] + share * (land[k].at(-1) - land[k][0]);
  const colors = [[.25, .75], [.75, .75], [.25, .25], [.75, .25], [-.1, -.1]].map(([u, v]) => {
    const [x, y] = [between(0, u), between(1, v)], z = terrain.heightAt(x, y), at = scene.project(place.toScene(x, y, z));
    if (!(z === z)) return 'sky';
    const [red, green, blue] = picture.getContext('2d').getImageData(...at.map(c => c * ratio), 1, 1).data;
    return [red > 1.5 * blue && 'r', green > 1.5 * blue && 'g', blue > 1.5 * green && 'b'].filter(Boolean).join('');
  });
  return [colors.join(' '), !document.getElementById('image-choice').hidden, document.getElementById('image').checked,
    document.getElementById('notes').textContent, picture.toDataURL()];
})()"""

def draped(values):
    finest, relief, again, coarse, sheets = [value for value in values if value]
    assert all(found[:3] == ["r g b rg ", True, True] and "image" not in found[3] for found in (finest, again, coarse)), [found[:4] for found in (finest, again, coarse)]
    assert relief[:3] != finest[:3] and relief[1:3] == [True, False], relief[:4]
    for level in sheets:
        assert sum(with_image for with_image, _ in level) > 1 and len({ground for _, ground in level if ground}) <= 1, sheets
    # The colour of tiles without an image.
    earth = ",".join(str(round(255 * (1.055 * c ** (1 / 2.4) - 0.055))) for c in (0.47, 0.42, 0.33))
    assert sheets[0][0] == [False, earth], sheets[0]


job(draped, "draped.html", [
    {"until": READY, "read": QUARTERS, "shot": "tiles_draped"}, {"keys": ["i"], "read": QUARTERS}, {"keys": ["i"], "read": QUARTERS},
    {"do": COARSE.replace("'2'", "'1'"), "until": "scarpPage.level === 1", "read": QUARTERS, "shot": "tiles_draped_coarse"},
    {"read": "scarpPage.document.levels.map(l => l.sheets.map(s => [Boolean(s.image), s.ground && String(s.ground.map(c => Math.round(255 * c)))]))"}], axe=True)
job(lambda values: same("plain.json", values[0][0]), "obj.html", [{"until": READY, "read": READ}])


if os.path.exists("python.html"):
    job(lambda values: same("plain.json", values[0][0]), "python.html", [{"until": READY, "read": READ}])
    def within(values):
        same("plain.json", values[0][0])
        assert values[-1] is True, "a notice"

    # A page within a page, as in notebooks; it writes no address later.
    job(within, "notebook.html", [
        {"until": "(({contentDocument: page, contentWindow: {scarpPage}}) => page.body && !page.body.classList.contains('empty') && "
                  f"scarpPage?.drawn > 0 && {JUDGED})(document.querySelector('iframe'))",
         "read": READ.replace("document.", "document.querySelector('iframe').contentDocument."), "shot": "notebook"},
        {"do": "new Promise(done => setTimeout(done, 500))"},
        {"read": "document.querySelector('iframe').contentDocument.getElementById('notice').hidden"}])


def named(values):
    assert values[0][1] == "<!--<script>.glb", values


job(named, "name.html", [{"until": READY, "read": READ}])


def alone(values):
    assert "its file says" in values[0][0] and "samples judged" not in values[0][0], values


job(alone, "alone.html", [{"until": READY, "read": READ}])


# The map from above of a mesh without error: white like the middle of the scale.
job(lambda values: values == [[242, 242, 242, 255]] or sys.exit(str(values)), "two.html", [
    {"until": READY}, {"keys": ["e", "w"], "until": "!document.getElementById('map').hidden",
                       "read": "[...document.getElementById('map').getContext('2d').getImageData(0, 0, 1, 1).data]", "shot": "exact"}], axe=True)


def lines(values):
    same("plain.json", values[0][0])
    assert "only triangles are shown" in values[1] and "mode 1" in values[1], values


job(lines, "plain.html", [
    {"until": READY}, {"drop": [{"name": "lines.glb", "path": os.path.abspath("lines.glb")}], "until": "document.title === 'lines.glb' && " + JUDGED, "read": READ},
    {"read": "document.getElementById('notes').textContent"}])


def sentences(values):
    for name, words in (("cut.glb", "cut off"), ("other.glb", "no GLB file"), ("nan.glb", "Vertex 17"), ("index.glb", "vertex 65535"),
                        ("raster.xyz", "no file that this page reads")):
        told = values.pop(0)
        assert name in told and words in told, (name, told)
    same("packed.json", values[0][0])  # then shows a good file, judged by the same raster
    assert values[1] == "", values


job(sentences, "plain.html", [{"until": READY}] + [
    {"drop": [{"name": name, "path": os.path.abspath(name)}], "until": NOTICE,
     "read": NOTICE, "after": "document.getElementById('notice').hidden = true"} for name in ("cut.glb", "other.glb", "nan.glb", "index.glb", "raster.xyz")] + [
    {"drop": [{"name": "packed.glb", "path": os.path.abspath("packed.glb")}], "until": "document.title === 'packed.glb' && " + JUDGED, "read": READ},
    {"read": NOTICE}])
job(lambda values: values[0].index("refuses WebAssembly"), "by_simplify.html", [{"until": NOTICE, "read": NOTICE, "shot": "refused"}],
    before="delete window.WebAssembly")
job(lambda values: values[0].index("WebGL"), "plain.html", [{"until": NOTICE, "read": NOTICE}],
    before="HTMLCanvasElement.prototype.getContext = () => null", errors_are_expected=True)
empty = open(os.environ["SCARP_BUILD"] + "/share/scarp/viewer.html").read()
open("empty.html", "w").write(empty)
job(lambda values: values[0].index("here"), "empty.html", [{"until": NOTICE, "read": NOTICE}])


# The file's normals against those of the triangles: the mean cosine.
NORMALS = """(() => {
  const {terrain, surface: {geometry}} = scarpPage.scene.views[0], given = geometry.attributes.normal.array.slice();
  geometry.computeVertexNormals();
  const own = geometry.attributes.normal.array, count = given.length / 3;
  let sum = 0;
  for (let k = 0; k < own.length; ++k) sum += given[k] * own[k] / Math.hypot(...given.subarray(k - k % 3, k - k % 3 + 3));
  return [terrain.normals !== null, sum / count];
})()"""
UNDER = "r g b rg sky"


def image(values):
    first, smooth, (given, cosine), errors, relief, again, dropped, plain, one, damaged, elsewhere, state = values
    for found in (first, smooth, again, dropped):
        assert found[:3] == [UNDER, True, True] and "image" not in found[3], found[:4]
    assert len({found[4] for found in (first, smooth, errors, relief)}) == 4, "a key changes nothing"
    assert given and 0.9 < cosine < 0.9999, (given, cosine)
    assert errors[1:3] == relief[1:3] == [True, False] and relief[0] != UNDER, (errors[:3], relief[:3])
    for found, words in ((plain, ""), (one, ""), (damaged, "cannot read it (image/png)"), (elsewhere, "does not lie in the file")):
        assert found[0] != UNDER and found[1:3] == [False, False] and words in found[3] and ("image" in found[3]) == bool(words), found[:4]
    assert "smooth=1" in state and "image" not in state, state


def dropped(name):
    return {"drop": [{"name": name, "path": os.path.abspath(name)}], "until": f"document.title === '{name}'", "read": QUARTERS}


job(image, "image.html", [
    {"until": READY, "read": QUARTERS, "shot": "image"},
    {"keys": ["n"], "read": QUARTERS, "shot": "image_smooth"}, {"read": NORMALS},
    {"keys": ["e"], "read": QUARTERS}, {"keys": ["i", "i"], "read": QUARTERS, "shot": "smooth"}, {"keys": ["i"], "read": QUARTERS},
    dropped("packed_image.glb"), dropped("plain.glb"), dropped("places.glb"), dropped("image_damaged.glb"), dropped("image_elsewhere.glb"),
    {"until": "location.hash.includes('smooth=1') && !location.hash.includes('image')", "read": "location.hash"}], axe=True)


def image_kept(values):
    _, mesh, found = values
    assert mesh[1][0] == "greedy" and found[:3] == [UNDER, True, True], (mesh, found[:4])


def loads(values):
    first, last = values[0]
    assert first == last and 0 < last["geometries"] < 10 and last["textures"] >= 2, values


DRAG = ("(slider => { slider.value = String(%d); slider.dispatchEvent(new Event('input')); })(document.getElementById('error'))")
RELEASE = "document.getElementById('error').dispatchEvent(new Event('change'))"
NOW = ("[scarpPage.live.errorOf(scarpPage.live.stepNow), ...scarpPage.shown.map(t => [t.name, t.triangles, t.judged.maxError,"
       " t.judged.uncovered])]")
TEXTS = "['save', 'command-of', 'command-note', 'error-text'].map(id => document.getElementById(id).textContent)"
COMMAND = "({command: document.getElementById('command').textContent, triangles: scarpPage.shown.at(-1).triangles, texts: " + TEXTS + "})"
FORMAT = "(menu => { menu.value = '%s'; menu.dispatchEvent(new Event('change')); })(document.getElementById('format'))"
HIGH = "scarpPage.shown.at(-1).name === 'high' && document.getElementById('progress').hidden"


def kept(asked, mesh, name):
    assert mesh[0] == name and mesh[2] <= asked * (1 + 1e-6) and mesh[3] == 0, (asked, mesh)
    return mesh[1]


PROGRAM = os.environ["SCARP_BUILD"] + "/bin/scarp"


def ask(*words):
    run = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    assert run.returncode == 0, (words, run.stderr)
    return json.loads(run.stdout)


def runs(command, page):
    """The page's command, run in a shell, makes the page's mesh."""
    if os.path.exists("mesh.glb"):
        os.remove("mesh.glb")
    subprocess.run(["sh", "-ec", command + " -q"], check=True, env={"PATH": os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]}, stderr=subprocess.DEVNULL)
    found = json.loads(subprocess.run([PROGRAM, "info", "mesh.glb", "--json"], check=True, capture_output=True, text=True).stdout)
    assert found["mesh"]["triangles"] == page["triangles"], (command, found["mesh"]["triangles"], page)


def live(values):
    (first, coarse), (second, fine), (third, high), (_, left, right), (_, greedy, same), state, again = [v for v in values if isinstance(v, (list, str))]
    assert kept(second, fine, "greedy") > kept(first, coarse, "greedy") and second < first, values
    assert kept(third, high, "high") < 0.5 * fine[1] and third == second, values
    assert kept(second, left, "greedy") == fine[1] and kept(second, right, "high") == high[1], values
    assert greedy == left and same[1] <= greedy[1] and same[2] < 0.6 * greedy[2], values
    assert "both=1" in state and "count=1" in state and "error=" in state, state
    assert "error=" not in again, again
    drag, one, obj, two = (v for v in values if isinstance(v, dict))
    assert drag["command"].endswith(" --effort fast --order greedy"), drag
    for page in (drag, one, obj, two):
        runs(page["command"], page)
    # The label equals the command's bound to the last digit.
    assert one["texts"][:3] == ["Download", "", ""] and f" -e {one['texts'][3].split()[0]} " in one["command"], one
    assert obj["command"] == one["command"] and "as GLB" in obj["texts"][2], obj
    assert two["texts"][:3] == ["Download high", "high: ", ""], two


def restored(values):
    (error, greedy, high), same = values
    assert same == "count" and 45 < error < 60 and kept(error, greedy, "greedy") >= high[1] and high[0] == "high", values


REFUSED = (("thin.hgt", "no square"), ("cut.tif", "damaged or cut off"), ("head.tif", "no TIFF file"), ("wrong.xyz", "no file that this page reads"),
           ("broken.png", "no PNG image"), ("cut.png", "damaged or cut off"), ("void.tif", "holds no height"), ("column.tif", "1 x 150"), ("no_tile.png", "no PNG image"))
# Name, text of the notes, decoding, and whether the program reads the same samples.
OFFERED = (("dem.tif", "", "", True), ("N36W085.hgt", "", "", False), ("terrarium.png", "terrarium", "terrarium", True), ("mapbox.png", "mapbox", "mapbox", True),
           ("grey16.png", "Grey levels", "", True), ("interlaced.png", "Grey levels", "", False), ("; touch x $(touch y) 'q' .tif", "", "", True), ("stray.tif", "", "", True), ("terraces.tif", "", "", True), ("colour.tif", "red is taken", "", True),
           ("masked.tif", "", "", True), ("doubles.tif", "", "", True),
           ("unsaid.tif", "25 samples of unsaid.tif are exactly -9999, far below all others (1 to 9)", "", True),
           ("feet.tif", "", "", True), ("thinned.tif", "one of 2 x 2", "", False))


def scaled(values):
    page = next(v for v in values if isinstance(v, dict))
    assert page["command"].endswith("--effort high --te -84.4 36.2 -84.2 36.4 --z-scale 3 --crs grid"), page
    runs(page["command"], page)


def rasters(values):
    pages = {value["name"]: value for value in values if isinstance(value, dict)}
    assert all(pages["interlaced.png"][key] == pages["grey16.png"][key] for key in ("triangles", "high", "error")), pages
    for name, notes, decoding, is_same in OFFERED:
        page, files = values.pop(0), [values.pop(0) for _ in FORMATS]
        assert page["name"] == name and page["error"] <= page["most"] * (1 + 1e-3) and page["uncovered"] == 0 and notes in page["notes"], (name, page)
        assert ("(true)" in page["exaggeration"]) == (name in KNOWN_METRES), (name, page)
        assert (page["stray"] == 2) == (name == "stray.tif"), (name, page)
        assert page["is_of_full"] == (name == "thinned.tif") and ("decoded as" in page["readout"]) == bool(decoding), (name, page)
        assert page["command"].endswith(f"--decode {decoding}" if decoding else "--order greedy") and f"-e {page['asked']:g} " in page["command"], (name, page)
        assert not decoding or f"heights decoded as\n{decoding}" in page["readout"], page
        assert page["label"].split()[0] == f"{page['asked']:g}", (name, page)
        if not is_same:
            continue
        runs(page["command"], page)
        for form, file in zip(FORMATS, files):
            open("saved." + form, "wb").write(base64.b64decode(file))
            found = ask("measure", name, "saved." + form, "--json", *(["--decode", decoding] if decoding else []))
            assert abs(found["max_error"] - page["error"]) <= 1e-6 * page["high"], (name, form, found["max_error"], page)
            assert name != "terraces.tif" or found["max_error"] == page["error"] == 0, (form, found["max_error"], page)
            assert (found["uncovered"], found["stray"], found["samples"]) == (0, page["stray"], page["samples"]), (name, form, found, page)
            assert found["triangles"] == page["triangles"], (name, form)
        assert not os.path.exists("x") and not os.path.exists("y"), name
    again = values.pop(0)
    assert "--decode terrarium" in again["command"] and "as of terrarium" in again["notes"] and again["high"] < -30000, again
    for name, words in REFUSED:
        told = values.pop(0)
        assert name in told and words in told, (name, told)


def overtaken(values):
    title, name, notice, is_busy = values[-1]
    assert title == name == "N36W085.hgt" and notice == "" and not is_busy, values


def first(values):
    empty, full, (error, greedy, high), (look, same, odd, note, distance) = values
    assert empty == [True, True, True, False] and full == [False, False, False, False], (empty, full)
    assert 45 < error < 60 and kept(error, greedy, "greedy") >= high[1] and high[0] == "high", values
    assert abs(distance / 90000 - 1) < 1e-6, distance
    assert look and same == "count" and "'odd?.tif'" in odd and "no line shows" in note, values[-1]


def anew(values):
    assert values == [[False, 1, -20]], values


def killed(values):
    words, mesh = (value for value in values if value)
    assert "No mesh" in words and "worker ended (out of memory)" in words, words
    kept(mesh[0], mesh[1], "greedy")


def ended(values):
    words, mesh = (value for value in values if value)
    assert "No mesh" in words and "lack of memory" in words, words
    kept(mesh[0], mesh[1], "greedy")


def refused(values):
    words = values[-1]
    assert "No mesh" in words and "WebAssembly" in words, words


FORMATS, KNOWN_METRES = ("glb", "stl", "obj"), ("dem.tif", "N36W085.hgt", "; touch x $(touch y) 'q' .tif", "stray.tif", "terraces.tif", "colour.tif", "feet.tif", "unsaid.tif")
if os.path.exists("live.html"):
    job(live, "live.html", [
        {"until": READY}, {"do": DRAG % 20, "until": "scarpPage.shown[0].name === 'greedy'", "read": NOW}, {"do": COMMAND},
        {"do": DRAG % 28, "until": "scarpPage.live.stepNow === 28 && scarpPage.shown[0].judged.maxError <= scarpPage.live.errorOf(28)",
         "read": NOW},
        {"do": RELEASE, "until": HIGH, "read": NOW, "shot": "live"}, {"do": COMMAND},
        {"do": FORMAT % "obj"}, {"do": COMMAND, "after": FORMAT % "glb"},
        {"keys": ["s"], "until": "scarpPage.shown.length === 2", "read": NOW, "shot": "side_by_side"},
        {"do": "(menu => { menu.value = 'count'; menu.dispatchEvent(new Event('change')); })(document.getElementById('same'))",
         "until": "scarpPage.shown[1].judged.maxError < 0.6 * scarpPage.shown[0].judged.maxError", "read": NOW},
        {"do": COMMAND}, {"until": "location.hash.includes('count=1')", "read": "location.hash"},
        {"keys": ["r"], "until": "scarpPage.shown.length === 1 && scarpPage.shown[0] === scarpPage.document.levels[0] && "
                                 "!location.hash.includes('both=1')", "read": "location.hash"}], axe=True)
    job(restored, "live.html", [{"until": READY + " && scarpPage.shown.length === 2 && " + HIGH, "read": NOW}, {"read": "document.getElementById('same').value"}],
        fragment="#error=50&both=1&count=1", width=500, height=400)
    OPENED = ("({name: document.title, error: scarpPage.shown[0].judged.maxError, most: (f => (f.high - f.low) * 0.02)(scarpPage.document.field),"
              " asked: scarpPage.shown[0].goal.maxError, uncovered: scarpPage.shown[0].judged.uncovered, stray: scarpPage.shown[0].judged.stray,"
              " samples: scarpPage.shown[0].judged.covered, triangles: scarpPage.shown[0].triangles, high: scarpPage.document.field.high,"
              " exaggeration: document.getElementById('exaggeration-text').textContent, notes: document.getElementById('notes').textContent,"
              " command: document.getElementById('command').textContent, is_of_full: document.getElementById('command-note').textContent.includes('full raster'),"
              " label: document.getElementById('error-text').textContent, readout: document.getElementById('readout').innerText})")
    # The result of Download, caught before it is a file.
    SAVED = ("new Promise(done => { const make = URL.createObjectURL; URL.createObjectURL = blob => { const reader = new FileReader();"
             " reader.onload = () => done(reader.result.split(',')[1]); reader.readAsDataURL(blob); URL.createObjectURL = make;"
             " return make(blob); }; document.getElementById('format').value = '%s'; document.getElementById('save').click();"
             " document.getElementById('format').value = 'glb'; })")
    steps = [{"until": "document.getElementById('notice').textContent"}]
    for name, *_ in OFFERED:
        steps += [{"drop": [{"name": name, "path": os.path.abspath(name)}], "until": f"document.title === {json.dumps(name)} && scarpPage.drawn > 0",
                   "read": OPENED, "shot": name.split(".")[0].replace(" ", "_")}] + [{"do": SAVED % form} for form in FORMATS]
        if name == "mapbox.png":
            redo = [{"drop": [{"name": name, "path": os.path.abspath(name)}], "until": "document.title === 'mapbox.png'",
                     "after": "(menu => { menu.value = 'terrarium'; menu.dispatchEvent(new Event('change')); })(document.getElementById('decoding'))"},
                    {"until": "scarpPage.document.field.decoding === 'terrarium'", "read": OPENED}]
    steps += redo
    for name, _ in REFUSED:
        steps += [{"drop": [{"name": name, "path": os.path.abspath(name)}], "until": NOTICE, "read": NOTICE,
                   "after": "document.getElementById('notice').hidden = true"}]
    job(rasters, "try.html", steps, axe=True)
    # The last of consecutive drops wins, however slow the earlier ones are.
    drop = lambda name, path: {"drop": [{"name": name, "path": os.path.abspath(path)}]}
    job(overtaken, "try.html", [
        {"until": NOTICE, "do": "(load => { window.loads = []; scarpPage.load = files => void loads.push(load(files)); })(scarpPage.load)"},
        drop("dem.tif", "dem.tif"), drop("N36W085.hgt", "N36W085.hgt"),
        {"do": "Promise.all(loads).then(() => [document.title, scarpPage.document.name, " + NOTICE + ", Boolean(scarpPage.live.first?.worker)])"}])
    # A page that began empty: without a mesh nothing can be saved. Its address belongs to the first file if that has as
    # many samples.
    EMPTY = ("[...['save', 'format', 'picture'].map(id => document.getElementById(id).disabled), document.getElementById('notice').classList.contains('error')]")
    fragment = "#errors=1&error=50&both=1&count=1&samples=403,344&view=10,40,90000,0,0,0"
    job(first, "try.html", [
        {"until": NOTICE, "read": EMPTY, "shot": "empty"}, {**drop("odd\x01.tif", "dem.tif"), "until": "scarpPage.document && scarpPage.shown.length === 2 && " + HIGH, "read": EMPTY}, {"read": NOW},
        {"read": "[scarpPage.look.errors, document.getElementById('same').value, ...['command', 'command-note'].map(id => document.getElementById(id).textContent), scarpPage.scene.orbit().distance]"}],
        fragment=fragment)
    job(anew, "try.html", [{"until": NOTICE}, {**drop("N36W085.hgt", "N36W085.hgt"), "until": "scarpPage.drawn > 0", "read": "[scarpPage.look.errors, scarpPage.shown.length, Math.round(scarpPage.scene.orbit().azimuth)]"}],
        fragment=fragment)
    # The image also covers the engine's meshes.
    job(image_kept, "image.html", [{"until": READY}, {"do": DRAG % 20, "until": "scarpPage.shown[0].name === 'greedy'", "read": NOW}, {"read": QUARTERS}])
    job(scaled, "scaled.html", [{"until": READY}, {"do": DRAG % 20, "until": "scarpPage.shown[0].name === 'greedy'"}, {"do": RELEASE, "until": HIGH}, {"do": COMMAND}])
    # If a worker ends during work: a message, and the next request has a new worker.
    job(killed, "live.html", [
        {"until": READY}, {"do": DRAG % 40 + "; scarpPage.live.quick.worker.dispatchEvent(new ErrorEvent('error', {message: 'out of memory', cancelable: true}))",
                           "until": "!document.getElementById('progress').hidden", "read": "document.getElementById('progress').textContent"},
        {"do": DRAG % 20, "until": "scarpPage.shown[0].name === 'greedy'", "read": NOW}])
    # A worker that ends without an event, as for excessive memory: its lock reveals it.
    job(ended, "live.html", [
        {"until": READY}, {"do": DRAG % 40, "until": "!document.getElementById('progress').hidden", "read": "document.getElementById('progress').textContent"},
        {"do": DRAG % 20, "until": "scarpPage.shown[0].name === 'greedy'", "read": NOW}], before="const { Blob: Whole } = window; window.Blob = class extends Whole"
        " { constructor(parts, options) { super(options?.type === 'text/javascript' ? [`const post = postMessage;"
        " self.postMessage = (data, moved) => { if (data.judged?.maxError < 20) close(); else post(data, moved); };`, ...parts] : parts, options); } };")
    job(refused, "no_wasm.html", [{"until": READY}, {"do": DRAG % 20, "until": "!document.getElementById('progress').hidden",
                                                    "read": "document.getElementById('progress').textContent"}], errors_are_expected=True)

# Each load replaces the contents of the last one.
job(loads, "image.html", [{"until": READY}, {"do": """(async () => {
  const data = JSON.parse(document.getElementById('scarp-data').textContent), page = scarpPage, memory = page.scene.renderer.info.memory;
  const buffer = Uint8Array.from(atob(data.meshes[0].glb), letter => letter.charCodeAt(0)).buffer, seen = [];
  for (let k = 0; k < 50; ++k) {
    await page.load([new File([buffer], 'again.glb')]);
    page.change({errors: true, edges: true, smooth: true});
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
