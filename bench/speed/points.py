#!/usr/bin/env python3
"""Times whole runs on points against runs on a raster of as many samples, and writes bench/speed/points.csv.

usage: bench/speed/points.py --bin BUILD/bin [--peer BINARY] [--samples N] [--memory SIZE]     needs numpy

The points lie at random places of a fractal raster, at its bilinear heights, in a LAS file; the goal is 1 % of the
relief, on one thread. `--peer`: an earlier build of the program, in the same rounds.
`--memory`: instead, points in parts within this limit against points in memory, on all threads, one run each, to
bench/speed/points_memory.csv.
"""
import csv
import json
import multiprocessing
import pathlib
import struct
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from harness import arguments_of, call, interleave, measure_process  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROUNDS = 3


def write_las(heights, count, path):
    """LAS 1.2, format 0, in centimetres and millimetres."""
    side = len(heights)
    at = numpy.random.default_rng(1).uniform(0, side - 1.001, (2, count))
    x, y = at.astype(int)
    u, v = at[0] - x, at[1] - y
    z = (heights[y, x] * (1 - u) + heights[y, x + 1] * u) * (1 - v) + (heights[y + 1, x] * (1 - u) + heights[y + 1, x + 1] * u) * v
    records = numpy.zeros(count, [("xyz", "<i4", 3), ("rest", "u1", 8)])
    places = numpy.stack([at[0] * 1000, at[1] * 1000, z * 1000]).round().astype("i4")
    records["xyz"] = places.T
    head = bytearray(227)
    head[:4], head[24:26] = b"LASF", bytes([1, 2])
    struct.pack_into("<HII", head, 94, 227, 227, 0)
    struct.pack_into("<BHI", head, 104, 0, 20, count)
    scales = (0.01, 0.01, 0.001)
    struct.pack_into("<3d", head, 131, *scales)
    struct.pack_into("<6d", head, 179, *(scale * end for scale, axis in zip(scales, places) for end in (axis.max(), axis.min())))
    path.write_bytes(bytes(head) + records.tobytes())


def make_inputs(program, side, raster, points):
    call([program, "generate", "fractal", side, side, raster, "--range", 60000, "-q"])
    _, heights = raster.read_bytes().split(b"65535\n", 1)
    heights = numpy.frombuffer(heights, ">u2").reshape(side, side) / 10
    write_las(heights, side * side, points)


def compare_parts(program, points, limit, folder):
    with open(HERE / "points_memory.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["points", "effort", "memory", "triangles", "wall_s", "cpu_s", "peak_MB"])
        for effort in ("fast", "normal"):
            for memory in ("", limit):
                report = folder / "report.json"
                command = [program, "simplify", points, folder / "out.ply", "-e", "1%", "--effort", effort, "--report", report, "-q",
                           "--overwrite"] + (["--memory", memory] if memory else [])
                run, made = measure_process(command), json.loads(report.read_text())
                table.writerow([made["input"]["points"], effort, memory or "no limit", made["triangles"], f"{run['wall']:.0f}",
                                f"{run['cpu']:.0f}", f"{run['peak'] / 1e6:.0f}"])
    print((HERE / "points_memory.csv").read_text(), end="")


def main():
    parser = arguments_of(__doc__)
    parser.add_argument("--peer", type=pathlib.Path)
    parser.add_argument("--samples", type=int, default=10_000_000)
    parser.add_argument("--memory")
    arguments = parser.parse_args()
    programs = {"scarp": arguments.bin / "scarp"} | ({"peer": arguments.peer} if arguments.peer else {})
    with tempfile.TemporaryDirectory() as folder:
        raster, points = pathlib.Path(folder) / "field.pgm", pathlib.Path(folder) / "field.las"
        side = round(arguments.samples**0.5)
        # In a process of its own: the kernel counts the memory of this one as that of the runs.
        maker = multiprocessing.Process(target=make_inputs, args=(programs["scarp"], side, raster, points))
        maker.start()
        maker.join()
        if arguments.memory:
            return compare_parts(programs["scarp"], points, arguments.memory, pathlib.Path(folder))
        runs = {}
        for name, program in programs.items():
            for source in (raster, points):
                for effort in ("fast", "normal"):
                    command = [program, "simplify", source, f"{folder}/out.ply", "-e", "1%", "--effort", effort, "-j", 1, "-q", "--overwrite"]
                    runs[name, source.suffix, effort] = lambda _, command=command: measure_process(command)
        best = {name: min(times, key=lambda run: run["cpu"]) for name, times in interleave(runs, ROUNDS).items()}
    with open(HERE / "points.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["program", "effort", "samples", "raster_cpu_s", "points_cpu_s", "ratio"])
        for name in programs:
            for effort in ("fast", "normal"):
                grid, scattered = (best[name, suffix, effort] for suffix in (".pgm", ".las"))
                table.writerow([name, effort, side * side, f"{grid['cpu']:.2f}", f"{scattered['cpu']:.2f}",
                                f"{scattered['cpu'] / grid['cpu']:.1f}"])
    print((HERE / "points.csv").read_text(), end="")


if __name__ == "__main__":
    main()
