#!/bin/bash
# Ratios of efforts and budgets in --help, README.md, the cookbook and docs/cli match the tables of bench/quality.md;
# figures of docs/how-good.md match the pages and tables of bench/.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
scarp=${SCARP_BUILD:?}/bin/scarp
python=$(command -pv python3 || command -v python3) || { echo "skipped: python3 is missing"; exit 77; }
help=$(for command in "" simplify measure info generate; do "$scarp" $command --help-all; done) "$python" - "$source_tree" << 'PYTHON'
import csv, os, re, sys
root = sys.argv[1]
read = lambda name: open(f"{root}/{name}", encoding="utf-8").read()
joined = lambda text: re.sub(r"[\s`*]+", " ", text)
texts = {"--help": joined(os.environ["help"]), "README.md": joined(read("README.md")), "docs/cli.md": joined(read("docs/cli.md")),
         "bench/quality.md": joined(read("bench/quality.md")), "docs/how-good.md": joined(read("docs/how-good.md"))}

# per effort relative to greedy insertion: triangles (where greedy needs less than a quarter of the full grid, and
# elsewhere), RMSE and CPU time
quality = read("bench/quality.md")
section = lambda name, page=quality: re.search(rf"<!-- table: {name} -->(.*?)<!-- end -->", page, re.S).group(1)
table = {}
for name, *cells in re.findall(r"^\| `([a-z ]+)` \|([^|]*)\|([^|]*)\|([^|]*)\|([^|]*)\|$", section("efforts"), re.M):
    table[name] = tuple(float(cell.split()[0]) for cell in cells)
assert set(table) == {"fast", "normal", "normal free", "high on samples", "high", "max"}, table
triangles = {name: row[0] for name, row in table.items()}
seconds = {name: row[3] for name, row in table.items()}
budgets = section("budget_summary")
budget = {}  # max error and RMSE relative to greedy insertion's, RMSE relative to that of `high`
for name, error, rmse, of_high in re.findall(r"^\| `([a-z ]+)` \| [0-9]+ \|([^|]*)\|([^|]*)\|([^|]*)\|", budgets, re.M):
    budget[name] = tuple(float(cell.split()[0]) for cell in (error, rmse, of_high))
assert set(budget) == {"normal", "normal rms", "high", "high rms", "max rms"}, budget
squares = section("squares")
below = [100 - 100 * float(cell) for cell in re.findall(r"^\| [a-z0-9_]+ \|.*\| ([0-9.]+) \|$", squares, re.M)]
assert len(below) >= 10, below
floors = section("high_normal")
assert "has more in 0 |" in floors, "bench/quality.md and docs/how-good.md say that high never has more triangles than normal"
N = r"([0-9.]+[0-9])"
I = r"([0-9,]+)"  # with commas
rows_of = lambda name: list(csv.DictReader(open(f"{root}/bench/{name}", encoding="utf-8")))

def near(claim, true, digits):
    return abs(float(claim.replace(",", "")) - true) <= 0.5 * 10 ** -digits + 1e-9

# The place, the words, and the true number of each group with its printed digits.
claims = [
    ("--help", rf"normal: also remove vertices; {N} of the triangles of fast", [(triangles["normal"] / triangles["fast"], 2)]),
    ("--help", rf"high: also move vertices; {N}\.", [(triangles["high"] / triangles["fast"], 2)]),
    ("--help", rf"max: search longer; {N}\.", [(triangles["max"] / triangles["fast"], 2)]),
    ("--help", rf"CPU time is {N}, {N}, {N} and {N} times that of the 1995 paper's algorithm",
     [(seconds["fast"], 1), (seconds["normal"], 1), (seconds["high"], 1), (seconds["max"], 0)]),
    ("--help", rf"with --effort high this needs {N} times the triangles of --effort fast", [(triangles["high on samples"] / triangles["fast"], 2)]),
    ("README.md", r"(Half) the triangles of greedy insertion", [(triangles["normal"], 0.5)]),
    ("README.md", r"a (third) with --effort high", [(triangles["high"], 1 / 3)]),
    ("docs/cookbook.md", r"in some ([0-9]+) times the time", [(seconds["high"] / seconds["normal"], 0)]),
    ("docs/cookbook.md", rf"about {N} times the triangles", [(triangles["fast"] / triangles["normal"], 1)]),
]
texts |= {name: joined(read(name)) for name in ("docs/cookbook.md", "docs/cli/effort.md", "docs/cli/goals.md")}
for level in "fast", "normal", "high", "max":
    claims.append(("docs/cli/effort.md", rf"\| {level} \| [^|]* \| {N} \| ([0-9.]+) \|",
                   [(triangles[level], 2), (seconds[level], 0 if level == "max" else 1)]))
