#!/usr/bin/env python3
"""Writes the tables in the pages of bench/ from the CSV files next to them.

  report.py            writes them
  report.py --check    fails if a page would change
"""

import argparse
import json
import math
import statistics
import sys
import textwrap

from harness import BENCH, fill, markdown, read_table

PAGES = ("quality.md", "performance.md", "tiles.md")
QUALITY, SPEED, TILES = BENCH / "quality", BENCH / "speed", BENCH / "tiles"

FULL_QUARTER = 25  # percentage of the full grid: if greedy insertion needs more, triangles span only a few samples


def geometric_mean(numbers):
    return math.exp(statistics.fmean(math.log(number) for number in numbers))


def spread(numbers, digits=2):
    """Geometric mean (least to most)."""
    if not numbers:
        return "–"
    return f"{geometric_mean(numbers):.{digits}f} ({min(numbers):.{digits}f} to {max(numbers):.{digits}f})"


def times_of(table, digits):
    """Geometric means of CPU times relative to greedy insertion's, by variant."""
    return {row["variant"]: "{:.{d}f} ({:.{d}f} to {:.{d}f})".format(*(float(row[key]) for key in ("mean", "least", "most")), d=digits)
            for row in read_table(QUALITY / "times.csv") if row["table"] == table}


def by_case(rows, column, goal="percent_of_relief"):
    """{(raster, goal): {value of column: row}}, in the order of the rows."""
    cases = {}
    for row in rows:
        cases.setdefault((row["raster"], row[goal]), {})[row[column]] = row
    return cases


def values(rows, column):
    """Distinct values in their first order."""
    return list(dict.fromkeys(row[column] for row in rows))


def title(raster):
    return raster.rsplit(".", 1)[0]


class Efforts:
    """efforts.csv."""

    def __init__(self):
        rows = read_table(QUALITY / "efforts.csv")
        self.rows, self.cases, self.times = rows, by_case(rows, "effort"), times_of("efforts", 1)
        self.efforts = [effort for effort in values(rows, "effort") if effort != "greedy"]

    def ratios(self, effort, column, which):
        """Ratios of a column to greedy insertion's, over cases of one kind."""
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
            cells += [spread(self.ratios(effort, "rmse", lambda _: True)), self.times[effort]]
            lines.append([f"`{effort}`", *cells])
        return markdown(header, lines)

    def angles(self):
        lines = []
        for effort in ["greedy", *self.efforts]:
            rows = [case[effort] for case in self.cases.values() if effort in case]
            lines.append([f"`{effort}`" if effort != "greedy" else effort,
                          *(f"{statistics.median(float(row[column]) for row in rows):.1f}°"
                            for column in ("angle_median", "angle_p1")),
                          f"{min(float(row['min_angle']) for row in rows):.2g}°"])
        return markdown(["", "median of the smallest angles", "their first percentile", "smallest of all"], lines)


def is_sparse(greedy):
    return float(greedy["percent_of_full"]) < FULL_QUARTER


def is_broken(row):
    return float(row["max_error"]) > float(row["max_error_asked"]) * (1 + 1e-7)


class Peers:
    """peers.csv."""

    def __init__(self):
        rows = read_table(QUALITY / "peers.csv")
        self.rows, self.cases, self.times = rows, by_case(rows, "program"), times_of("peers", 1)
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
                          sum(row["folded"] != "0" for row, _ in kept), self.times.get(program, "–")])
        return markdown(header, lines)


class Budgets:
    """budgets.csv."""

    def __init__(self):
        rows = read_table(QUALITY / "budgets.csv")
        self.rows, self.cases, self.times = rows, by_case(rows, "variant"), times_of("budgets", 0)
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
                          f"{100 * min(used):.1f} %", self.times[variant],
                          spread(self.ratios(variant, "rmse", "high", of_walls=True))])
        return markdown(["geometric mean (least to most)", "cases", "max error ÷ greedy's", "RMSE ÷ greedy's",
                         "RMSE ÷ that of `high`", "least used of the budget", "CPU time ÷ greedy's",
                         "on walls (athens_dsm_1m): RMSE ÷ that of `high`"], lines)


