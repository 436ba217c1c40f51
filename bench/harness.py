"""Common parts of all benchmarks in Python: running programs, tables, and pages with tables between `<!-- table: NAME
-->` and `<!-- end -->`."""

import argparse
import csv
import json
import os
import re
import resource
import subprocess
import time
from pathlib import Path

BENCH = Path(__file__).resolve().parent
PROJECT = BENCH.parent


def arguments_of(description):
    """A parser with the common option."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the built programs")
    return parser


def call(command, **environment):
    """The output of a program, one JSON object per line."""
    done = subprocess.run([str(part) for part in command], check=True, stdout=subprocess.PIPE, text=True,
                          env={**os.environ, **environment})
    return [json.loads(line) for line in done.stdout.splitlines()]


def report_of(command, **environment):
    """The last object that a program prints."""
    return call(command, **environment)[-1]


def measure_process(command):
    """Seconds of a child process and its peak resident bytes; it must succeed."""
    start = time.perf_counter()
    child = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.perf_counter() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} ended with {child.returncode}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak": 1024 * usage.ru_maxrss}


def seconds_of_children():
    """CPU time of all children that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def interleave(runs, rounds, once=()):
    """Results of each run, by name, in rounds that begin with different runs. `runs` maps names to functions of "is
    this the last round". Those in `once` run only in the last."""
    results, names = {name: [] for name in runs}, list(runs)
    for number in range(rounds):
        last, turn = number == rounds - 1, number % len(names)
        for name in names[turn:] + names[:turn]:
            if last or name not in once:
                results[name].append(runs[name](last))
    return results


def install(package):
    """Installs the peers for node in the versions of package.json, which depend on no other package."""
    if not (BENCH / "node_modules" / package).is_dir():
        subprocess.run(["npm", "install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=BENCH, check=True)


def read_table(path):
    """Rows as dictionaries; none without a file."""
    if not path.exists():
        return []
    with open(path, newline="") as stream:
        return list(csv.DictReader(stream))


def write_table(path, rows):
    with open(path, "w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def keep_rows(path, new, keys, place):
    """Replaces old rows with the same keys by new ones, sorted by `place`; drops old ones with other columns."""
    old = read_table(path)
    if old and new and list(old[0]) != list(new[0]):
        old = []
    merged = {tuple(str(row[name]) for name in keys): row for row in [*old, *new]}
    if merged:
        write_table(path, sorted(merged.values(), key=place))


def markdown(header, rows):
    """Lines of a table."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def fill(text, found):
    """Fills in every table of the text; those without contents do not change."""
    def one(match):
        name = match.group(1)
        if name not in found:
            return match.group(0)
        return f"<!-- table: {name} -->\n" + "\n".join(found[name]) + "\n<!-- end -->"

    return re.sub(r"<!-- table: (\w+) -->\n.*?<!-- end -->", one, text, flags=re.DOTALL)