claims += [
    ("docs/cli/goals.md", rf"the max error is about {N} \( ?normal ?\) or {N} \( ?high ?\) of that of greedy insertion",
     [(budget["normal"][0], 2), (budget["high"][0], 2)]),
    ("docs/cli/goals.md", rf"With high the RMSE is about {N} of that of max , and the max error {N} times",
     [(budget["high rms"][2], 2), (budget["high rms"][0] / budget["high"][0], 1)]),
    ("bench/quality.md", rf"For as many triangles high rms leaves {N} of the RMSE of high", [(budget["high rms"][2], 2)]),
    ("bench/quality.md", rf"high rms is at least {N} % below the best of them on each", [(min(below), 0)]),
]

# docs/how-good.md
good = "docs/how-good.md"
for level in "fast", "normal", "high", "max":
    least, _, rmse, time = table[level]
    claims.append((good, rf"\| {level} (?:\(default\) )?\| {N} \| {N} \| ([0-9.]+) \|",
                   [(least, 2), (rmse, 2), (time, 0 if level == "max" else 1)]))
peers = {}  # triangles, RMSE, meshes that satisfy the goal, meshes with folds
for name, *cells in re.findall(r"^\| ([A-Za-z -]+) \|[^|]*\|([^|]*)\|([^|]*)\|([^|]*)\|[^|]*\|([^|]*)\|[^|]*\|$", section("peers"), re.M):
    if name != "program" and not name.startswith("-"):
        peers[name] = [float(cell.split()[0].replace("–", "nan")) for cell in cells]
for name, words in (("Scarp normal", ""), ("Scarp high", ""), ("delatin", ""), ("CGAL Lindstrom-Turk", "folds"),
                    ("CGAL Garland-Heckbert", "folds"), ("meshoptimizer", "folds")):
    claims.append((good, rf"\| {name} \| {N} \|" + (" ([0-9]+) of 25 meshes have folds" if words else ""),
                   [(peers[name][0], 2), *([(peers[name][3], 0)] if words else [])]))
others = [peers[name] for name in peers if name.startswith("CGAL") or name == "meshoptimizer"]
angles = dict(re.findall(r"^\| `?([a-z ]+)`? \| ([0-9.]+)°", section("angles"), re.M))
made = rows_of("quality/high_normal.csv")
assert all(float(row["max_error"]) <= float(row["max_error_asked"]) * (1 + 1e-7) for row in made)
borders = rows_of("tiles/borders.csv")
assert not sum(int(row["edges_apart"]) for row in borders)
times = {(row["goal"], row["case"]): [float(one) for one in re.findall(r"[0-9.]+", row["how"])] for row in rows_of("speed/goals.csv")}
threads = {error: times["threads", f"sierra_3601 {error}"] for error in ("238", "23.6")}
efforts = {(level, error): times[level, f"sierra_3601 {error}"][0] for level, error in (("normal", "238"), ("normal", "23.6"), ("high", "238"))}
found = {(row["error"], row["program"]): row for row in rows_of("speed/results.csv") if row["raster"] == "sierra_3601"}
delatin = re.search(r"delatin ÷ Scarp, CPU, rasters above 10 million samples: lowest ([0-9.]+), median [0-9.]+, highest ([0-9.]+)",
                    section("spread", read("bench/performance.md")))
memory = re.search(r"scarp simplify --effort fast.*?Fitted: \*\*([0-9.]+) bytes a sample \+ ([0-9]+) bytes a vertex\*\* \+([0-9.]+) MB\.\s+"
                   r"Less the program's own ([0-9.]+) MB", read("bench/speed/memory.md"), re.S)
own = float(memory.group(3)) + float(memory.group(4))
mosaic = re.search(r"^\| 60,000² \| 150 m \|.*\| ([0-9]+) s \| ([0-9]+) MB \|$", read("bench/performance.md"), re.M)
reference = re.search(r"Largest differences: RMSE ([0-9.]+) %, triangles ([0-9.]+) %", read("bench/reference.md"))
tiles = {}
for name, count, worst, edges in re.findall(r"^\| (?:Scarp )?`?([a-z]+)`? \| ([0-9,]+) \|[^|]*\|[^|/]*/ ([0-9.]+) m \| ([0-9,]+) of 1,984", section("level_12", read("bench/tiles.md")), re.M):
    tiles[name] = (int(count), float(worst), int(edges.replace(",", "")))