class Squares:
    """squares.csv."""

    def __init__(self):
        self.rows, self.cases = read_table(QUALITY / "squares.csv"), {}
        for row in self.rows:
            self.cases.setdefault(row["raster"], {})[row["program"]] = row
        self.programs = [program for program in values(self.rows, "program")
                         if program not in ("Scarp greedy", "Scarp high rms")]

    def best(self, case):
        """The least RMSE of other programs relative to Scarp's."""
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


def optimum_table(rows):
    """Triangles relative to the optimum by effort and size, and the best and the worst field."""
    sizes = values(rows, "optimum")
    lines = []
    for effort in values(rows, "effort"):
        of_effort = [row for row in rows if row["effort"] == effort]
        means = [geometric_mean([float(row["ratio"]) for row in of_effort if row["optimum"] == size]) for size in sizes]
        ends = [sorted(of_effort, key=lambda row: float(row["ratio"]))[i] for i in (0, -1)]
        lines.append([f"`{effort}`" if effort != "greedy" else effort, *(f"{mean:.2f}" for mean in means),
                      " … ".join(f"{float(row['ratio']):.2f} ({row['field']})" for row in ends),
                      f"{statistics.median(float(row['rmse']) / float(row['max_error_asked']) for row in of_effort):.2f}",
                      f"{statistics.median(float(row['angle_median']) for row in of_effort):.0f}°"])
    return markdown(["triangles ÷ optimum", *(f"optimum of {int(size):,}" for size in sizes), "least and most",
                     "median of RMSE ÷ max error", "median of the smallest angles"], lines)


WORST = 12  # rows of the table


class HighNormal:
    """high_normal.csv."""

    def __init__(self):
        self.rows = read_table(QUALITY / "high_normal.csv")
        self.cases = by_case(self.rows, "variant")

    def worst(self):
        """The case with the smallest saving of high."""
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
        """Angles for terrain and others: the effect of the floor."""
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
    """Triangles and RMSE on streams as shares of those without lines, and percentage points of preserved streams."""
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
    """The pictures of a scene side by side, with captions: for a bound the triangles, for a budget also the errors."""
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


def spread_lines(rows):
    """The spread in speed/results.csv: lowest, median and highest of each ratio."""
    lines = []
    for peer, words in (("greedy", "greedy ÷ Scarp"), ("delatin", "delatin ÷ Scarp"), ("vtk", "VTK ÷ Scarp"),
                        ("verify", "Scarp ÷ verification")):
        for large in (False, True):
            found = []
            for case in by_case(rows, "program", "error").values():
                if "dominant" in case and peer in case and (int(case["dominant"]["samples"]) > 10_000_000) == large:
                    quotient = float(case[peer]["cpu_min_ms"]) / float(case["dominant"]["cpu_min_ms"])
                    found.append(1 / quotient if peer == "verify" else quotient)
            if found:
                lines.append(f"- {words}, CPU, rasters {'above' if large else 'below'} 10 million samples: lowest "
                             f"{min(found):.2f}, median {statistics.median(found):.2f}, highest {max(found):.2f}")
    return lines


def python_table(rows):
    header = ["", "beyond the library", "of which Python's"]
    unit = {"us": "µs", "ms": "ms CPU"}
    cells = [[("`import %s`" if row["what"] == "import" else "%s") % row["kind"],
              "%s %s" % (row["beyond"], unit[row["unit"]]), "%s µs" % row["python"] if row["python"] else ""]
             for row in rows]
    return markdown(header, cells)


def order_table(rows):
    """The table of bench_orders: the highest ratios, and the summaries."""
    meshes = [row for row in rows if row["samples"]]
    groups = (("below 0.1", 0, 0.1), ("0.1 to 1", 0.1, 1), ("above 1", 1, 101))
    lines = []
    for words, low, high in groups:
        ratios = [float(row["ratio"]) for row in meshes if low <= float(row["greedy_percent_kept"]) < high]
        if ratios:
            lines.append([words, len(ratios), f"{min(ratios):.3f}", f"{statistics.median(ratios):.3f}",
                          f"{max(ratios):.3f}", sum(one > 1.01 for one in ratios)])
    return markdown(["kept %", "meshes", "lowest", "median", "highest", "above 1.01"], lines)


