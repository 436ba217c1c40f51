#!/usr/bin/env python3
"""Writes the tables of bench/quality.md and by_raster.md from efforts.csv, budgets.csv, peers.csv, their times,
high_normal.csv, squares.csv, cliffs.csv, ridges.csv, images.csv and pictures.csv.

  report.py            writes them
  report.py --check    fails if a page would change
"""

import argparse
import math
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCUMENTS = (HERE.parent / "quality.md", HERE / "by_raster.md")
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
        """Ratios of a column to the same of greedy insertion, over the cases of one kind."""
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
        """By raster, without programs that never satisfy the goal and Scarp's other efforts."""
        shown = [program for program in self.programs if program not in ("Scarp fast", "Scarp high on samples")
                 and not all(is_broken(case[program]) for case in self.cases.values() if program in case)]
        lines = []
        for (raster, percent), case in self.cases.items():
            lines.append([raster, f"{percent} %", f"{int(case['Scarp greedy']['triangles']):,}",
                          *(peer_cell(case.get(program)) for program in shown)])
        return markdown(["raster", "max error", "greedy", *shown], lines)


def peer_cell(row):
    if row is None or is_broken(row):
        return "–"
    marks = ("†" if row["uncovered"] != "0" else "") + ("‡" if row["folded"] != "0" else "")
    return f"{float(row['ratio']):.3f}{marks}"


class Budgets:
    """budgets.csv with the times in it."""

    def __init__(self):
        rows = read_table(HERE / "budgets.csv")
        seconds = {tuple(row.values())[:-1]: float(row["cpu_seconds"])
                   for row in read_table(HERE / "budgets_seconds.csv")}
        for row in rows:
            row["seconds"] = seconds.get((row["raster"], row["percent_of_relief"], row["variant"]))
        self.rows, self.cases = rows, by_case(rows, "variant")
        self.variants = [variant for variant in values(rows, "variant") if variant != "greedy"]

    def ratios(self, variant, column, to, of_walls=False):
        return [float(case[variant][column]) / float(case[to][column]) for (raster, _), case in self.cases.items()
                if variant in case and (raster in STEEP) == of_walls]

    def summary(self):
        lines = []
        for variant in self.variants:
            used = [float(row["triangles"]) / float(row["budget"]) for row in self.rows
                    if row["variant"] == variant and row["raster"] not in STEEP]
            lines.append([f"`{variant}`", len(used), spread(self.ratios(variant, "max_error", "greedy")),
                          spread(self.ratios(variant, "rmse", "greedy")), spread(self.ratios(variant, "rmse", "high")),
                          f"{100 * min(used):.1f} %", spread(self.ratios(variant, "seconds", "greedy"), 0),
                          spread(self.ratios(variant, "rmse", "high", of_walls=True))])
        return markdown(["geometric mean (least to most)", "cases", "max error ÷ greedy's", "RMSE ÷ greedy's",
                         "RMSE ÷ that of `high`", "least used of the budget", "CPU time ÷ greedy's",
                         "on walls (athens_dsm_1m): RMSE ÷ that of `high`"], lines)

    def errors(self):
        lines = []
        for (raster, percent), case in self.cases.items():
            cells = [f"{float(row['max_error']) / float(case['greedy']['max_error']):.3f}, "
                     f"{float(row['rmse']) / float(case['greedy']['rmse']):.3f}" if row else "–"
                     for row in map(case.get, self.variants)]
            share = float(case["high rms"]["rmse"]) / float(case["high"]["rmse"])
            lines.append([title(raster), f"{int(case['greedy']['budget']):,}", *cells, f"{share:.3f}"])
        return markdown(["raster", "budget", *(f"`{variant}`" for variant in self.variants),
                         "RMSE of `high rms` ÷ `high`"], lines)


