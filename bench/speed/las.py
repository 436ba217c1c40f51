#!/usr/bin/env python3
"""Times the reading of LAZ against laz-perf, and of LAS, on one thread, and writes bench/speed/las.csv.

usage: bench/speed/las.py --bin BUILD/bin [FOLDER]      FOLDER: LAS and LAZ files (../shared/data/las)

Both read the file from memory and must come to the same points; times are CPU time, nanoseconds a point. laz-perf is
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
    """The line that the program prints; nothing if it fails: laz-perf does not read files without chunks."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=SHARED / "data" / "las")
    arguments = parser.parse_args()
    rows = []
    for path in sorted(arguments.folder.glob("*.la[sz]")):
        ours = run(arguments.bin / "speed_las", path)
        if ours is None or ours["points"] < 10_000:
            continue
        peer = run("node", HERE / "speed_laz_perf.mjs", path) if path.suffix == ".laz" else None
        if peer and any(peer[key] != ours[key] for key in ("points", "hash", "ground")):
            raise SystemExit(f"{path}: laz-perf reads other points: {peer}, {ours}")
        seconds = [reader["cpu_seconds"] for reader in (ours, peer) if reader]
        nanoseconds = [f"{1e9 * each / ours['points']:.1f}" for each in seconds]
        ratio = f"{seconds[0] / seconds[1]:.2f}" if peer else ""
        rows.append([path.name, ours["points"], ours["bytes"], nanoseconds[0], nanoseconds[1] if peer else "", ratio])
        print(*rows[-1], flush=True)
    with open(HERE / "las.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["file", "points", "bytes", "nanoseconds", "laz_perf_nanoseconds", "ratio"])
        table.writerows(rows)


if __name__ == "__main__":
    main()