def machine_lines():
    """The machine of the speed tables."""
    machine = json.loads((SPEED / "machine.json").read_text())
    has = "has" if machine.get("avx512") else "has no"
    lines = [f"{machine.get('machine')}, {machine.get('processors')} logical processors; it {has} AVX-512; load average at the start "
             f"{machine.get('load')}", f"compiler: {machine.get('compiler')}, CMake's Release flags and the project's",
             *machine.get("remarks", []), *(f"{name}: {version}" for name, version in machine.get("versions", {}).items())]
    return [wrapped for line in lines
            for wrapped in textwrap.wrap(line, 118, initial_indent="- ", subsequent_indent="  ", break_on_hyphens=False)]


MAKERS = {"ctb": "", "martini": "martini", "fast": "Scarp `fast`", "normal": "Scarp `normal`",
          "high": "Scarp `high`"}


def number(text):
    return f"{float(text):,.0f}" if text else "–"


def tile_row(row):
    differ = f"{number(row['edges_differ'])} of {number(row['edges'])}" if row["edges"] else "–"
    if row.get("edges_places_differ") not in (None, "", "0"):
        differ += f", {number(row['edges_places_differ'])} by their vertices"
    return [MAKERS[row["maker"]], number(row["triangles"]), number(row["bytes"]),
            f"{float(row['error_median']):,.1f} / {float(row['error_worst']):,.1f} m", differ]


def tile_tables():
    header = ["triangles a tile", "bytes a tile", "true error, median / worst tile", "edges that differ"]
    rows = read_table(TILES / "tiles.csv")
    return {
        **{f"level_{z}": markdown(["", *header], [tile_row(row) for row in rows if row["level"] == str(z)]) for z in (12, 10, 8)},
        "ctb": markdown(["level, asked", *header],
                        [[f"{row['level']}, {row['asked']} m", *tile_row(row)[1:]] for row in read_table(TILES / "ctb.csv")]),
        "time": markdown(["", "CPU ms a tile"], [[MAKERS[row["maker"]], f"{float(row['cpu_ms']):.1f}"]
                                                 for row in read_table(TILES / "tiles_seconds.csv")]),
    }


def tables():
    """Every table by its name."""
    efforts, budgets, floors = Efforts(), Budgets(), HighNormal()
    of = lambda name: read_table(QUALITY / f"{name}.csv")  # noqa: E731
    pictures = of("pictures")
    return {
        "efforts": efforts.summary(), "angles": efforts.angles(), "peers": Peers().summary(), "budget_summary": budgets.summary(),
        "squares": Squares().table(), "high_normal": floors.worst(), "floor_angles": floors.angles(),
        "optimum": optimum_table(of("optimum")),
        "cliffs": cliff_table(of("cliffs")), "ridges": ridge_table(of("ridges")), "images": image_table(of("images")),
        **{f"pictures_{scene}": picture_table([row for row in pictures if row["scene"] == scene]) for scene in values(pictures, "scene")},
        "spread": spread_lines(read_table(SPEED / "results.csv")), "orders": order_table(of("orders")),
        "python": python_table(read_table(BENCH / "python" / "calls.csv")), "machine": machine_lines(), **tile_tables(),
    }


def write(check=False):
    """Rewrites the pages and returns the names of those that change; with `check` writes nothing."""
    found, changed = tables(), []
    for page in PAGES:
        old = (BENCH / page).read_text()
        new = fill(old, found)
        if new != old:
            changed.append(page)
        if not check:
            (BENCH / page).write_text(new)
    return changed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing, fail if anything would change")
    check = parser.parse_args().check
    changed = write(check)
    if check and changed:
        sys.exit(f"{' and '.join(changed)}: not what the CSV files hold; run bench/report.py")


if __name__ == "__main__":
    main()