class Squares:
    """squares.csv."""

    def __init__(self):
        self.rows, self.cases = read_table(HERE / "squares.csv"), {}
        for row in self.rows:
            self.cases.setdefault(row["raster"], {})[row["program"]] = row
        self.programs = [program for program in values(self.rows, "program")
                         if program not in ("Scarp greedy", "Scarp high rms")]

    def best(self, case):
        """The least RMSE of the other programs, relative to that of Scarp."""
        return min(float(row["ratio"]) for program, row in case.items() if not program.startswith("Scarp"))

    def table(self):
        lines = []
        for raster, case in self.cases.items():
            scarp = case["Scarp high rms"]
            cells = [square_cell(row, scarp) if row else "–" for row in map(case.get, self.programs)]
            lines.append([raster, f"{int(scarp['triangles']):,}", f"{float(scarp['rmse']):.4g}",
                          f"{float(scarp['max_error']):.4g}", *cells, f"{1 / self.best(case):.2f}"])
        cases = list(self.cases.values())
        means = [f"{geometric_mean([float(case[program]['ratio']) for case in cases if program in case]):.2f}"
                 for program in self.programs]
        lines.append(["geometric mean", "", "", "", *means, f"{1 / geometric_mean([self.best(case) for case in cases]):.2f}"])
        return markdown(["raster", "triangles", "`high rms`: RMSE", "max error",
                         *(f"{program.removeprefix('Scarp ')}" if not program.startswith("Scarp")
                           else f"`{program.removeprefix('Scarp ')}`" for program in self.programs),
                         "`high rms` ÷ the best program"], lines)


def square_cell(row, scarp):
    marks = ("†" if row["uncovered"] != "0" else "") + ("‡" if row["folded"] != "0" else "")
    return f"{float(row['ratio']):.2f}, {float(row['max_error']) / float(scarp['max_error']):.2f}{marks}"


WORST = 12  # rows of the table


class HighNormal:
    """high_normal.csv."""

    def __init__(self):
        self.rows = read_table(HERE / "high_normal.csv")
        self.cases = by_case(self.rows, "variant")

    def worst(self):
        """The case where high saves least."""
        def ratio(case):
            return int(case["high"]["triangles"]) / int(case["normal"]["triangles"])

        lines = []
        for (raster, percent), case in sorted(self.cases.items(), key=lambda one: -ratio(one[1]))[:WORST]:
            hard = f"{int(case['hard']['triangles']):,}" if "hard" in case else "–"
            lines.append([title(raster), f"{percent} %", f"{int(case['normal']['triangles']):,}",
                          f"{int(case['high']['triangles']):,}", f"{ratio(case):.3f}", hard])
        more = sum(ratio(case) > 1 for case in self.cases.values())
        lines.append([f"all {len(self.cases)}", "", "", "", spread([ratio(case) for case in self.cases.values()], 3),
                      f"`high` has more in {more}"])
        return markdown(["raster", "max error", "`normal`", "`high`", "ratio", "`high --min-shape 0.1`"], lines)

    def angles(self):
        """The angles of terrain, and of the rest: the effect of the floor."""
        kinds = [("relief of land, sea floor and Mars", [case for (raster, _), case in self.cases.items()
                                                        if "hard" in case and is_terrain(raster)]),
                 ("houses, steps and walls", [case for (raster, _), case in self.cases.items()
                                              if "hard" in case and raster in STEEP])]
        lines = []
        for words, cases in kinds:
            for variant, name in (("normal", "`normal`"), ("hard", "`high --min-shape 0.1`"), ("high", "`high`")):
                found = [case[variant] for case in cases]
                triangles = geometric_mean([int(case[variant]["triangles"]) / int(case["hard"]["triangles"])
                                            for case in cases])
                lines.append([f"{words}, {len(cases)} cases" if variant == "normal" else "", name, f"{triangles:.3f}",
                              f"{statistics.median(float(row['angle_p1']) for row in found):.1f}°",
                              f"{statistics.median(float(row['thin_percent']) for row in found):.2f} %"])
        return markdown(["", "", "triangles ÷ `high --min-shape 0.1`'s", "first percentile of the smallest angles",
                         "triangles with an angle below 5°"], lines)


STEEP = ("athens_dsm_1m.tif", "cliff", "step", "sharp-step", "diagonal-step", "sharp-diagonal-step", "blocks", "stairs",
         "heaps")


def is_terrain(raster):
    return raster.endswith((".tif", ".asc", ".stm", ".hgt", ".zip")) and raster not in STEEP


def cliff_table(rows):
    """Triangles without walls → with walls."""
    efforts = values(rows, "effort")
    lines = []
    for raster, error in dict.fromkeys((row["raster"], row["error"]) for row in rows):
        case = {row["effort"]: row for row in rows if (row["raster"], row["error"]) == (raster, error)}
        lines.append([title(raster), error, f"{int(case[efforts[0]]['walls']):,}",
                      *(f"{int(row['plain']):,} → {int(row['cliffs']):,}, {float(row['share']):.2f}"
                        for row in map(case.get, efforts))])
    return markdown(["raster", "max error", "walls", *(f"`{effort}`" for effort in efforts)], lines)


