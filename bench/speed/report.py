#!/usr/bin/env python3
"""Writes results.md, and the tables of bench/performance.md, from the CSV files that run.py and bench_orders keep.

  report.py            writes both
  report.py --check    fails if either would change
"""

import argparse
import json
import statistics
import sys
import textwrap

from rasters import HERE, PROJECT

sys.path.insert(0, str(HERE.parent))
from tables import fill, markdown, read_table  # noqa: E402

MACHINE = HERE / "machine.json"
RESULTS = HERE / "results.md"
DOCUMENT = PROJECT / "bench" / "performance.md"
PYTHON = PROJECT / "bench" / "python" / "calls.csv"
ORDERS = PROJECT / "bench" / "quality" / "orders.csv"
MILLION = 1_000_000


def read_machine():
    return json.loads(MACHINE.read_text()) if MACHINE.exists() else {}


def write_machine(machine):
    MACHINE.write_text(json.dumps(machine, indent=2) + "\n")


def by_case(rows, column):
    """{(raster, error): {value of column: row}}, in the order of the rows."""
    cases = {}
    for row in rows:
        cases.setdefault((row["raster"], row["error"]), {})[row[column]] = row
    return cases


def ratio(row, base, column):
    return float(row[column]) / float(base[column])


def ratios_cell(row, base, clock="cpu"):
    """Ratio of the minima and (of the medians)."""
    if row is None or base is None:
        return "–"
    return f"{ratio(row, base, clock + '_min_ms'):.2f} ({ratio(row, base, clock + '_median_ms'):.2f})"


def peers(rows):
    return by_case(rows, "program")


def time_table(rows):
    header = ["raster", "samples", "error", "kept %", "Scarp CPU ms, min (median)", "million samples a second",
              "÷ verification", "greedy ÷ Scarp", "delatin ÷ Scarp", "VTK ÷ Scarp", "wall: greedy", "delatin", "VTK"]
    lines = []
    for (name, error), case in peers(rows).items():
        ours = case.get("dominant")
        if ours is None:
            continue
        speed = int(ours["samples"]) / MILLION / (float(ours["cpu_min_ms"]) / 1e3)
        others = [case.get(peer) for peer in ("greedy", "delatin", "vtk")]
        lines.append([name, ours["samples"], error + (" †" if ours["engine"] != "dominant" else ""),
                      ours["kept_percent"], f"{ours['cpu_min_ms']} ({ours['cpu_median_ms']})", f"{speed:.1f}",
                      ratios_cell(ours, case.get("verify")), *(ratios_cell(other, ours) for other in others),
                      *(ratios_cell(other, ours, "wall") for other in others)])
    return markdown(header, lines)


def vertex_table(rows):
    header = ["raster", "error", "kept %", "vertices", "dominant ÷ greedy", "delatin ÷ Scarp", "VTK ÷ Scarp",
              "true max ÷ asked: dominant", "greedy", "delatin", "VTK"]
    lines = []
    for (name, error), case in peers(rows).items():
        ours = case.get("dominant")
        if ours is None:
            continue

        def vertices(row, base):
            return f"{ratio(row, base, 'vertices'):.4f}" if row and base else "–"

        errors = [case.get(peer) for peer in ("dominant", "greedy", "delatin", "vtk")]
        lines.append([name, error, ours["kept_percent"], ours["vertices"], vertices(ours, case.get("greedy")),
                      vertices(case.get("delatin"), ours), vertices(case.get("vtk"), ours),
                      *(f"{float(row['true_max_error']) / float(error):.3f}" if row and row["true_max_error"] else "–"
                        for row in errors)])
    return markdown(header, lines)


def spread_lines(rows):
    """Lowest, median and highest of each ratio."""
    lines = []
    for peer, words in (("greedy", "greedy ÷ Scarp"), ("delatin", "delatin ÷ Scarp"), ("vtk", "VTK ÷ Scarp"),
                        ("verify", "Scarp ÷ verification")):
        for large in (False, True):
            found = []
            for case in peers(rows).values():
                if "dominant" in case and peer in case and (int(case["dominant"]["samples"]) > 10 * MILLION) == large:
                    quotient = ratio(case[peer], case["dominant"], "cpu_min_ms")
                    found.append(1 / quotient if peer == "verify" else quotient)
            if found:
                lines.append(f"- {words}, CPU, rasters {'above' if large else 'below'} 10 million samples: lowest "
                             f"{min(found):.2f}, median {statistics.median(found):.2f}, highest {max(found):.2f}")
    return lines


