#!/usr/bin/env python3
"""Times the reading of LAZ against laz-perf, and of LAS, on one thread, and writes bench/speed/las.csv.

usage: bench/speed/las.py --bin BUILD/bin [FOLDER]      FOLDER: LAS and LAZ files (../shared/data/las)

Both read the file from memory, point by point in the order of the file, and must come to the same points. laz-perf is
WebAssembly, in node: `npm ci` in bench.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
SHARED = pathlib.Path(os.environ.get("SCARP_SHARED", HERE.parent.parent.parent / "shared"))


def run(*command):
    return json.loads(subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=SHARED / "data" / "las")
    arguments = parser.parse_args()
    rows = []
    for path in sorted(arguments.folder.glob("*.la[sz]")):
        ours = run(arguments.bin / "speed_las", path)
        if ours["points"] < 10_000:
            continue
        peer = run("node", HERE / "speed_laz_perf.mjs", path) if path.suffix == ".laz" else None
        if peer and any(peer[key] != ours[key] for key in ("points", "hash", "ground")):
            raise SystemExit(f"{path}: laz-perf reads other points: {peer}, {ours}")
        each = lambda seconds: f"{1e9 * seconds / ours['points']:.1f}"
        rows.append([path.name, ours["points"], ours["bytes"], each(ours["seconds"]), each(peer["seconds"]) if peer else "",
                     f"{ours['seconds'] / peer['seconds']:.2f}" if peer else ""])
        print(*rows[-1], flush=True)
    with open(HERE / "las.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["file", "points", "bytes", "nanoseconds", "laz_perf_nanoseconds", "ratio"])
        table.writerows(rows)


if __name__ == "__main__":
    main()