def ridge_table(rows):
    """Triangles and RMSE on streams as shares of those without lines, percentage points of streams kept."""
    shown = (("fast", "preferred"), ("normal", "preferred"), ("normal", "kept"), ("high", "preferred"),
             ("high", "kept"))
    lines, names = [], values(rows, "raster")
    for raster, error in sorted({(row["raster"], row["error"]) for row in rows},
                                key=lambda one: (names.index(one[0]), float(one[1]))):
        case = {(row["effort"], row["lines"]): row for row in rows if (row["raster"], row["error"]) == (raster, error)}
        first = case["fast", "none"]
        cells = []
        for effort, kind in shown:
            row, plain = case[effort, kind], case[effort, "none"]
            points = 100 * (float(row["streams_kept"]) - float(plain["streams_kept"]))
            cells.append(f"{int(row['triangles']) / int(plain['triangles']):.2f}, "
                         f"{float(row['stream_rmse']) / float(plain['stream_rmse']):.2f}, "
                         f"{points:+.1f}".replace("-", "−"))
        lines.append([title(raster), error, f"{first['ridges']}, {first['valleys']}", *cells])
    return markdown(["raster", "max error", "ridges, valleys",
                     *(f"`{effort}`" if kind == "preferred" else f"`{effort}`, kept" for effort, kind in shown)],
                    lines)


def image_table(rows):
    """Max error and PSNR of each image by variant."""
    variants = values(rows, "variant")
    lines = []
    for image in values(rows, "image"):
        case = {row["variant"]: row for row in rows if row["image"] == image}
        lines.append([f"`{title(image)}`", *(f"{row['max_error']}, {float(row['psnr']):.1f} dB"
                                             for row in map(case.get, variants))])
    return markdown(["image", *(variant if variant == "uniform grid" else f"`{variant}`" for variant in variants)], lines)


def picture_table(rows):
    """The pictures of a scene side by side, and below what each shows: of one bound the triangles, of one budget the
    errors too."""
    words = {"greedy": "greedy insertion", "max": "`--objective max`", "rms": "`--objective rms`"}
    header = [words.get(row["effort"], f"`{row['effort']}`") for row in rows]
    pictures = [f"![{title(row['raster'])}, {row['effort']}](images/{row['picture']})" for row in rows]
    captions = []
    for row in rows:
        captions.append(f"{int(row['triangles']):,} triangles")
        if row["goal"].endswith("triangles"):
            captions[-1] += f", max error {float(row['max_error']):.1f}, RMSE {float(row['rmse']):.2f}"
        elif row is not rows[0]:
            captions[-1] += f", {int(row['triangles']) / int(rows[0]['triangles']):.2f}"
    return markdown(header, [pictures, captions])


def tables():
    """Every table by its name, without those whose file is not there."""
    efforts, peers, found = Efforts(), Peers(), {}
    if efforts.rows:
        found.update(efforts=efforts.summary(), triangles=efforts.triangles(), angles=efforts.angles())
    if peers.rows:
        found.update(peers=peers.summary(), peer_triangles=peers.triangles())
    pictures = read_table(HERE / "pictures.csv")
    for scene in values(pictures, "scene"):
        found[f"pictures_{scene}"] = picture_table([row for row in pictures if row["scene"] == scene])
    for name, table in (("cliffs", cliff_table), ("ridges", ridge_table), ("images", image_table)):
        if rows := read_table(HERE / f"{name}.csv"):
            found[name] = table(rows)
    budgets, squares, floors = Budgets(), Squares(), HighNormal()
    if budgets.rows:
        found.update(budget_summary=budgets.summary(), budgets=budgets.errors())
    if squares.rows:
        found.update(squares=squares.table())
    if floors.rows:
        found.update(high_normal=floors.worst(), floor_angles=floors.angles())
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing, fail if anything would change")
    check, found = parser.parse_args().check, tables()
    stale = []
    for document in DOCUMENTS:
        old = document.read_text()
        new = fill(old, found)
        if check and new != old:
            stale.append(document.name)
        elif not check:
            document.write_text(new)
    if stale:
        print(f"{' and '.join(stale)}: not what the CSV files say; run bench/quality/report.py")
    return int(bool(stale))


if __name__ == "__main__":
    sys.exit(main())