def verify_table(rows):
    header = ["raster", "error", "triangles", "verification CPU ms", "ns a triangle", "million samples a second",
              "filling buffers and blocks, ms"]
    lines = []
    for (name, error), case in peers(rows).items():
        row = case.get("verify")
        if row:
            seconds = float(row["cpu_min_ms"]) / 1e3
            lines.append([name, error, row["triangles"], row["cpu_min_ms"],
                          f"{1e9 * seconds / int(row['triangles']):.0f}",
                          f"{int(row['samples']) / MILLION / seconds:.0f}", row["load_ms"]])
    return markdown(header, lines)


def kernel_table(rows):
    names = list(dict.fromkeys(row["kernel"] for row in rows))
    lines = []
    for (name, error), case in by_case(rows, "kernel").items():
        best = case.get(names[0])
        lines.append([name, error, best["cpu_min_ms"] if best else "–",
                      *(ratios_cell(case.get(kernel), best) for kernel in names[1:])])
    return markdown(["raster", "error", f"{names[0]}, CPU ms", *(f"{kernel} ÷ {names[0]}" for kernel in names[1:])],
                    lines)


def thread_table(rows):
    numbers = sorted({int(row["threads"]) for row in rows})
    header = ["raster", "error"]
    for number in numbers:
        header += [f"{number}: wall ms, min (median)", "user ms"]
    header += [f"speed-up with {number}" for number in numbers[1:]]
    lines = []
    for (name, error), case in by_case(rows, "threads").items():
        cells = [name, error]
        one = case.get(str(numbers[0]))
        for number in numbers:
            row = case.get(str(number))
            cells += [f"{row['wall_min_ms']} ({row['wall_median_ms']})", row["user_min_ms"]] if row else ["–", "–"]
        cells += [ratios_cell(one, case.get(str(number)), "wall") for number in numbers[1:]]
        lines.append(cells)
    return markdown(header, lines)


def call_table(rows):
    header = ["raster", "error", "order", "call", "wall ms", "user ms", "system ms", "page faults"]
    columns = ["raster", "error", "order", "call", "wall_ms", "user_ms", "system_ms", "page_faults"]
    return markdown(header, [[row[column] for column in columns] for row in rows])


def python_table(rows):
    header = ["", "beyond the library", "of which Python's"]
    unit = {"us": "µs", "ms": "ms CPU"}
    cells = [[("`import %s`" if row["what"] == "import" else "%s") % row["kind"],
              "%s %s" % (row["beyond"], unit[row["unit"]]), "%s µs" % row["python"] if row["python"] else ""]
             for row in rows]
    return markdown(header, cells)


def program_table(rows):
    """Whole programs: CPU on one thread, delatin's in multiples of it, wall clock on the most threads."""
    most = max(int(row["threads"]) for row in rows)
    header = ["raster", "error", "program", "vertices", "CPU ms, min (median)", "delatin ÷ it",
              f"wall: 1 thread ÷ {most}", "peak MB", "passes, ms"]
    lines = []
    for (name, error), case in by_case([row for row in rows if row["threads"] == "1"], "program").items():
        threaded = {row["program"]: row for row in rows if (row["raster"], row["error"]) == (name, error)
                    and row["threads"] == str(most) != "1"}
        for program, row in case.items():
            lines.append([name, error, program, row["vertices"] or "–",
                          f"{row['cpu_min_ms']} ({row['cpu_median_ms']})",
                          ratios_cell(case.get("delatin"), row) if program != "delatin" else "1",
                          ratios_cell(row, threaded.get(program), "wall"), row["peak_mb"],
                          row["passes_ms"]])
    return markdown(header, lines)


def tile_table(rows, start, what):
    """By side; the largest side holds the raster in one tile, and is what the others are compared with."""
    sides = sorted({int(row["side"]) for row in rows})
    lines = []
    for (name, error), case in by_case([row for row in rows if row["start"] == start], "side").items():
        whole = case.get(str(sides[-1]))
        lines.append([name, error, *(what(case.get(str(side)), whole, (name, error, side)) for side in sides)])
    return markdown(["raster", "error", *(f"{side}" for side in sides[:-1]), "one tile"], lines)


def percent_more(row, base):
    return "–" if row is None or base is None else f"{100 * (ratio(row, base, 'vertices') - 1):+.2f} %"


def border_table(rows):
    """Vertices by side, started from two triangles."""
    return tile_table(rows, "two triangles",
                      lambda row, whole, _: "–" if row is None else row["vertices"] if row is whole else
                      percent_more(row, whole))


