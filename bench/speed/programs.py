"""Times whole programs: a deflated GeoTIFF in, a mesh out, reading, proof and writing included.

delatin has no program of its own. Here it is one process of node that reads the raw raster (nothing to decode), refines
once, not warmed up, and writes 12 bytes a vertex and 12 a triangle, without a proof.
"""

import json
import os
import statistics
import subprocess
import time

from rasters import ERRORS, HERE

EFFORTS = ("fast", "normal", "high")
# Many seconds at fine errors: at the two coarsest of each raster only.
SLOW = ("high",)


def measure_process(command):
    """Seconds of a child, and its peak resident bytes; it must succeed."""
    start = time.perf_counter()
    child = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.perf_counter() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} ended with {child.returncode}")
    return {"wall": wall, "cpu": usage.ru_utime + usage.ru_stime, "peak": 1024 * usage.ru_maxrss}


def make_tif(raster, scratch):
    """The raw raster as a GeoTIFF as most are: deflated blocks of 512 by 512, a predictor."""
    tif = scratch / f"{raster[0].stem}.tif"
    if not tif.exists():
        subprocess.run(["gdal_translate", "-q", "-co", "TILED=YES", "-co", "BLOCKXSIZE=512", "-co", "BLOCKYSIZE=512",
                        "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=3", raster[0], tif], check=True)
    return tif


def passes_of(program, tif, glb, error, effort):
    """Seconds by pass of one run on one thread, and the vertices."""
    report = glb.with_suffix(".json")
    subprocess.run([program, "simplify", tif, glb, "-e", str(error), "--effort", effort, "-j", "1", "-q", "--overwrite",
                    "--report", report], check=True)
    told = json.loads(report.read_text())
    return {one["name"]: one["seconds"] for one in told["passes"]}, told["vertices"]


def time_programs(bench, name, raster, error):
    """Rows of the efforts on one thread and on all, and of delatin; all interleaved."""
    program, tif, glb = bench.bin / "scarp", make_tif(raster, bench.scratch), bench.scratch / "program.glb"
    coarsest = error in ERRORS[name][:2]

    def scarp(effort, threads):
        return [program, "simplify", tif, glb, "-e", error, "--effort", effort, "-j", threads, "-q", "--overwrite"]

    efforts = [effort for effort in EFFORTS if effort not in SLOW or coarsest]
    commands = {(effort, threads): scarp(effort, threads) for effort in efforts for threads in bench.options.threads}
    if "delatin" in (bench.options.programs or ["delatin"]):
        bench.install_delatin()
        commands["delatin", 1] = ["node", HERE / "speed_delatin.mjs", *raster, error, bench.scratch / "delatin.mesh",
                                  "once"]
    runs = {key: [] for key in commands}
    keys = list(commands)
    for number in range(bench.rounds(raster)):
        turn = number % len(keys)
        for key in keys[turn:] + keys[:turn]:
            runs[key].append(measure_process(commands[key]))
    for (who, threads), done in runs.items():
        passes, vertices = ({}, "") if who == "delatin" else passes_of(program, tif, glb, error, who)
        yield {
            "raster": name, "samples": raster[1] * raster[2], "error": f"{error:g}", "program": who,
            "threads": threads, "vertices": vertices, "rounds": len(done),
            **{f"{clock}_{which}_ms": f"{1e3 * pick(one[clock] for one in done):.1f}"
               for clock in ("wall", "cpu") for which, pick in (("min", min), ("median", statistics.median))},
            "peak_mb": f"{min(one['peak'] for one in done) / 1e6:.1f}",
            "passes_ms": " ".join(f"{key}={1e3 * seconds:.1f}" for key, seconds in passes.items()),
        }
