#!/usr/bin/env python3
"""Times triangulation only (except "programs") in interleaved rounds; updates CSV tables next to this file.

  peers    Scarp's two orders, delatin (node), VTK, one verification of Scarp's mesh     results.csv
  kernels  the instruction sets of this machine, each forced in turn                     kernels.csv
  threads  one thread against more                                                       threads.csv
  calls    the first call of a process against later ones                                calls.csv
  programs whole programs, GeoTIFF to GLB, by effort; delatin's process                  programs.csv

A round runs each program once on the same raw raster with the same error. Each is a process that warms up, then reports
its time without reading and writing. In the last round measure() judges each mesh.

  run.py --bin build/bin                     everything (about an hour)
  run.py --bin build/bin --only fuji         some rasters, printed only
  run.py --bin build/bin --only fuji --keep  some rasters; replaces their rows
  run.py --bin build/bin --find              chooses the errors of rasters.py anew
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from programs import time_programs
from rasters import ERRORS, HERE, LARGE, RASTERS, SHARES, make_raw

sys.path.insert(0, str(HERE.parent))
import report  # noqa: E402
from harness import arguments_of, install, interleave, keep_rows, report_of  # noqa: E402

KERNELS = ("AVX3", "AVX2", "SSE4", "NEON", "WASM", "SCALAR")

# Rasters of the parts that need not run on all.
PART_RASTERS = {
    "peers": tuple(RASTERS),
    "kernels": ("fuji", "essen_dom", "sierra_3601", "moon_4096"),
    "threads": ("essen_dom", "sierra_3601", "moon_4096", "fractal_4096", "sierra_mosaic"),
    "calls": ("fuji", "essen_dom", "sierra_3601"),
    "programs": ("fuji", "essen_dom", "sierra_3601", "moon_4096"),
}


class Bench:
    """The paths of the programs and the number of runs."""

    def __init__(self, options, scratch):
        self.bin, self.scratch, self.options = options.bin, Path(scratch), options
        self.versions = {}

    def rounds(self, raster):
        return self.options.rounds or (5 if raster[1] * raster[2] <= LARGE else 2)

    def scarp(self, *arguments):
        return [self.bin / "speed_scarp", *arguments]


def times_of(reports):
    """Least and median, in milliseconds."""
    cells = {"rounds": len(reports)}
    for clock, key in (("wall", "seconds"), ("cpu", "cpu_seconds")):
        times = [1e3 * one[key] for one in reports]
        cells[f"{clock}_min_ms"] = f"{min(times):.3f}"
        cells[f"{clock}_median_ms"] = f"{statistics.median(times):.3f}"
    return cells


def time_peers(bench, name, raster, error):
    """For each program: times, mesh and the judge's verdict."""
    judged = {}

    def runner(program, command, option=()):
        def run(last):
            if not last:
                return report_of([*command, *raster, error])
            mesh = bench.scratch / f"{program}.mesh"
            done = report_of([*command, *raster, error, *option, mesh])
            judged[program] = report_of([bench.bin / "peer_judge", *raster, "lattice", mesh])
            mesh.unlink()
            return done
        return run

    def order(which):
        judged_run = runner(which, bench.scarp(), ("--order", which, "--mesh"))
        return lambda last: judged_run(True) if last else report_of(bench.scarp(*raster, error, "--order", which))

    commands = {
        "dominant": order("dominant"),
        "greedy": order("greedy"),
        "delatin": runner("delatin", ["node", HERE / "speed_delatin.mjs"]),
        "vtk": runner("vtk", [bench.bin / "speed_vtk"]),
        "verify": lambda last: report_of([bench.bin / "speed_verify", *raster, error]),
    }
    wanted = bench.options.programs or list(commands)
    if not (bench.bin / "speed_vtk").exists():
        wanted = [program for program in wanted if program != "vtk"]
    commands = {program: run for program, run in commands.items() if program in wanted}
    if "delatin" in commands:
        install("delatin")
    samples = raster[1] * raster[2]
    once = ("vtk", "delatin") if samples > 10 * LARGE else ("vtk",) if samples > LARGE else ()
    for program, reports in interleave(commands, bench.rounds(raster), once).items():
        last, verdict = reports[-1], judged.get(program, {})
        bench.versions["scarp" if program in ("dominant", "greedy", "verify") else program] = last["version"]
        yield {
            "raster": name, "samples": samples, "error": f"{error:g}", "program": program,
            "engine": last.get("order", ""), "vertices": last["vertices"], "triangles": last["triangles"],
            "kept_percent": f"{100 * last['vertices'] / samples:.3f}",
            "true_max_error": f"{verdict['max_error']:.6g}" if verdict else "",
            "rmse": f"{verdict['rmse']:.6g}" if verdict else "",
            "uncovered": verdict.get("uncovered", ""), **times_of(reports),
            "load_ms": f"{1e3 * min(one['load_seconds'] for one in reports):.3f}" if program == "verify" else "",
        }


def kernel_runs(bench, kernel, raster):
    """The program ignores sets that the machine lacks, and reports the one it used."""
    return report_of(bench.scarp(*raster, 1e30), SCARP_KERNEL=kernel)["kernel"] == kernel


def time_kernels(bench, name, raster, error):
    def forced(kernel):
        return lambda last: report_of(bench.scarp(*raster, error), SCARP_KERNEL=kernel)

    usable = [kernel for kernel in KERNELS if kernel_runs(bench, kernel, raster)]
    for kernel, reports in interleave({kernel: forced(kernel) for kernel in usable}, bench.rounds(raster)).items():
        yield {"raster": name, "samples": raster[1] * raster[2], "error": f"{error:g}", "kernel": kernel,
               "vertices": reports[-1]["vertices"], **times_of(reports)}