def start_table(rows):
    plain = {(row["raster"], row["error"], int(row["side"])): row for row in rows if row["start"] == "two triangles"}

    def cell(row, _, case):
        if row is None:
            return "–"
        return f"{percent_more(row, plain[case])}, ×{ratio(plain[case], row, 'cpu_ms'):.2f}"

    return tile_table(rows, "coarse", cell)


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


def goal_table(rows):
    """The table of goals.py."""
    return markdown(["goal", "case", "ratio, or ms", "of", "peer"],
                    [[row["goal"], row["case"], row["value"], row["how"], row["peer"] or "–"] for row in rows])


def bullet(words):
    """Lines of an item of a list."""
    return textwrap.wrap(words, 118, initial_indent="- ", subsequent_indent="  ", break_on_hyphens=False)


def head():
    machine = read_machine()
    has = "has" if machine.get("avx512") else "has no"
    return [
        "# Speed of the triangulation",
        "",
        "Written by `report.py` from the CSV files next to it (see `bench/README.md`). \"Scarp\" is the dominant order, its",
        "default; \"greedy\" is its own engine for the greedy order. Ratios are a program's time divided by Scarp's, above 1",
        "where Scarp is faster: the minima of all rounds and (the medians). One thread, triangulation only. CPU time is",
        "the process's own, of all its threads (node collects garbage in others). Wall clock also counts waiting for a",
        "processor that others use.",
        "",
        *bullet(f"machine: {machine.get('machine')}, {machine.get('processors')} logical processors; it {has} AVX-512; "
                f"load average at the start {machine.get('load')}"),
        f"- compiler: {machine.get('compiler')}, CMake's Release flags and the project's",
        *(line for remark in machine.get("remarks", []) for line in bullet(remark)),
        *(f"- {name}: {version}" for name, version in machine.get("versions", {}).items()),
        "",
    ]


def tables():
    """Every table by its name, without those whose file is not there."""
    results, orders = read_table(HERE / "results.csv"), read_table(ORDERS)
    found = {}
    if results:
        found.update(time=time_table(results), vertices=vertex_table(results), verification=verify_table(results),
                     spread=spread_lines(results))
    for name, file, make in (("kernels", "kernels.csv", kernel_table), ("threads", "threads.csv", thread_table),
                             ("calls", "calls.csv", call_table),
                              ("programs", "programs.csv", program_table), ("borders", "tiles.csv", border_table),
                             ("starts", "tiles.csv", start_table), ("goals", "goals.csv", goal_table)):
        rows = read_table(HERE / file)
        if rows:
            found[name] = make(rows)
    python = read_table(PYTHON)
    if python:
        found["python"] = python_table(python)
    if orders:
        found["orders"] = order_table(orders)
    return found


SECTIONS = (
    ("time", "Time",
     "*÷ verification*: Scarp's time in multiples of one verification of its mesh. †: no tiles, greedy order taken."),
    ("spread", "Spread", ""),
    ("verification", "Verification",
     "Every triangle of the finished mesh scanned once by the best kernels: less work proves no bound."),
    ("vertices", "Vertices and errors",
     "*true max*: a mesh's max error as `measure()` judges it; above 1 the bound is broken."),
    ("kernels", "Instruction sets", "The same meshes, bit for bit."),
    ("threads", "Threads", "The same meshes, bit for bit."),
    ("calls", "Calls in one process", "The first call, and the mean of 49 later ones; each frees its mesh again."),
    ("programs", "Whole programs",
     "A deflated GeoTIFF in, a GLB out; the proof included. delatin: node's process from raw samples to raw triangles."),
    ("borders", "Tiles: vertices with fixed borders",
     "By side of the tiles, each started from two triangles; against the raster as one tile (last column, vertices)."),
    ("starts", "Starts: coarse starts against two triangles",
     "By side of the tiles: vertices more or less, and how many times faster (one run)."),
    ("goals", "Goals", "What `goals.py` measured, and from which times: its functions of these names define each of them."),
)


def results_text(found):
    lines = head()
    for name, title, words in SECTIONS:
        if name in found:
            lines += [f"## {title}", "", *([words, ""] if words else []), *found[name], ""]
    return "\n".join(lines).rstrip() + "\n"


def document_text(found):
    return fill(DOCUMENT.read_text(), found)


def write():
    found = tables()
    RESULTS.write_text(results_text(found))
    DOCUMENT.write_text(document_text(found))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing, fail if anything would change")
    if not parser.parse_args().check:
        return write()
    found = tables()
    stale = [path.name for path, text in ((RESULTS, results_text(found)), (DOCUMENT, document_text(found)))
             if path.read_text() != text]
    if stale:
        print(f"{' and '.join(stale)} do not hold what the CSV files say: run bench/speed/report.py")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
