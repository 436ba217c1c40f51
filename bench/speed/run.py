#!/usr/bin/env python3
"""Times triangulation only: Scarp, delatin (node) and VTK, in interleaved rounds, and writes results.csv and results.md.

A round runs each program once on the same raw raster with the same error. Each is one process that warms up, then
reports its own time; reading and writing are outside of it. In the last round each mesh is judged by measure().

  run.py --bin build/bin              the whole table (about half an hour)
  run.py --bin build/bin --only fuji  some rasters, results printed and not kept
  run.py --bin build/bin --find       chooses the errors of ERRORS anew
"""

import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from rasters import HERE, RASTERS, cpu_model, make_raw

SHARES = (0.001, 0.01, 0.05)

# The errors that keep about 0.1 %, 1 % and 5 % of the samples, as --find gave them, rounded to three digits.
ERRORS = {
    "jacksboro": (274, 92.4, 30),
    "fuji": (217, 49.9, 16.9),
    "crater": (107, 24.2, 6.46),
    "puget_1k": (589, 180, 66),
    "baltoro": (912, 220, 61),
    "essen_dom": (20.6, 11.1, 4.87),
    "everest": (659, 178, 60.1),
    "sierra_3601": (238, 70.8, 23.6),
    "moon_4096": (112, 18.4, 4.62),
}

PEERS = ("delatin", "vtk")

# Above this many samples there are fewer rounds, and VTK, the slowest by far, runs in the last one only.
LARGE = 2_000_000


def programs(folder):
    found = {"scarp": [str(folder / "speed_scarp")], "delatin": ["node", str(HERE / "speed_delatin.mjs")]}
    if (folder / "speed_vtk").exists():
        found["vtk"] = [str(folder / "speed_vtk")]
    if not (HERE / "node_modules" / "delatin").is_dir():
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=HERE, check=True)
    return found