def time_threads(bench, name, raster, error):
    def threaded(threads):
        return lambda last: report_of(bench.scarp(*raster, error, "--threads", threads))

    commands = {threads: threaded(threads) for threads in bench.options.threads}
    for threads, reports in interleave(commands, bench.rounds(raster)).items():
        yield {"raster": name, "samples": raster[1] * raster[2], "error": f"{error:g}", "threads": threads,
               "vertices": reports[-1]["vertices"], **times_of(reports),
               "user_min_ms": f"{1e3 * min(one['user_seconds'] for one in reports):.3f}"}


def time_calls(bench, name, raster, error):
    large = raster[1] * raster[2] > LARGE
    for order in ("dominant",) if large else ("dominant", "greedy"):
        done = report_of(bench.scarp(*raster, error, "--order", order, "--repeat", 10 if large else 50))
        for which, times in (("first", done["first"]), ("later", done)):
            yield {"raster": name, "samples": raster[1] * raster[2], "error": f"{error:g}", "order": order,
                   "call": which, "wall_ms": f"{1e3 * times['seconds']:.3f}",
                   "user_ms": f"{1e3 * times['user_seconds']:.3f}",
                   "system_ms": f"{1e3 * times['system_seconds']:.3f}", "page_faults": f"{times['page_faults']:.1f}"}


PARTS = {
    "peers": (time_peers, "results.csv", ("raster", "error", "program")),
    "kernels": (time_kernels, "kernels.csv", ("raster", "error", "kernel")),
    "threads": (time_threads, "threads.csv", ("raster", "error", "threads")),
    "calls": (time_calls, "calls.csv", ("raster", "error", "order", "call")),
    "programs": (time_programs, "programs.csv", ("raster", "error", "program", "threads")),
}


def keep(part, new, complete):
    """Replaces old rows with the same keys, in the order of the rasters; with `complete` drops all old rows."""
    _, file, keys = PARTS[part]
    places = {name: place for place, name in enumerate(RASTERS)}
    if complete and new:
        (HERE / file).unlink(missing_ok=True)
    keep_rows(HERE / file, new, keys, lambda row: (places[row["raster"]], -float(row["error"])))


def describe_machine(options, bench, load, partial):
    """Remarks are handwritten notes about rows from several sittings; a complete run needs none."""
    path = HERE / "machine.json"
    old = json.loads(path.read_text()) if path.exists() else {}
    facts = dict(line.split(":", 1) for line in Path("/proc/cpuinfo").read_text().splitlines() if ":" in line)
    facts = {key.strip(): value.strip() for key, value in facts.items()}
    path.write_text(json.dumps({
        "machine": facts.get("model name", "unknown"), "processors": os.cpu_count(),
        "avx512": "avx512f" in facts.get("flags", ""), "compiler": options.compiler or old.get("compiler", "not told"),
        "load": f"{load:.1f}", "remarks": old.get("remarks", []) if partial else [],
        "versions": {**old.get("versions", {}), **bench.versions},
    }, indent=2) + "\n")


def find_errors(bench, names):
    for name in names:
        raster = make_raw(name, bench.scratch, bench.bin)
        if raster is not None:
            done = subprocess.run([str(part) for part in bench.scarp(*raster, "--find", *SHARES)], check=True,
                                  stdout=subprocess.PIPE, text=True)
            errors = ", ".join(f"{float(error):.3g}" for error in done.stdout.split())
            print(f'    "{name}": ({errors}),', flush=True)


def powers_of_two(most):
    return [1 << k for k in range(most.bit_length()) if 1 << k <= most]


def parse():
    parser = arguments_of(__doc__)
    parser.add_argument("--compiler", help="for the record")
    parser.add_argument("--rounds", type=int, help="instead of 5, or 2 above 2 million samples")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS), help="some of the tables")
    parser.add_argument("--only", nargs="+", choices=RASTERS, help="some of the rasters; printed only")
    parser.add_argument("--keep", action="store_true", help="with --only or --programs: keep the rows nevertheless")
    parser.add_argument("--programs", nargs="+", choices=("dominant", "greedy", "delatin", "vtk", "verify"),
                        help="some of the peers; printed only")
    parser.add_argument("--threads", nargs="+", type=int, default=powers_of_two(os.cpu_count()),
                        help="numbers of threads to compare (default: powers of two up to this machine's processors)")
    parser.add_argument("--find", action="store_true", help="print the errors for rasters.py instead")
    return parser.parse_args()


def main():
    options = parse()
    names = options.only or list(RASTERS)
    load = os.getloadavg()[0]
    partial = bool(options.only or options.programs)
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(options, scratch)
        if options.find:
            return find_errors(bench, names)
        for part in options.parts:
            measure, rows = PARTS[part][0], []
            for name in names:
                raster = make_raw(name, scratch, options.bin) if name in PART_RASTERS[part] else None
                for error in ERRORS[name] if raster else ():
                    for row in measure(bench, name, raster, error):
                        rows.append(row)
                        print(part, *row.values(), sep=",", flush=True)
            if options.keep or not partial:
                keep(part, rows, complete=not partial)
        if options.keep or not partial:
            describe_machine(options, bench, load, partial)
            report.write()
    return None


if __name__ == "__main__":
    sys.exit(main())
