#!/usr/bin/env python3
"""Measures Scarp's speed goals as ratios; updates goals.csv next to this file.

The engine's goals are multiples of a peer's time. The peer is any program with the arguments of speed_scarp, RASTER
COLS ROWS ERROR, that triangulates on one thread and prints "cpu_seconds" in JSON; by default delatin. Ratios are of CPU
time (least of interleaved rounds), except "2 threads": wall clock, which is meaningless on a busy machine.

  goals.py --bin build/bin [--peer PROGRAM --peer-name hmm] [--only GOAL...] [--rounds N]
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from programs import make_tif
from rasters import ERRORS, HERE, RASTERS, find_file, make_raw

sys.path.insert(0, str(HERE.parent))
from harness import arguments_of, install, interleave, measure_process, read_table, report_of, write_table  # noqa: E402

TABLE = HERE / "goals.csv"
LARGE, SMALL = ("sierra_3601", "moon_4096", "fractal_4096"), ("fuji", "essen_dom")


class Measure:
    def __init__(self, options, scratch):
        self.bin, self.rounds, self.scratch, self.options = options.bin, options.rounds, Path(scratch), options

    def raw(self, name):
        return make_raw(name, self.scratch, self.bin)

    def least(self, commands, run, rounds=None):
        """The least of the rounds of run(command), by name; rounds are interleaved."""
        runs = {name: lambda _, one=command: run(one) for name, command in commands.items()}
        return {name: min(values) for name, values in interleave(runs, rounds or self.rounds).items()}

    def peer(self, raster, error):
        if self.options.peer:
            return [self.options.peer, *raster, error]
        install("delatin")
        return ["node", HERE / "speed_delatin.mjs", *raster, error]

    def simplify(self, source, error, *more):
        return [self.bin / "scarp", "simplify", source, self.scratch / "goal.glb", "-e", error, "-q", "--overwrite", *more]


def cpu(command):
    return report_of(command)["cpu_seconds"]


def of_program(command):
    return measure_process(command)["cpu"]


def engine(bench):
    """Peer ÷ Scarp, triangulation, one thread."""
    for name in (*LARGE, *SMALL):
        raster = bench.raw(name)
        for error in ERRORS[name] if raster else ():
            times = bench.least({"peer": bench.peer(raster, error), "fast": [bench.bin / "speed_scarp", *raster, error]},
                                cpu)
            yield f"{name} {error}", times["peer"] / times["fast"], f"{times['peer']:.4f} ÷ {times['fast']:.4f} s"


def effort(bench, effort, cases):
    for name, errors in cases:
        raster = bench.raw(name)
        for error in errors if raster else ():
            ours = [bench.bin / "speed_small", *raster, "--side", min(raster[1:]), "--error", error, "--effort", effort,
                    "--rounds", 1]
            times = bench.least({"peer": bench.peer(raster, error), effort: ours}, cpu, 1 if effort == "high" else None)
            yield f"{name} {error}", times[effort] / times["peer"], f"{times[effort]:.3f} ÷ {times['peer']:.3f} s"


def normal(bench):
    """simplify(), proof included, ÷ peer's triangulation, one thread."""
    cases = [("sierra_3601", (238, 70.8, 23.6)), ("essen_dom", ERRORS["essen_dom"]), ("fuji", ERRORS["fuji"])]
    return effort(bench, "normal", cases)


def high(bench):
    """Like normal(), for high effort."""
    return effort(bench, "high", [("sierra_3601", (238, 119)), ("essen_dom", (20.6,)), ("fuji", (217,))])


def program(bench):
    """Peer's triangulation alone ÷ Scarp's whole program, fast, one thread; and the cost of options."""
    raster = bench.raw("sierra_3601")
    if raster is None:
        return
    tif, report = make_tif(raster, bench.scratch), bench.scratch / "goal.json"
    degrees = bench.scratch / "degrees.tif"
    window = [str(part) for part in RASTERS["sierra_3601"][1]]
    subprocess.run(["gdal_translate", "-q", "-srcwin", *window, find_file(RASTERS["sierra_3601"][0]), degrees], check=True)
    for error in (238, 23.6):
        fast = bench.simplify(tif, error, "--effort", "fast", "-j", 1)
        here = bench.simplify(degrees, error, "--effort", "fast", "-j", 1)
        times = bench.least({"fast": fast, "report": [*fast, "--report", report],
                             "local": [*here, "--crs", "local"], "source": [*here, "--crs", "source"]}, of_program)
        times["peer"] = bench.least({"peer": bench.peer(raster, error)}, cpu)["peer"]
        yield f"peer ÷ program {error}", times["peer"] / times["fast"], f"{times['peer']:.3f} ÷ {times['fast']:.3f} s"
        yield f"--report adds {error}", times["report"] / times["fast"] - 1, f"{times['report']:.3f} s"
        yield (f"--crs source ÷ local {error}", times["source"] / times["local"],
               f"{times['source']:.3f} ÷ {times['local']:.3f} s")


