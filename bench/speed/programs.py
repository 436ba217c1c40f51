"""Times whole programs from a deflated GeoTIFF to a mesh, with reading, proof and writing.

delatin has no program. Here it is a process of node that reads the raw raster (nothing to decode), refines once without
warm-up, and writes 12 bytes a vertex and 12 a triangle, without a proof.
"""

import json
import statistics
import subprocess
import sys

from rasters import ERRORS, HERE

sys.path.insert(0, str(HERE.parent))
from harness import install, interleave, measure_process  # noqa: E402

EFFORTS = ("fast", "normal", "high")
# Many seconds at fine errors, so only the two coarsest of each raster.
SLOW = ("high",)


def make_tif(raster, scratch):
    """The raw raster as a typical GeoTIFF: deflated blocks of 512 by 512 with a predictor."""
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
    """Rows of the efforts on one and on all threads, and of delatin; all interleaved."""
    program, tif, glb = bench.bin / "scarp", make_tif(raster, bench.scratch), bench.scratch / "program.glb"
    coarsest = error in ERRORS[name][:2]

    def scarp(effort, threads):
        return [program, "simplify", tif, glb, "-e", error, "--effort", effort, "-j", threads, "-q", "--overwrite"]

    efforts = [effort for effort in EFFORTS if effort not in SLOW or coarsest]
    commands = {(effort, threads): scarp(effort, threads) for effort in efforts for threads in bench.options.threads}
    if "delatin" in (bench.options.programs or ["delatin"]):
        install("delatin")
        commands["delatin", 1] = ["node", HERE / "speed_delatin.mjs", *raster, error, bench.scratch / "delatin.mesh",
                                  "once"]
    runs = interleave({key: lambda _, run=command: measure_process(run) for key, command in commands.items()}, bench.rounds(raster))
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
