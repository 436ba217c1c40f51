#!/usr/bin/env python3
"""RMSE of Scarp and of the quadric tools at equal numbers of triangles, in ../quality/squares.csv.

  squares.py --bin build/bin                       everything (about twenty minutes of CPU time)
  squares.py --bin build/bin --only crater         some rasters, printed only
  squares.py --bin build/bin --only crater --keep  some rasters; replaces their rows

The number is that of greedy insertion at 1 % of the relief. For each setting of a peer the smallest mesh is used that
has at least as many triangles as Scarp's, `high rms`, and at most 1 % more. The setting with the best RMSE counts.
Uncovered samples have no error, which favours the peer.
"""

import sys
import tempfile

from peers import FLATTENED, QUALITY, RASTERS, Case, Cgal, Meshopt, arguments_of, call, install, keep_rows

PERCENT = 1  # percent of the relief
MOST_MORE = 1.01  # a mesh with more triangles than Scarp's by this factor does not count: VTK's attributes stop it
                  # early on walls
SCARP = ("normal", "normal rms", "high", "high rms")

RASTERS.update({
    "baltoro_384": ("baltoro_srtm.tif", (238, 23, 384, 384)),
    "sierra_de_bejar_384": ("sierra_de_bejar_25m.tif", (108, 13, 384, 384)),
    "grenoble_384": ("grenoble_copernicus.tif", (58, 58, 384, 384)),
    "gabilan_384": ("gabilan_lidar_1m.tif", (268, 238, 384, 384)),
    "azores_384": ("azores_bathymetry_1min.tif", (108, 33, 384, 384)),
    "mars_gale": ("mars_gale_hirise_1m.tif", None),
    "cuyuna_384": ("cuyuna_pits_lidar_1m.tif", (8, 8, 384, 384)),
    "athens_384": ("athens_dsm_1m.tif", (8, 8, 384, 384)),
})


def keep_smallest(case, sizes, triangles, least):
    """The smallest surface of MESH.SIZE with `triangles[size]` of at least `least`, if any; deletes the others."""
    best = min((size for size in sizes if triangles[size] >= least), key=lambda size: (triangles[size], size),
               default=None)
    for size in sizes:
        if size != best:
            case.mesh.with_name(f"{case.mesh.name}.{size}").unlink()
    return best


class CgalSquares(Cgal):
    """By number of edges, which depends on the border for the same number of triangles: all are tried in one run."""

    settings = FLATTENED

    def make(self, case, setting, least):
        edges = range(3 * least // 2 + case.cols + case.rows, 3 * least // 2, -3)
        reports = call([case.bin / self.program, case.raw, case.cols, case.rows, case.z_scale(setting), self.policy,
                       case.mesh, *edges])
        by_size = {report["edges"]: report for report in reports}
        best = keep_smallest(case, by_size, {size: report["triangles"] for size, report in by_size.items()}, least)
        return best and case.judge_surface(by_size[best], best)


class ByTriangles:
    """By number of triangles. A peer may reach fewer: requests more until it does not."""

    def make(self, case, setting, least):
        for more in (0, 1, 2, 4, 8, 16, 64, 256):
            verdict = self.probe(case, setting, [least + more])[least + more]
            if verdict["triangles"] >= least:
                return verdict
        return None


class MeshoptSquares(ByTriangles, Meshopt):
    pass


class Vtk(MeshoptSquares):
    name, program = "VTK quadrics", "peer_vtk"
    # VolumePreservation changed nothing on mars_gale, and attributes were better at 0.2 than on flatter surfaces.
    settings = ((0.2, "plain"), (0.04, "plain"), (0.008, "plain"), (0.2, "attribute"))

    @staticmethod
    def probe(case, setting, sizes):
        flattened, mode = setting
        reports = call([case.bin / "peer_vtk", case.raw, case.cols, case.rows, case.z_scale(flattened), mode, case.mesh,
                       *sizes])
        return {report["size"]: case.judge_surface(report, report["size"]) for report in reports}


PEERS = (MeshoptSquares(), CgalSquares("CGAL Lindstrom-Turk", "lt"), CgalSquares("CGAL Garland-Heckbert", "gh"), Vtk())


def row_of(case, program, setting, verdict, scarp):
    return {
        "raster": case.name, "cols": case.cols, "rows": case.rows, "program": program, "version": verdict["version"],
        "setting": setting, "triangles": verdict["triangles"], "rmse": f"{verdict['rmse']:.7g}",
        "ratio": f"{verdict['rmse'] / scarp['rmse']:.4f}", "max_error": f"{verdict['max_error']:.7g}",
        "uncovered": verdict["uncovered"], "folded": verdict["folded"], "angle_p1": f"{verdict['angle_p1']:.3f}",
    }


def compare(case, options):
    """Rows of a raster: Scarp's variants, then the best setting of each peer."""
    greedy = case.judge("surface", case.run("peer_scarp", "-e", f"{PERCENT / 100 * case.relief:.17g}", "greedy"))
    made = {name: case.judge("surface", case.run("peer_scarp", "-t", greedy["triangles"], name)) for name in SCARP}
    scarp = made["high rms"]
    if scarp["uncovered"] or scarp["folded"]:
        raise SystemExit(f"{case.name}: Scarp's mesh folds or leaves samples uncovered")
    rows = [row_of(case, f"Scarp {name}", "", verdict, scarp) for name, verdict in {"greedy": greedy, **made}.items()]
    for peer in PEERS:
        if peer.name not in options.programs or (peer.program and not (options.bin / peer.program).exists()):
            continue
        found = [(peer.make(case, setting, scarp["triangles"]), setting) for setting in peer.settings]
        found = [(verdict, setting) for verdict, setting in found
                 if verdict and verdict["triangles"] <= MOST_MORE * scarp["triangles"]]
        for verdict, setting in found:
            print(case.name, peer.name, peer.describe(setting), verdict["triangles"], verdict["rmse"],
                  verdict["uncovered"], verdict["folded"], file=sys.stderr, flush=True)
        if found:
            verdict, setting = min(found, key=lambda one: one[0]["rmse"])
            rows.append(row_of(case, peer.name, peer.describe(setting), verdict, scarp))
    for row in rows:
        print(*row.values(), sep=",", flush=True)
    return rows


def keep(rows):
    """Preserves old rows of other rasters or programs."""
    programs = [f"Scarp {name}" for name in ("greedy", *SCARP)] + [peer.name for peer in PEERS]
    keep_rows(QUALITY / "squares.csv", rows, ("raster", "program"),
              lambda row: (list(RASTERS).index(row["raster"]), programs.index(row["program"])))


def main():
    names = [peer.name for peer in PEERS]
    parser = arguments_of(__doc__)
    parser.add_argument("--only", nargs="+", choices=RASTERS, help="some of the rasters; printed only")
    parser.add_argument("--programs", nargs="*", choices=names, default=names, help="some of the peers")
    parser.add_argument("--keep", action="store_true", help="keep the rows of some rasters nevertheless")
    options = parser.parse_args()
    if MeshoptSquares.name in options.programs:
        install("meshoptimizer")
    for name in options.only or RASTERS:
        with tempfile.TemporaryDirectory() as scratch:
            rows = compare(Case(name, options, scratch), options)
        if options.keep or options.only is None:
            keep(rows)


if __name__ == "__main__":
    main()
