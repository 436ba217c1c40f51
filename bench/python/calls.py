#!/usr/bin/env python3
"""The cost of a call of scarp.simplify() beyond the library's own time, and that of `import scarp`.

    PYTHONPATH=bindings/python/src SCARP_LIBRARY=build/bindings/python/libscarp_c.so python3 bench/python/calls.py
        [--side N] [--rounds N] [--in-a-row N] [--imports N] [--csv FILE]

Without the two variables the installed scarp is measured.

Calls: N x N samples (33: 54 triangles), on one thread. All kinds alternate with some calls (20) in a row, so that a
busy machine affects all alike and caches are as warm as in a loop. Each figure is the median over the rounds (3000) of
the call's time until its mesh is freed, minus the time of simplify() in its report, in microseconds. "C" is
scarp_simplify() and scarp_mesh_free() by ctypes with prepared structs: the cost of the C interface (options, plan,
reading, metadata). "python" is the cost beyond "C".

Imports: alternating fresh processes (20 of each); the median processor time in milliseconds, minus that of a process
without imports.
"""
import argparse
import csv
import ctypes
import itertools
import pathlib
import statistics
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from harness import seconds_of_children  # noqa: E402


def find_calls(side):
    """By name: functions that make a mesh, read the library's seconds from it, and free it."""
    import numpy as np
    import scarp
    from scarp import _abi
    y, x = np.mgrid[0:side, 0:side]
    z = (40 * np.sin(x / 5) * np.cos(y / 4)).astype(np.float32)
    doubles = z.astype(np.float64)
    lib = _abi.lib
    field, options, report, out = _abi.new_field(), _abi.new_options(), _abi.new_report(), ctypes.c_void_p()
    field.rows, field.cols, field.samples = side, side, z.ctypes.data
    options.max_error, options.threads = 8, 1
    to_field, to_options, to_report, to_out = map(ctypes.byref, (field, options, report, out))

    def by_c():
        lib.scarp_simplify(to_field, to_options, to_out)

    def look():
        mesh = scarp.simplify(z, 8, threads=1)
        return mesh, mesh.vertices, mesh.triangles, mesh.max_error

    def seconds_of_c(_):
        lib.scarp_mesh_report(out, to_report)
        return report.seconds

    errors = (8 + k * 1e-6 for k in itertools.count())
    made = {
        "simplify(z, 8)": lambda: scarp.simplify(z, 8, threads=1),
        "with an error of its own": lambda: scarp.simplify(z, next(errors), threads=1),
        "with effort=": lambda: scarp.simplify(z, 8, threads=1, effort="normal"),
        "with progress=": lambda: scarp.simplify(z, 8, threads=1, progress=bool),
        "of float64": lambda: scarp.simplify(doubles, 8, threads=1),
    }
    calls = {"C": (by_c, seconds_of_c, lambda _: lib.scarp_mesh_free(out))}
    calls.update((name, (call, lambda mesh: mesh.report.seconds, None)) for name, call in made.items())
    calls["and vertices, triangles, max_error"] = look, lambda looked: looked[0].report.seconds, None
    return calls


def time_calls(side, rounds, in_a_row):
    """Microseconds beyond the library's, by name."""
    calls = find_calls(side)
    beyond = {name: [] for name in calls}
    clock = time.perf_counter
    for _ in range(rounds // in_a_row):
        for name, (call, seconds_of, free) in ((name, kind) for name, kind in calls.items() for _ in range(in_a_row)):
            begin = clock()
            made = call()
            end = clock()
            seconds = seconds_of(made)
            again = clock()
            if free is None:
                del made
            else:
                free(made)
            beyond[name].append(1e6 * (clock() - again + end - begin - seconds))
    return {name: statistics.median(values) for name, values in beyond.items()}


def time_imports(rounds):
    """Milliseconds beyond those of a process without imports, by imported module."""
    lines = {"nothing": "pass", "numpy": "import numpy", "scarp": "import scarp", "numpy, scarp": "import numpy, scarp"}
    spent = {name: [] for name in lines}
    for _ in range(rounds):
        for name, line in lines.items():
            before = seconds_of_children()
            subprocess.run([sys.executable, "-c", line], check=True)
            spent[name].append(1e3 * (seconds_of_children() - before))
    nothing = statistics.median(spent.pop("nothing"))
    return {name: statistics.median(values) - nothing for name, values in spent.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=int, default=33)
    parser.add_argument("--rounds", type=int, default=3000)
    parser.add_argument("--in-a-row", type=int, default=20)
    parser.add_argument("--imports", type=int, default=20)
    parser.add_argument("--csv")
    asked = parser.parse_args()
    calls = time_calls(asked.side, asked.rounds, asked.in_a_row)
    rows = [("call", name, "us", "%.1f" % value, "%.1f" % (value - calls["C"])) for name, value in calls.items()]
    rows += [("import", name, "ms", "%.1f" % value, "") for name, value in time_imports(asked.imports).items()]
    for row in rows:
        print("%-6s %-36s %s %7s %7s" % row)
    if asked.csv:
        with open(asked.csv, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([("what", "kind", "unit", "beyond", "python")] + rows)


if __name__ == "__main__":
    main()
