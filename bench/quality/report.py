#!/usr/bin/env python3
"""Writes the tables of docs/quality.md from efforts.csv, peers.csv, their times, and pictures.csv.

  report.py            writes them
  report.py --check    fails if the document would change
"""

import argparse
import math
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCUMENT = HERE.parent.parent / "docs" / "quality.md"
sys.path.insert(0, str(HERE.parent))
from tables import fill, markdown, read_table  # noqa: E402

FULL_QUARTER = 25  # percent of the full grid: where greedy insertion needs more, triangles are a few samples in size


def geometric_mean(numbers):
    return math.exp(statistics.fmean(math.log(number) for number in numbers))


def spread(numbers, digits=2):
    """Geometric mean (least to most)."""
    if not numbers:
        return "–"
    return f"{geometric_mean(numbers):.{digits}f} ({min(numbers):.{digits}f} to {max(numbers):.{digits}f})"


def by_case(rows, column):
    """{(raster, percent): {value of column: row}}, in the order of the rows."""
    cases = {}
    for row in rows:
        cases.setdefault((row["raster"], row["percent_of_relief"]), {})[row[column]] = row
    return cases


def values(rows, column):
    """In their first order."""
    return list(dict.fromkeys(row[column] for row in rows))


def title(raster):
    return raster.rsplit(".", 1)[0]


class Efforts:
    """efforts.csv with the times in it."""

    def __init__(self):
        rows = read_table(HERE / "efforts.csv")
        seconds = {tuple(row.values())[:-1]: float(row["cpu_seconds"])
                   for row in read_table(HERE / "efforts_seconds.csv")}
        for row in rows:
            row["seconds"] = seconds.get((row["raster"], row["percent_of_relief"], row["effort"], row["vertices"]))
        self.rows, self.cases = rows, by_case(rows, "effort")
        self.efforts = [effort for effort in values(rows, "effort") if effort != "greedy"]

    def ratios(self, effort, column, which):
        """Of a column, to the same of greedy insertion, over the cases of one kind."""
        return [float(case[effort][column]) / float(case["greedy"][column]) for case in self.cases.values()
                if effort in case and which(case["greedy"])]

    def summary(self):
        kinds = [("triangles ÷ greedy's, where that needs less than a quarter of the full grid", is_sparse),
                 ("elsewhere", lambda greedy: not is_sparse(greedy))]
        header = ["geometric mean (least to most)"]
        header += [f"{words} ({sum(which(case['greedy']) for case in self.cases.values())} cases)"
                   for words, which in kinds]
        header += ["RMSE ÷ greedy's", "CPU time ÷ greedy's"]
        lines = []
        for effort in self.efforts:
            cells = [spread(self.ratios(effort, "triangles", which)) for _, which in kinds]
            cells += [spread(self.ratios(effort, "rmse", is_any)), spread(self.ratios(effort, "seconds", is_any), 1)]
            lines.append([f"`{effort}`", *cells])
        return markdown(header, lines)

    def triangles(self):
        percents = values(self.rows, "percent_of_relief")
        lines = []
        for raster in values(self.rows, "raster"):
            of_raster = {percent: self.cases.get((raster, percent), {}) for percent in percents}
            lines.append([f"**{title(raster)}**", "greedy",
                          *(f"{int(case['greedy']['triangles']):,}" for case in of_raster.values())])
            for effort in self.efforts:
                lines.append(["", f"`{effort}`", *(f"{float(case[effort]['ratio']):.3f}" if effort in case else "–"
                                                   for case in of_raster.values())])
        return markdown(["raster", "", *(f"{percent} %" for percent in percents)], lines)

    def angles(self):
        lines = []
        for effort in ["greedy", *self.efforts]:
            rows = [case[effort] for case in self.cases.values() if effort in case]
            lines.append([f"`{effort}`" if effort != "greedy" else effort,
                          *(f"{statistics.median(float(row[column]) for row in rows):.1f}°"
                            for column in ("angle_median", "angle_p1")),
                          f"{min(float(row['min_angle']) for row in rows):.2g}°"])
        return markdown(["", "median of the smallest angles", "their first percentile", "smallest of all"], lines)


