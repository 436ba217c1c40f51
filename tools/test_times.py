#!/usr/bin/env python3
"""Prints the CPU seconds of each stage and script of the last `make test`, the longest first.

usage: tools/test_times.py [BUILD] [--rest] [--most SECONDS | --gauge]

BUILD is the build folder (build). Without --rest: the stages of `make test`; with it, what `make test-full` adds. With
--most the exit code is 1 if the sum is larger, to detect growth of the tests. SECONDS apply to a machine where a
compilation on every core at once needs REFERENCE CPU seconds; on slower or shared cores the limit grows in proportion.
--gauge compiles, and notes the seconds in BUILD/gauge: shared cores change their speed during a run, so the limit is
for the mean of the notes and of a last compilation.
"""
import argparse
import multiprocessing
import os
import pathlib
import resource
import subprocess
import sys

# A build of commit 0057573 needs 471 CPU seconds on the machine of REFERENCE. On another machine it needed 983, 2.09
# times as many, and this compilation 4.5 before and 6.2 after: their mean, divided by 2.09.
REFERENCE = 2.56
SOURCE = "#include <algorithm>\n#include <iostream>\n#include <map>\n#include <regex>\nint main() { return std::regex_match(\"\", std::regex(\"a\")); }\n"


def compile_once(_):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(["c++", "-std=c++20", "-O2", "-x", "c++", "-c", "-", "-o", "/dev/null"], input=SOURCE, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def gauge(notes):
    """Adds the CPU seconds of a compilation on all cores at once to the file `notes`."""
    cores = os.cpu_count() or 2
    with multiprocessing.Pool(cores) as pool:
        taken = sorted(pool.map(compile_once, range(3 * cores), chunksize=1))
    with open(notes, "a", encoding="utf-8") as file:
        file.write(f"{taken[len(taken) // 2]:.3f}\n")


def slowness(notes):
    """The factor, at least 1, by which compilations are slower than on the machine of REFERENCE."""
    taken = [float(line) for line in notes.read_text().split()]
    print(f"{' '.join(f'{seconds:.1f}' for seconds in taken)}: CPU seconds of a compilation during the run; {REFERENCE} is the reference")
    return max(1.0, sum(taken) / len(taken) / REFERENCE)


def scripts_of_rest(build):
    """The names of the tests with label rest."""
    listed = subprocess.run(["ctest", "--test-dir", build, "-N", "-L", "rest"], capture_output=True, text=True).stdout
    return {line.split()[-1] for line in listed.splitlines() if line.strip().startswith("Test ")}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", nargs="?", default="build")
    parser.add_argument("--rest", action="store_true")
    parser.add_argument("--most", type=float)
    parser.add_argument("--gauge", action="store_true")
    arguments = parser.parse_args()
    notes = pathlib.Path(arguments.build, "gauge")
    if arguments.gauge:
        return gauge(notes)
    rest = scripts_of_rest(arguments.build)
    seconds = {file.name: float(file.read_text()) for file in pathlib.Path(arguments.build, "times").glob("*")}
    if not seconds:
        sys.exit(f"{arguments.build}/times is empty: make test fills it")
    chosen = {name: taken for name, taken in seconds.items() if (name in rest or name.startswith("rest_")) == arguments.rest}
    for name, taken in sorted(chosen.items(), key=lambda row: -row[1]):
        print(f"{taken:8.1f} {name}")
    total = sum(chosen.values())
    print(f"{total:8.1f} CPU seconds in all")
    if arguments.most is not None:
        gauge(notes)
        most = arguments.most * slowness(notes)
        print(f"{most:8.1f} are the most that this machine may take")
        if total > most:
            sys.exit(f"make test took {total:.0f} CPU seconds, more than {most:.0f}: make its dearest tests smaller")


main()