def threads(bench):
    """Wall clock of the program on one thread ÷ two."""
    raster = bench.raw("sierra_3601")
    for error in (238, 23.6) if raster else ():
        commands = {j: bench.simplify(make_tif(raster, bench.scratch), error, "--effort", "fast", "-j", j) for j in (1, 2)}
        times = bench.least(commands, lambda command: measure_process(command)["wall"])
        yield f"sierra_3601 {error}", times[1] / times[2], f"{times[1]:.3f} ÷ {times[2]:.3f} s"


def calls(bench):
    """First call of a process ÷ later ones."""
    for name in ("fuji", "essen_dom", "sierra_3601"):
        raster = bench.raw(name)
        for error in ERRORS[name] if raster else ():
            command = [bench.bin / "speed_scarp", *raster, error, "--repeat", 6 if name == "sierra_3601" else 30]
            first = later = float("inf")
            for _ in range(bench.rounds):
                done = report_of(command)
                first, later = min(first, done["first"]["cpu_seconds"]), min(later, done["cpu_seconds"])
            yield f"{name} {error}", first / later, f"{1e3 * first:.2f} ÷ {1e3 * later:.2f} ms"


def proof(bench):
    """Proof of a finished mesh, heights, ÷ one vector scan of its triangles, buffers filled."""
    for name in ("sierra_3601", "essen_dom", "fuji"):
        raster = bench.raw(name)
        for error in ERRORS[name] if raster else ():
            judge = cpu([bench.bin / "speed_proof", *raster, error, "--threads", 1, "--repeat", 2 * bench.rounds])
            scans = [report_of([bench.bin / "speed_verify", *raster, error]) for _ in range(bench.rounds)]
            scan = min(one["cpu_seconds"] + one["load_seconds"] for one in scans)
            yield f"{name} {error}", judge / scan, f"{1e3 * judge:.3f} ÷ {1e3 * scan:.3f} ms"


def small(bench):
    """Milliseconds of simplify(), proof included, a window of 64 × 64, normal effort, median of the windows."""
    for name in ("sierra_3601", "essen_dom", "fuji"):
        raster = bench.raw(name)
        if raster is None:
            continue
        budget = report_of([bench.bin / "speed_small", *raster, "--triangles", 200])
        yield f"{name} 200 triangles", budget["milliseconds"], f"dearest {budget['dearest']:.2f} ms"
        error = report_of([bench.bin / "speed_small", *raster, "--error", f"{budget['mean_error']:.4g}"])
        yield (f"{name} their mean error", error["milliseconds"],
               f"{error['triangles'] / error['windows']:.0f} triangles a window")


GOALS = {one.__name__: one for one in (engine, normal, high, program, threads, calls, proof, small)}


def main():
    parser = arguments_of(__doc__)
    parser.add_argument("--peer", type=Path, help="the program to compare with")
    parser.add_argument("--peer-name", default="delatin")
    parser.add_argument("--only", nargs="+", choices=GOALS, default=list(GOALS))
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    kept = [row for row in read_table(TABLE) if row["goal"] not in options.only]
    with tempfile.TemporaryDirectory() as scratch:
        bench = Measure(options, scratch)
        for goal in options.only:
            for case, value, how in GOALS[goal](bench):
                peer = options.peer_name if goal in ("engine", "normal", "high", "program") else ""
                kept.append({"goal": goal, "case": case, "value": f"{value:.3f}", "how": how, "peer": peer})
                print(*kept[-1].values(), sep=",", flush=True)
    order = list(GOALS)
    write_table(TABLE, sorted(kept, key=lambda row: order.index(row["goal"])))


if __name__ == "__main__":
    main()