def call(command):
    done = subprocess.run([str(part) for part in command], check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def time_case(found, judge, raster, error, rounds, scratch):
    """Per program: its last report with all its times and the judge's verdict."""
    cases = {name: {"wall": [], "cpu": []} for name in found}
    names = list(found)
    for number in range(rounds):
        last = number == rounds - 1
        for name in names[number % len(names):] + names[:number % len(names)]:
            if name == "vtk" and raster[1] * raster[2] > LARGE and not last:
                continue
            mesh = Path(scratch) / f"{name}.mesh"
            report = call([*found[name], *raster, error, *([mesh] if last else [])])
            case = cases[name]
            case["wall"].append(report["seconds"])
            case["cpu"].append(report["cpu_seconds"])
            case.update(version=report["version"], vertices=report["vertices"], triangles=report["triangles"])
            if last:
                case["judged"] = call([judge, *raster, mesh])
                mesh.unlink()
    return cases


def rows_of(name, raster, error, cases):
    samples = raster[1] * raster[2]
    for program, case in cases.items():
        yield {
            "raster": name,
            "samples": samples,
            "error": f"{error:g}",
            "program": program,
            "vertices": case["vertices"],
            "triangles": case["triangles"],
            "kept_percent": f"{100 * case['vertices'] / samples:.3f}",
            "true_max_error": f"{case['judged']['max_error']:.6g}",
            "rmse": f"{case['judged']['rmse']:.6g}",
            "uncovered": case["judged"]["uncovered"],
            "rounds": len(case["wall"]),
            "wall_min_ms": f"{1e3 * min(case['wall']):.2f}",
            "wall_median_ms": f"{1e3 * statistics.median(case['wall']):.2f}",
            "cpu_min_ms": f"{1e3 * min(case['cpu']):.2f}",
            "cpu_median_ms": f"{1e3 * statistics.median(case['cpu']):.2f}",
        }


def by_case(rows):
    cases = {}
    for row in rows:
        cases.setdefault((row["raster"], row["error"]), {})[row["program"]] = row
    return cases


def ratio(peer, ours, column):
    return float(peer[column]) / float(ours[column])


def markdown(rows, versions, compiler, load):
    lines = [
        "# Speed of the triangulation",
        "",
        "Written by `run.py` (see `bench/README.md`); the times of each program are in `results.csv`. Ratios are the",
        "peer's time divided by Scarp's, above 1 where Scarp is faster: the minimum of all rounds and (the median). CPU",
        "time is the process's own, all its threads (node collects garbage in others); wall clock also counts waiting for",
        "a processor that others use. *true max* is a mesh's max error as `measure()` judges it, divided by the error that",
        "was asked: above 1 the bound is broken.",
        "",
        f"- machine: {cpu_model()}, {os.cpu_count()} logical processors, one thread used; load average at the start {load:.1f}",
        f"- compiler: {compiler}, CMake's Release flags and the project's",
        *(f"- {name}: {version}" for name, version in versions.items()),
        "",
        "| raster | samples | error | kept % | Scarp CPU ms | delatin ÷ Scarp, CPU | wall | VTK ÷ Scarp, CPU | wall "
        "| vertices delatin, VTK (Scarp = 1) | true max Scarp, delatin, VTK |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for (name, error), case in by_case(rows).items():
        ours = case["scarp"]
        cells = [name, ours["samples"], error, ours["kept_percent"], ours["cpu_min_ms"]]
        peers = [case[peer] if peer in case else None for peer in PEERS]
        for p in peers:
            for clock in ("cpu", "wall"):
                cells.append(f"{ratio(p, ours, clock + '_min_ms'):.2f} ({ratio(p, ours, clock + '_median_ms'):.2f})"
                             if p else "–")
        cells.append(", ".join(f"{ratio(p, ours, 'vertices'):.3f}" if p else "–" for p in peers))
        cells.append(", ".join(
            f"{float(p['true_max_error']) / float(error):.3f}" if p else "–" for p in [ours, *peers]))
        lines.append("| " + " | ".join(str(cell) for cell in cells) + " |")
    lines.append("")
    for peer in PEERS:
        for clock, words in (("cpu", "CPU"), ("wall", "wall clock")):
            ratios = sorted(
                ratio(case[peer], case["scarp"], clock + "_min_ms") for case in by_case(rows).values() if peer in case)
            if ratios:
                lines.append(f"- {peer} ÷ Scarp over all cases, {words}: lowest {ratios[0]:.2f}, median "
                             f"{statistics.median(ratios):.2f}, highest {ratios[-1]:.2f}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the built programs")
    parser.add_argument("--compiler", default="not told", help="for the record")
    parser.add_argument("--rounds", type=int, help="instead of 5, or 2 above 2 million samples")
    parser.add_argument("--only", nargs="*", choices=RASTERS, help="these rasters; nothing is kept")
    parser.add_argument("--find", action="store_true", help="print the errors for SHARES instead")
    options = parser.parse_args()
    names = options.only or list(RASTERS)
    load = os.getloadavg()[0]
    rows, versions = [], {}
    with tempfile.TemporaryDirectory() as scratch:
        for name in names:
            raster = make_raw(name, scratch)
            if raster is None:
                continue
            if options.find:
                errors = [call([options.bin / "speed_scarp", *raster, "--find", share]) for share in SHARES]
                print(f'    "{name}": ({", ".join(f"{error:.3g}" for error in errors)}),', flush=True)
                continue
            rounds = options.rounds or (5 if raster[1] * raster[2] <= LARGE else 2)
            for error in ERRORS[name]:
                cases = time_case(programs(options.bin), options.bin / "speed_judge", raster, error, rounds,
                                  scratch)
                versions.update((program, case["version"]) for program, case in cases.items())
                for row in rows_of(name, raster, error, cases):
                    rows.append(row)
                    print(*row.values(), sep=",", flush=True)
    if options.find or not rows:
        return
    report = markdown(rows, versions, options.compiler, load)
    if options.only:
        print(report)
        return
    with open(HERE / "results.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    (HERE / "results.md").write_text(report)


if __name__ == "__main__":
    sys.exit(main())
