#!/usr/bin/env python3
"""Prints what the demonstration made, for someone who sees Scarp for the first time.

usage: demo_table.py REPORT MEASURED FILE...    REPORT of simplify, MEASURED by measure on the file that was written
"""

import json
import os
import sys

KINDS = {
    ".glb": "3-D model for Blender, browsers and game engines",
    ".obj": "the same for any 3-D program",
    ".png": "picture: the hills, shaded, with the mesh over them",
    ".json": "all the numbers",
}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        report = json.load(file)
    with open(sys.argv[2], encoding="utf-8") as file:
        measured = json.load(file)
    full = report["full_triangles"]
    source = report["input"]
    unit = source["unit"] or "m"
    seconds = report["seconds"]
    rows = [
        ("heights given", f"{source['valid']:,} samples ({source['cols']} x {source['rows']}), "
                          f"{source['min']:g} to {source['max']:g} {unit}"),
        ("triangles", f"{report['triangles']:,} in place of {full:,}: {100 * report['triangles'] / full:.2f} %"),
        ("max error asked", f"{report['goal']['max_error']:g} {unit}: no sample may be farther from the mesh"),
        ("max error proven", f"{measured['max_error']:.4g} {unit}, by reading the file back and judging all "
                             f"{measured['samples']:,} samples"),
        ("RMSE", f"{measured['rmse']:.3g} {unit} (half of the samples within {measured['p50']:.3g} {unit})"),
        ("time", f"{seconds['total']:.2f} s: read {seconds['read']:.2f}, refine {seconds['refine']:.2f}, "
                 f"prove {seconds['measure']:.2f}, write {seconds['write']:.2f}"),
    ]
    print()
    for name, value in rows:
        print(f"  {name:<18}{value}")
    print("\n  Open:")
    for path in sys.argv[3:]:
        size = os.path.getsize(path)
        print(f"  {path:<22}{size / 1000:>8,.0f} kB  {KINDS[os.path.splitext(path)[1]]}")


if __name__ == "__main__":
    main()
