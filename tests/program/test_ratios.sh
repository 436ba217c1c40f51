#!/bin/bash
# The ratios that --help, README.md and docs/cli.md claim for efforts and budgets are those of the tables of docs/quality.md.
set -euo pipefail
source_tree=${SCARP_SOURCE:?}
scarp=${SCARP_BUILD:?}/bin/scarp
python=$(command -pv python3 || command -v python3) || { echo "skipped: python3 is missing"; exit 77; }
help=$(for command in "" simplify measure info generate paper; do "$scarp" $command --help-all; done) "$python" - "$source_tree" << 'PYTHON'
import os, re, sys
root = sys.argv[1]
read = lambda name: open(f"{root}/{name}", encoding="utf-8").read()
joined = lambda text: re.sub(r"[\s`*]+", " ", text)
texts = {"--help": joined(os.environ["help"]), "README.md": joined(read("README.md")), "docs/cli.md": joined(read("docs/cli.md")),
         "docs/quality.md": joined(read("docs/quality.md"))}

# triangles and CPU time of each effort, in greedy insertion's
quality = read("docs/quality.md")
rows = re.search(r"<!-- table: efforts -->(.*?)<!-- end -->", quality, re.S).group(1)
table = {}
for name, sparse, _, _, time in re.findall(r"^\| `([a-z ]+)` \|([^|]*)\|([^|]*)\|([^|]*)\|([^|]*)\|$", rows, re.M):
    table[name] = (float(sparse.split()[0]), float(time.split()[0]))
assert set(table) == {"fast", "normal", "high on samples", "high", "max"}, table
triangles = {name: row[0] for name, row in table.items()}
seconds = {name: row[1] for name, row in table.items()}
budgets = re.search(r"<!-- table: budget_summary -->(.*?)<!-- end -->", quality, re.S).group(1)
budget = {}  # max error and RMSE in greedy insertion's, RMSE in that of `high`
for name, error, rmse, of_high in re.findall(r"^\| `([a-z ]+)` \| [0-9]+ \|([^|]*)\|([^|]*)\|([^|]*)\|", budgets, re.M):
    budget[name] = tuple(float(cell.split()[0]) for cell in (error, rmse, of_high))
assert set(budget) == {"normal", "normal rms", "high", "high rms", "max rms"}, budget
squares = re.search(r"<!-- table: squares -->(.*?)<!-- end -->", quality, re.S).group(1)
below = [100 - 100 * float(cell) for cell in re.findall(r"^\| [a-z0-9_]+ \|.*\| ([0-9.]+) \|$", squares, re.M)]
assert len(below) >= 10, below
floors = re.search(r"<!-- table: high_normal -->(.*?)<!-- end -->", quality, re.S).group(1)
assert "has more in 0 |" in floors, "docs/quality.md says that high never has more triangles than normal"
N = r"([0-9.]+[0-9])"

def near(claim, true, digits):
    return abs(float(claim) - true) <= 0.5 * 10 ** -digits + 1e-9

# Where, the words, and the true number of each group with the digits that it is told in.
claims = [
    ("--help", rf"normal: also remove vertices; {N} of the triangles of fast", [(triangles["normal"] / triangles["fast"], 2)]),
    ("--help", rf"high: also move vertices; {N}\.", [(triangles["high"] / triangles["fast"], 2)]),
    ("--help", rf"max: try more of that; {N}\.", [(triangles["max"] / triangles["fast"], 2)]),
    ("--help", rf"CPU time is {N}, {N}, {N} and {N} times that of --order greedy",
     [(seconds["fast"], 1), (seconds["normal"], 1), (seconds["high"], 1), (seconds["max"], 0)]),
    ("--help", rf"with high {N} of the triangles of fast", [(triangles["high on samples"] / triangles["fast"], 2)]),
    ("README.md", r"(Half) the triangles of greedy insertion", [(triangles["normal"], 0.5)]),
    ("README.md", r"a (third) with --effort high", [(triangles["high"], 1 / 3)]),
    ("README.md", r"in some ([0-9]+) times the time", [(seconds["high"] / seconds["normal"], 0)]),
    ("README.md", rf"about {N} times the triangles", [(triangles["fast"] / triangles["normal"], 1)]),
]
texts |= {name: joined(read(name)) for name in ("docs/cli/effort.md", "docs/cli/goals.md")}
for level in "fast", "normal", "high", "max":
    claims.append(("docs/cli/effort.md", rf"\| {level} \| [^|]* \| {N} \| ([0-9.]+) \|",
                   [(triangles[level], 2), (seconds[level], 0 if level == "max" else 1)]))
claims += [
    ("docs/cli/goals.md", rf"the max error is about {N} \( ?normal ?\) or {N} \( ?high ?\) of that of greedy insertion",
     [(budget["normal"][0], 2), (budget["high"][0], 2)]),
    ("docs/cli/goals.md", rf"With high the RMSE is about {N} of that of max , and the max error {N} times",
     [(budget["high rms"][2], 2), (budget["high rms"][0] / budget["high"][0], 1)]),
    ("docs/quality.md", rf"For as many triangles high rms leaves {N} of the RMSE of high", [(budget["high rms"][2], 2)]),
    ("docs/quality.md", rf"high rms is at least {N} % below the best of them on each", [(min(below), 0)]),
]
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

# Nothing else is claimed of triangles or time.
for where in "--help", "README.md":
    for found in re.finditer(r"(?i)(half|third|quarter|fifth|fourth|tenths?|twice|[0-9.]+ times|[0-9.]+ %|0\.[0-9]+) (of )?(the |more |fewer )?(triangles|time)\b",
                             texts[where]):
        inside = any(a <= found.start() and found.end() <= b for a, b in told[where])
        assert inside, f"{where} claims '{found.group()}', which no table is asked about: add it to the claims"
# What takes more triangles than the default is not shown as taking fewer.
for where, text in texts.items():
    for found in re.finditer(r"--edges data[^\n]{0,60}fewer[^\n]{0,40}", text):
        assert "--order greedy" in found.group(), f"{where} recommends '{found.group()}'"
print("claims are those of the tables")
PYTHON
