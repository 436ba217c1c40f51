#!/usr/bin/env python3
"""Prints the CPU seconds of each stage and script of the last `make test`, the dearest first.

usage: tools/test_times.py [BUILD] [--rest] [--most SECONDS]

BUILD is the build folder (build). Without --rest: the stages of `make test`; with it, what `make test-full` adds. With
--most the exit code is 1 where the sum is larger, so that the growth of the tests is seen.
"""
import argparse
import pathlib
import subprocess
import sys


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
    if arguments.most is not None and total > arguments.most:
        sys.exit(f"make test took {total:.0f} CPU seconds, more than {arguments.most:.0f}: make its dearest tests smaller")


main()
