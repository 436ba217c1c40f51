#!/usr/bin/env python3
"""Prints the CPU seconds of each stage and script of the last `make test`, the longest first.

usage: tools/test_times.py [BUILD] [--rest] [--most SECONDS]

BUILD is the build folder (build). Without --rest: the stages of `make test`; with it, what `make test-full` adds. With
--most the exit code is 1 if the sum is larger, to detect growth of the tests. SECONDS apply to a machine where a
compilation on every core at once needs REFERENCE CPU seconds; on slower or shared cores the limit grows in proportion.
"""
import argparse
import multiprocessing
import os
import pathlib
import resource
import subprocess
import sys

REFERENCE = 2.9
SOURCE = "#include <algorithm>\n#include <iostream>\n#include <map>\n#include <regex>\nint main() { return std::regex_match(\"\", std::regex(\"a\")); }\n"


def compile_once(_):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(["c++", "-std=c++20", "-O2", "-x", "c++", "-c", "-", "-o", "/dev/null"], input=SOURCE, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def slowness():
    """The factor, at least 1, by which a compilation on all cores at once is slower than on the machine of
    REFERENCE."""
    cores = os.cpu_count() or 2
    with multiprocessing.Pool(cores) as pool:
        taken = sorted(pool.map(compile_once, range(3 * cores), chunksize=1))
    return max(1.0, taken[len(taken) // 2] / REFERENCE)


def scripts_of_rest(build):
    """The names of the tests with label rest."""
    listed = subprocess.run(["ctest", "--test-dir", build, "-N", "-L", "rest"], capture_output=True, text=True).stdout
    return {line.split()[-1] for line in listed.splitlines() if line.strip().startswith("Test ")}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", nargs="?", default="build")
    parser.add_argument("--rest", action="store_true")
    parser.add_argument("--most", type=float)
    arguments = parser.parse_args()
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
        most = arguments.most * slowness()
        print(f"{most:8.1f} are the most that this machine may take")
        if total > most:
            sys.exit(f"make test took {total:.0f} CPU seconds, more than {most:.0f}: make its dearest tests smaller")


main()