claims += [
    (good, rf"Where it needs more, normal leaves {N} and high {N}\.", [(table["normal"][1], 2), (table["high"][1], 2)]),
    (good, r"than normal : ([0-9]+) cases", [(len({(row["raster"], row["percent_of_relief"]) for row in rows_of("quality/high_normal.csv")}), 0)]),
    (good, rf"The max error is {N} of greedy insertion's with normal , {N} with high", [(budget["normal"][0], 2), (budget["high"][0], 2)]),
    (good, rf"the RMSE is {N} of greedy insertion's", [(budget["high rms"][1], 2)]),
    (good, r"\| VTK \(greedy decimation\) \| – \| ([0-9]+) of 25", [(peers["VTK"][2], 0)]),
    (good, r"at least ([0-9]+) % below that of the best of them on each of ([0-9]+) rasters", [(min(below), 0), (len(below), 0)]),
    (good, rf"\| 238 m [^|]*\| {I} \| {N} s \| {N} s", [(int(found["238", "dominant"]["triangles"]), 0), *((one, 2) for one in threads["238"])]),
    (good, rf"\| 23.6 m [^|]*\| {I} \| {N} s \| {N} s", [(int(found["23.6", "dominant"]["triangles"]), 0), *((one, 2) for one in threads["23.6"])]),
    (good, rf"takes {N} and {N} s of CPU time with normal for the same errors, and {N} s with high",
     [(efforts["normal", "238"], 1), (efforts["normal", "23.6"], 1), (efforts["high", "238"], 1)]),
    (good, r"delatin takes ([0-9]+) to ([0-9]+) times", [(float(one), 0) for one in delatin.groups()]),
    (good, rf"([0-9]+) MB, {N} bytes a sample and ([0-9]+) bytes a vertex", [(own, 0), (float(memory.group(1)), 2), (float(memory.group(2)), 0)]),
    (good, r"60,000 × 60,000 samples at 150 m took ([0-9]+) s and ([0-9]+) MB", [(float(one), 0) for one in mosaic.groups()]),
    (good, r"([0-9]+) meshes of ([0-9]+) rasters", [(len(made), 0), (len({row["raster"] for row in made}), 0)]),
    (good, rf"RMSE within {N} %, triangles within {N} %", [(float(reference.group(1)), 2), (float(reference.group(2)), 3)]),
    (good, rf"\| martini \| {I} \| {N} m \| {I} of 1,984", [(one, digits) for one, digits in zip(tiles["martini"], (0, 1, 0))]),
    (good, rf"{I} shared edges", [(sum(int(row["edges"]) for row in borders), 0)]),
    (good, rf"is {N}° with greedy insertion, {N}° with normal , {N}° with high", [(float(angles[one]), 1) for one in ("greedy", "normal", "high")]),
    (good, rf"RMSE of normal is {N} of greedy insertion's", [(table["normal"][2], 2)]),
    (good, rf"reach {N} to {N}\.", [(min(row[1] for row in others), 2), (max(row[1] for row in others), 2)]),
]
for level in "normal", "high":
    claims.append((good, rf"\| scarp tile --effort {level} \| {I} \| {N} m \| {I} of 1,984", [(one, digits) for one, digits in zip(tiles[level], (0, 1, 0))]))

told = {"--help": [], "README.md": []}
for where, words, truths in claims:
    found = re.search(words, texts[where])
    assert found, f"{where} does not say: {words}"
    told.setdefault(where, []).append(found.span())
    for claim, (true, digits) in zip(found.groups(), truths, strict=True):
        if claim in ("Half", "third"):  # words: nearer than the next simple share
            assert abs(true - digits) < 0.08, f"{where}: {claim} for {true}"
        else:
            assert near(claim, true, digits), f"{where}: '{found.group()}' where the table says {true:.3f}"

# No other claims about triangles or time.
for where in "--help", "README.md", "docs/cookbook.md":
    for found in re.finditer(r"(?i)(half|third|quarter|fifth|fourth|tenths?|twice|[0-9.]+ times|[0-9.]+ %|0\.[0-9]+) (of )?(the |more |fewer )?(triangles|time)\b",
                             texts[where]):
        inside = any(a <= found.start() and found.end() <= b for a, b in told[where])
        assert inside, f"{where} claims '{found.group()}', which no table is asked about: add it to the claims"
# A setting that needs more triangles than the default is not presented as needing fewer.
for where, text in texts.items():
    for found in re.finditer(r"--edges data[^\n]{0,60}fewer[^\n]{0,40}", text):
        assert "--order greedy" in found.group(), f"{where} recommends '{found.group()}'"

# The README's table of programs is a transposed excerpt of the peers' table: ratios to greedy insertion's triangles,
# cases with folds.
rows = {}
for line in re.search(r"<!-- table: peers -->(.*?)<!-- end -->", quality, re.S).group(1).strip().splitlines()[2:]:
    name, _, ratio, _, kept, _, folds, _ = [cell.strip() for cell in line.strip("|").split("|")]
    rows[name] = (ratio.split()[0], folds) if kept == "25 of 25" else ("bound broken", "–")
names, _, ratios, folds = [[cell.strip() for cell in line.strip("|").split("|")][1:]
                           for line in re.search(r"((?:^\| .*\n|^\|-.*\n){4})", read("README.md")[read("README.md").index("| same max error"):], re.M)[1].splitlines()]
assert len(names) >= 5 and dict(zip(names, zip(ratios, folds, strict=True), strict=True)).items() <= rows.items(), (names, ratios, folds, rows)
print("claims are those of the tables")
PYTHON
