#!/usr/bin/env python3
"""Is HEAD slower or larger than BASE? Builds both, times both in interleaved rounds on the same rasters, and reports.

  guard.py BASE [HEAD]       two commits; HEAD is by default the last commit checked out
  guard.py --bins A B        two folders of built programs

Compares the triangulation's CPU time from speed_scarp (or instructions of the whole process if `perf` can count them),
least of the rounds, and the peak memory of the process. A case fails if a number grew by more than a ratio and by more
than an amount: either alone is noise or trivial. Failures are measured again before they count. If a commit lacks
speed_scarp, both are timed by `scarp simplify --report` (seconds of refinement, wall clock). Unknown options of a
program are omitted and reported. Exit code: 0 well, 1 a case failed, 2 no comparison.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(PROJECT / "bench" / "speed"))
from rasters import ERRORS, RASTERS, make_raw  # noqa: E402

DEFAULT_RASTERS = ("fuji", "essen_dom", "sierra_3601")


@dataclass(frozen=True)
class Threshold:
    """Limits of growth: a number fails beyond both."""
    ratio: float
    amount: float

    def fails(self, base, head):
        return head > base * self.ratio and head - base > self.amount


@dataclass(frozen=True)
class Limits:
    seconds: Threshold
    megabytes: Threshold
    instructions: Threshold


def least(runs, key):
    found = [run[key] for run in runs if run.get(key) is not None]
    return min(found) if found else None


def judge(base, head, limits):
    """Rows (what, base, head, fails) of one case from the runs of both sides; with instructions, time does not
    count."""
    rows = []
    counted = least(base, "instructions") is not None and least(head, "instructions") is not None
    for what in ("instructions", "seconds", "megabytes"):
        ours, theirs = least(base, what), least(head, what)
        if ours is None or theirs is None:
            continue
        decides = what != "seconds" or not counted
        rows.append((what, ours, theirs, decides and getattr(limits, what).fails(ours, theirs)))
    return rows


def run_child(command):
    """(output, peak megabytes), or None on failure. Peaks below this interpreter's are hidden: a child starts as its
    image."""
    with tempfile.TemporaryFile("w+") as output, open(os.devnull, "w") as nowhere:
        child = subprocess.Popen([str(part) for part in command], stdout=output, stderr=nowhere)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        return (output.read(), usage.ru_maxrss / 1024) if child.returncode == 0 else None


def count_instructions(command, scratch):
    """Instructions of one run in user mode, or None if they cannot be counted."""
    if shutil.which("perf") is None:
        return None
    counts = scratch / "counts"
    if run_child(["perf", "stat", "-x,", "-e", "instructions:u", "-o", counts, "--", *command]) is None:
        return None
    for line in counts.read_text().splitlines():
        fields = line.split(",")
        if len(fields) > 2 and "instructions" in fields[2] and fields[0].isdigit():
            return int(fields[0])
    return None


class NoComparison(Exception):
    """The reason why a comparison is impossible."""


class Side:
    """One of the two builds."""

    def __init__(self, name, folder, scratch):
        self.name, self.folder, self.scratch = name, Path(folder).resolve(), scratch
        self.dropped = []

    def has_bench(self):
        return (self.folder / "speed_scarp").exists()

    def drop_unknown(self, raster, error, options):
        """Removes the options, pairs of name and value, that the program does not know."""
        self.options = []
        for option in options:
            known = run_child([self.folder / "speed_scarp", *raster, error, *option]) is not None
            (self.options if known else self.dropped).append(option)

    def run_bench(self, raster, error):
        command = [self.folder / "speed_scarp", *raster, error, *(part for option in self.options for part in option)]
        done = run_child(command)
        if done is None:
            raise NoComparison(f"{self.name}: {' '.join(map(str, command))} failed")
        report = json.loads(done[0])
        return {"seconds": report["cpu_seconds"], "megabytes": done[1],
                "instructions": count_instructions(command, self.scratch)}

    def run_program(self, tif, error):
        report = self.scratch / "report.json"
        command = [self.folder / "scarp", "simplify", tif, self.scratch / "mesh.ply", "-e", error, "--report", report,
                   "-q", "--overwrite"]
        done = run_child(command)
        if done is None:
            raise NoComparison(f"{self.name}: {' '.join(map(str, command))} failed")
        seconds = json.loads(report.read_text())["seconds"]["refine"]
        return {"seconds": seconds, "megabytes": done[1], "instructions": None}


def measure_case(sides, run, rounds):
    """Interleaved runs of both sides, which alternate in beginning a round."""
    runs = {side.name: [] for side in sides}
    for number in range(rounds):
        for side in sides if number % 2 == 0 else sides[::-1]:
            runs[side.name].append(run(side))
    return [runs[side.name] for side in sides]


def compare(sides, cases, rounds, limits):
    """Prints the table; returns whether any case fails. `cases`: (title, function of a side)."""
    failed = False
    print("| case | what | base | head | head ÷ base | verdict |\n|---|---|---|---|---|---|")
    for title, run in cases:
        base, head = measure_case(sides, run, rounds)
        rows = judge(base, head, limits)
        if any(row[3] for row in rows):
            more = measure_case(sides, run, 2 * rounds)
            rows = judge(base + more[0], head + more[1], limits)
        for what, ours, theirs, fails in rows:
            quotient = theirs / ours if ours else 1
            print(f"| {title} | {what} | {ours:.6g} | {theirs:.6g} | {quotient:.3f} | {'FAILS' if fails else 'ok'} |",
                  flush=True)
            failed = failed or fails
    return failed


def find_commit(name):
    """The commit's hash; a branch means its present commit."""
    found = subprocess.run(["git", "-C", PROJECT, "rev-parse", "--verify", "--quiet", f"{name}^{{commit}}"],
                           capture_output=True, text=True)
    if found.returncode != 0:
        raise NoComparison(f"{name} is no commit of {PROJECT}")
    return found.stdout.strip()


