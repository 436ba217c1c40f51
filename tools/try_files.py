#!/usr/bin/env python3
"""Runs `info`, `simplify` and `measure` on every file of a folder of foreign files, and reports failures.

    tools/try_files.py PROGRAM FOLDER [--jobs N] [--timeout SECONDS] [--error E]

A refusal is no fault: exit codes 1 to 3, one sentence on stderr, nothing written. Faults are signals, time-outs, exit
codes 4 and above, more than one sentence, files left in the output folder or next to inputs, and commands that
disagree. Commands disagree if info reads what simplify does not, or measure finds a broken bound. Exit 1 if there is
any.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

COMMANDS = ("info", "simplify", "measure")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--timeout", type=float, default=120, help="seconds a run may take (120)")
    parser.add_argument("--error", default="1%", help="what simplify is asked for (1%%)")
    return parser.parse_args(words)


def run(command, timeout):
    """Exit code, 'time-out' or the name of a signal; and the lines on stderr except warnings."""
    try:
        done = subprocess.run(command, timeout=timeout, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE)
    except subprocess.TimeoutExpired:
        return "time-out", []
    lines = [line for line in done.stderr.decode(errors="replace").splitlines()
             if not line.startswith("scarp: warning: ")]
    return (done.returncode if done.returncode >= 0 else signal.Signals(-done.returncode).name), lines


def try_file(path, options):
    """{command: exit state} and a list of faults."""
    ends, faults = {}, []
    with tempfile.TemporaryDirectory() as scratch:
        mesh, report = os.path.join(scratch, "mesh.glb"), os.path.join(scratch, "report.json")

        def go(command, *words):
            end, lines = run([options.program, command, str(path), *words], options.timeout)
            ends[command] = end
            if isinstance(end, str):
                faults.append(f"{command}: {end}")
            elif end >= 4:
                faults.append(f"{command}: exit code {end}: {' | '.join(lines)}")
            elif end > 0 and len(lines) != 1:
                faults.append(f"{command}: {len(lines)} lines instead of one sentence")
            return end

        reads = go("info")
        made = go("simplify", mesh, "-e", options.error, "--report", report, "-j", "1")
        left = sorted(os.listdir(scratch))
        if left != (["mesh.glb", "report.json"] if made == 0 else []):
            faults.append(f"simplify: leaves {', '.join(left) or 'nothing'}")
        if made == 0:
            bound = json.load(open(report, encoding="utf-8"))["goal"]["max_error"]
            if go("measure", mesh, "--fail-above", repr(bound), "-j", "1") != 0:
                faults.append("measure: does not confirm the mesh")
        if (reads, made) in ((0, 2), (2, 0)):
            faults.append("info and simplify disagree")
    return ends, faults


def list_files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file())


def print_table(ends):
    print(f"| command | {' | '.join(COMMANDS)} |\n|---|{'---:|' * len(COMMANDS)}")
    for end in sorted({end for each in ends.values() for end in each}, key=str):
        label = f"exit code {end}" if isinstance(end, int) else end
        print(f"| {label} | {' | '.join(str(ends[command][end]) for command in COMMANDS)} |")


def main(words):
    options = parse(words)
    options.program = shutil.which(options.program) or options.program
    before = list_files(options.folder)
    if not before:
        sys.exit(f"try_files: {options.folder} holds no file")
    ends, faults = collections.defaultdict(collections.Counter), []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for path, (of_file, found) in zip(before, pool.map(lambda path: try_file(path, options), before)):
            for command, end in of_file.items():
                ends[command][end] += 1
            faults += [f"{path}: {fault}" for fault in found]
    faults += [f"{path}: appeared beside the inputs" for path in sorted(set(list_files(options.folder)) - set(before))]
    print_table(ends)
    print(f"\n{len(before)} files, {len(faults)} faults" + "".join(f"\n  {fault}" for fault in faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