def is_any(_):
    return True


def is_sparse(greedy):
    return float(greedy["percent_of_full"]) < FULL_QUARTER


def is_broken(row):
    return float(row["max_error"]) > float(row["max_error_asked"]) * (1 + 1e-7)


class Peers:
    """peers.csv with the times in it."""

    def __init__(self):
        rows = read_table(HERE / "peers.csv")
        seconds = {tuple(row.values())[:-1]: float(row["cpu_seconds"])
                   for row in read_table(HERE / "peers_seconds.csv")}
        for row in rows:
            row["seconds"] = seconds.get((row["raster"], row["percent_of_relief"], row["program"]))
        self.rows, self.cases = rows, by_case(rows, "program")
        self.programs = [program for program in values(rows, "program") if program != "Scarp greedy"]

    def summary(self):
        header = ["program", "version", "triangles ÷ greedy's: geometric mean (least to most)", "RMSE ÷ greedy's",
                  "cases kept", "with uncovered samples", "with folds", "CPU time ÷ greedy's"]
        lines = []
        for program in self.programs:
            found = [(case[program], case["Scarp greedy"]) for case in self.cases.values() if program in case]
            kept = [(row, greedy) for row, greedy in found if not is_broken(row)]

            def ratios(column):
                return [float(row[column]) / float(greedy[column]) for row, greedy in kept]

            lines.append([program, found[0][0]["version"], spread(ratios("triangles")), spread(ratios("rmse")),
                          f"{len(kept)} of {len(found)}", sum(row["uncovered"] != "0" for row, _ in kept),
                          sum(row["folded"] != "0" for row, _ in kept), spread(ratios("seconds"), 1)])
        return markdown(header, lines)

    def triangles(self):
        lines = []
        for (raster, percent), case in self.cases.items():
            lines.append([raster, f"{percent} %", f"{int(case['Scarp greedy']['triangles']):,}",
                          *(peer_cell(case.get(program)) for program in self.programs)])
        return markdown(["raster", "max error", "greedy", *self.programs], lines)


def peer_cell(row):
    if row is None or is_broken(row):
        return "–"
    marks = ("†" if row["uncovered"] != "0" else "") + ("‡" if row["folded"] != "0" else "")
    return f"{float(row['ratio']):.3f}{marks}"


def picture_table(scene, rows):
    """The pictures of a scene side by side, how many triangles each shows below."""
    words = {"greedy": "greedy insertion"}
    header = [words.get(row["effort"], f"`{row['effort']}`") for row in rows]
    pictures = [f"![{title(row['raster'])}, {row['effort']}](images/{row['picture']})" for row in rows]
    greedy = int(rows[0]["triangles"])
    counts = [f"{int(row['triangles']):,} triangles" + (f", {int(row['triangles']) / greedy:.2f}" if row is not rows[0]
                                                        else "") for row in rows]
    return markdown(header, [pictures, counts])


def tables():
    """Every table by its name, those left out whose file is not there."""
    efforts, peers, found = Efforts(), Peers(), {}
    if efforts.rows:
        found.update(efforts=efforts.summary(), triangles=efforts.triangles(), angles=efforts.angles())
    if peers.rows:
        found.update(peers=peers.summary(), peer_triangles=peers.triangles())
    pictures = read_table(HERE / "pictures.csv")
    for scene in values(pictures, "scene"):
        found[f"pictures_{scene}"] = picture_table(scene, [row for row in pictures if row["scene"] == scene])
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing, fail if anything would change")
    old = DOCUMENT.read_text()
    new = fill(old, tables())
    if not parser.parse_args().check:
        DOCUMENT.write_text(new)
        return 0
    if new != old:
        print(f"{DOCUMENT.name} does not hold what the CSV files say: run bench/quality/report.py")
    return int(new != old)


if __name__ == "__main__":
    sys.exit(main())