def has_target(made, target):
    listed = subprocess.run(["cmake", "--build", made, "--target", "help"], capture_output=True, text=True)
    return any(target in re.split(r"[\s:]+", line) for line in listed.stdout.splitlines())


def build(commit, folder, jobs):
    """Builds the programs of a commit in a separate worktree; returns their folder."""
    subprocess.run(["git", "-C", PROJECT, "worktree", "add", "-q", "--detach", folder, commit], check=True)
    launcher = [] if "CMAKE_CXX_COMPILER_LAUNCHER" in os.environ or shutil.which("ccache") is None else [
        "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"]
    generator = [] if "CMAKE_GENERATOR" in os.environ or shutil.which("ninja") is None else ["-G", "Ninja"]
    made = folder / "build"
    run_step(commit, ["cmake", "-S", folder, "-B", made, "-DCMAKE_BUILD_TYPE=Release", "-DSCARP_BUILD_BENCH=ON",
                      "-DSCARP_BUILD_TESTS=OFF", *generator, *launcher])
    for target in ("speed_scarp", "scarp_program"):
        if has_target(made, target):
            run_step(commit, ["cmake", "--build", made, "-j", str(jobs), "--target", target])
        else:
            print(f"{commit} has no {target}", file=sys.stderr)
    return made / "bin"


def run_step(commit, command):
    """Prints the output only on failure."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.stderr.write(done.stdout[-4000:])
        raise NoComparison(f"{commit} cannot be built: {' '.join(map(str, command))}")


def bench_cases(options, sides, scratch):
    """Cases for speed_scarp on raw rasters, or for the program on GeoTIFF if one side lacks speed_scarp."""
    both = all(side.has_bench() for side in sides)
    if not both:
        print("timed by scarp simplify --report, since one side has no speed_scarp: wall clock")
    for name in options.rasters:
        raster = make_raw(name, scratch, sides[1].folder)
        if raster is None:
            continue
        for error in ERRORS[name]:
            if both:
                if not hasattr(sides[0], "options"):
                    for side in sides:
                        side.drop_unknown(raster, error, [("--order", options.order)] if options.order else [])
                        for option in side.dropped:
                            print(f"{side.name} does not know {' '.join(option)}: run without")
                yield f"{name}, {error:g}", lambda side, e=error, r=raster: side.run_bench(r, e)
            else:
                yield f"{name}, {error:g}", lambda side, e=error, r=raster: side.run_program(r[0], e)


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("commits", nargs="*", metavar="COMMIT", help="BASE, and HEAD if it is not the one at hand")
    parser.add_argument("--bins", nargs=2, type=Path, metavar=("BASE", "HEAD"), help="compare built programs")
    parser.add_argument("--rasters", nargs="+", choices=RASTERS, default=DEFAULT_RASTERS)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once, all processors if left out")
    parser.add_argument("--order", choices=("dominant", "greedy"), help="instead of each side's default")
    parser.add_argument("--time-ratio", type=float, default=1.05)
    parser.add_argument("--time-ms", type=float, default=5)
    parser.add_argument("--memory-ratio", type=float, default=1.05)
    parser.add_argument("--memory-mb", type=float, default=2)
    options = parser.parse_args(arguments)
    if bool(options.bins) == bool(options.commits) or len(options.commits) > 2:
        parser.error("give BASE [HEAD], or --bins BASE HEAD")
    return options


def limits_of(options):
    """Five million instructions are about a millisecond, the amount for time."""
    return Limits(Threshold(options.time_ratio, options.time_ms / 1e3),
                  Threshold(options.memory_ratio, options.memory_mb),
                  Threshold(options.time_ratio, options.time_ms * 5e6))


def main(arguments=None):
    try:
        return guard(parse(arguments))
    except (NoComparison, OSError, subprocess.CalledProcessError) as reason:
        print(f"guard: {reason}", file=sys.stderr)
        return 2


def guard(options):
    worktrees = []
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        try:
            if options.bins:
                folders = options.bins
            else:
                folders = []
                commits = [find_commit(name) for name in (*options.commits, "HEAD")[:2]]
                for name, commit in zip(("base", "head"), commits):
                    worktrees.append(scratch / name)
                    folders.append(build(commit, scratch / name, options.jobs))
            sides = [Side(name, path, scratch) for name, path in zip(("base", "head"), folders)]
            if not all(side.has_bench() or (side.folder / "scarp").exists() for side in sides):
                raise NoComparison("a side has neither speed_scarp nor scarp")
            cases = list(bench_cases(options, sides, scratch))
            if not cases:
                raise NoComparison("none of the rasters is there")
            failed = compare(sides, cases, options.rounds, limits_of(options))
        finally:
            for tree in worktrees:
                subprocess.run(["git", "-C", PROJECT, "worktree", "remove", "--force", tree], check=False)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
