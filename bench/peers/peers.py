#!/usr/bin/env python3
"""Triangles of Scarp and of its peers at equal *measured* max error, in ../quality/peers.csv.

  peers.py --bin build/bin                       everything (about half an hour of CPU time)
  peers.py --bin build/bin --only crater         some rasters, printed only
  peers.py --bin build/bin --only crater --keep  some rasters or programs; replaces their rows

Peers promise no max error, or another one. Their parameter is searched for the smallest mesh that keeps the goal by
measure(): every sample covered, none farther than the goal. If no tried mesh covers every sample, the smallest that
keeps the goal at covered samples is used, and the table has the number of uncovered ones. If no tried mesh keeps the
goal, the row has a larger max error.
"""

import math
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SPEED, QUALITY = HERE.parent / "speed", HERE.parent / "quality"
sys.path[:0] = [str(SPEED), str(HERE.parent)]
from harness import arguments_of, call, install, keep_rows, read_table, write_table  # noqa: E402
from rasters import find_file, to_raw  # noqa: E402

# name: (file, window: 384 × 384 samples of the larger ones, as CGAL needs a minute per million samples and run)
RASTERS = {
    "fuji": ("fuji.tif", None),
    "crater": ("crater.tif", None),
    "jacksboro": ("jacksboro_fault.tif", None),
    "bigtujunga_384": ("bigtujunga30m.tif", (364, 124, 384, 384)),
    "nrw_dom1_384": ("nrw_dom1_essen.tif", (308, 308, 384, 384)),
}
GOALS = (5, 2, 1, 0.5, 0.2)  # percent of the relief
VARIANTS = ("greedy", "fast", "normal", "high on samples", "high")

# Heights are scaled so that the relief is a share of the raster's longer side: the flatter the surface, the closer
# errors in space are to errors along z. On crater.tif shares from 1 to 0.0016 were tried: larger ones fold the mesh and
# uncover samples, smaller ones gain nothing more. There meshoptimizer also did no better with a locked border, and had
# the same faults under PreserveFolds and RegularizeLight.
FLATTENED = (0.04, 0.008)
FINEST_ASKED = 8  # lower limit of the requested error, as goal / error, for a peer that breaks its own max error

COARSE, FINE = 1.3, 1.02  # ratio of neighbouring sizes, tried first and last
PROMISING = 1.4            # a setting whose first size exceeds the best one's by this factor is not searched further


class Case:
    """A raster and its files for the programs."""

    def __init__(self, name, options, scratch):
        file, window = RASTERS[name]
        source = find_file(file)
        if source is None:
            raise SystemExit(f"{file} is not there: set SCARP_SHARED to the folder whose data/ has it")
        self.name, self.bin, self.scratch = name, options.bin, Path(scratch)
        self.raw, self.cols, self.rows = to_raw(source, window, self.scratch / f"{name}.f32")
        self.mesh = self.scratch / "mesh"
        flat = self.judge("surface", self.run("peer_scarp", "-e", 1e30, "greedy"))
        self.relief = flat["max_height"] - flat["min_height"]

    def run(self, program, *arguments):
        """The report of a program that writes one mesh."""
        return call([self.bin / program, self.raw, self.cols, self.rows, *arguments, self.mesh])[0]

    def judge(self, form, report, mesh=None):
        """Adds the verdict on the mesh to the report, and deletes the mesh."""
        mesh = mesh or self.mesh
        verdict = call([self.bin / "peer_judge", self.raw, self.cols, self.rows, form, mesh])[0]
        mesh.unlink()
        return {**report, **verdict}

    def judge_surface(self, report, number):
        """Like judge(), for one of several surfaces."""
        return self.judge("surface", report, self.mesh.with_name(f"{self.mesh.name}.{number}"))

    def z_scale(self, flattened):
        return flattened * max(self.cols, self.rows) / self.relief


class Meshopt:
    """A peer by number of triangles."""

    name, program = "meshoptimizer", None
    settings = ((0.04, "update"), (0.008, "update"), (0.008, "simplify"), (0.04, "attribute"))

    @staticmethod
    def describe(setting):
        flattened, mode = setting
        return f"{mode}; relief {flattened:g} of the side"

    @staticmethod
    def probe(case, setting, sizes):
        flattened, mode = setting
        reports = call(["node", HERE / "peer_meshopt.mjs", case.raw, case.cols, case.rows, case.z_scale(flattened), mode,
                       "free", case.mesh, *sizes])
        return {report["size"]: case.judge_surface(report, report["size"]) for report in reports}


class Cgal:
    """A peer by number of edges, three for two triangles; all sizes in one run."""

    program, settings, at_once = "peer_cgal", FLATTENED[-1:], 13

    def __init__(self, name, policy):
        self.name, self.policy = name, policy

    @staticmethod
    def describe(setting):
        return f"relief {setting:g} of the side"

    def probe(self, case, setting, sizes):
        edges = {3 * size // 2: size for size in sorted(sizes, reverse=True)}
        reports = call([case.bin / "peer_cgal", case.raw, case.cols, case.rows, case.z_scale(setting), self.policy,
                       case.mesh, *edges])
        return {edges[report["edges"]]: case.judge_surface(report, report["edges"]) for report in reports}


class Inserting:
    """A peer by its own max error; the size is 10⁹ / error."""

    settings = (None,)

    def __init__(self, name, program, command):
        self.name, self.program, self.command = name, program, command

    @staticmethod
    def describe(_):
        return "its max error"

    def probe(self, case, _, sizes):
        return {size: self.probe_one(case, 1e9 / size) for size in sizes}

    def probe_one(self, case, error):
        report = call([*self.command(case.bin), case.raw, case.cols, case.rows, error, case.mesh])[0]
        return case.judge("lattice", report)


PEERS = (
    Inserting("delatin", None, lambda _: ("node", SPEED / "speed_delatin.mjs")),
    Inserting("VTK", "speed_vtk", lambda folder: (folder / "speed_vtk",)),
    Meshopt(),
    Cgal("CGAL Lindstrom-Turk", "lt"),
    Cgal("CGAL Garland-Heckbert", "gh"),
)


def spread(low, high, factor):
    """Integers from low to high, neighbours about `factor` apart."""
    steps = max(1, math.ceil(math.log(high / low) / math.log(factor)))
    return sorted({round(low * (high / low) ** (k / steps)) for k in range(steps + 1)})


class Search:
    """The trials of one peer with one setting on one raster: verdicts by size."""

    def __init__(self, case, peer, setting):
        self.case, self.peer, self.setting, self.tried = case, peer, setting, {}

    def probe(self, sizes):
        self.tried.update(self.peer.probe(self.case, self.setting, sizes))

    def best_size(self, goal):
        """The size of the smallest mesh that keeps the goal, preferably among those that cover every sample."""
        kept = [size for size, verdict in self.tried.items() if verdict["max_error"] <= goal]
        kept = [size for size in kept if self.tried[size]["uncovered"] == 0] or kept
        return min(kept, key=lambda size: self.tried[size]["triangles"], default=None)

    def triangles(self, goal):
        size = self.best_size(goal)
        return math.inf if size is None else self.tried[size]["triangles"]

    def sizes_below(self, goal):
        """Sizes to try between the best one and the next smaller one; none if these are close enough."""
        size = self.best_size(goal)
        below = max((other for other in self.tried if size is not None and other < size), default=None)
        if below is None or size <= FINE * below:
            return []
        parts = getattr(self.peer, "at_once", 1) + 1
        inner = {round(below * (size / below) ** (k / parts)) for k in range(1, parts)}
        return sorted(inner - set(self.tried))

    def refine(self, goals):
        while sizes := sorted({size for goal in goals for size in self.sizes_below(goal)}):
            self.probe(sizes)


def search_sizes(case, peer, goals, greedy):
    """{goal: (verdict, setting)} of a peer whose size is a number of triangles; all goals share the trials."""
    full = 2 * (case.cols - 1) * (case.rows - 1)
    sizes = spread(max(8, min(greedy.values()) // 3), min(full, 6 * max(greedy.values())), COARSE)
    searches = [Search(case, peer, setting) for setting in peer.settings]
    for search in searches:
        search.probe(sizes)
    for search in searches:
        search.refine([goal for goal in goals if search.triangles(goal) <=
                       PROMISING * min(other.triangles(goal) for other in searches) < math.inf])
    found = {}
    for goal in goals:
        best = min(searches, key=lambda search: search.triangles(goal))
        if best.best_size(goal) is not None:
            found[goal] = (best.tried[best.best_size(goal)], best.setting)
    return found


def search_errors(case, peer, goals):
    """The same for a peer whose size is an error: around each goal, then towards finer ones. If none keeps the goal,
    returns the mesh for the goal itself, whose max error shows the breach."""
    found = {}
    for goal in goals:
        search, size = Search(case, peer, None), round(1e9 / goal)
        search.probe([round(0.9 * size), size])
        while search.best_size(goal) is None and max(search.tried) < FINEST_ASKED * size:
            search.probe([2 * max(search.tried)])
        search.refine([goal])
        found[goal] = (search.tried[search.best_size(goal) or size], None)
    return found


def row_of(case, percent, goal, program, setting, verdict, greedy):
    return {
        "raster": case.name, "cols": case.cols, "rows": case.rows, "percent_of_relief": f"{percent:g}",
        "max_error_asked": f"{goal:.9g}", "program": program, "version": verdict["version"], "setting": setting,
        "triangles": verdict["triangles"], "ratio": f"{verdict['triangles'] / greedy:.4f}",
        "max_error": f"{verdict['max_error']:.7g}", "rmse": f"{verdict['rmse']:.7g}",
        "uncovered": verdict["uncovered"], "folded": verdict["folded"], "min_angle": f"{verdict['min_angle']:.4f}",
        "angle_p1": f"{verdict['angle_p1']:.3f}", "angle_median": f"{verdict['angle_median']:.2f}",
        "cpu_seconds": f"{verdict['cpu_seconds']:.4f}",
    }


def compare(case, options):
    """Rows of a raster, Scarp's first."""
    goals = {percent / 100 * case.relief: percent for percent in options.goals}
    greedy, made = {}, []
    for goal, percent in goals.items():
        for variant in VARIANTS:
            verdict = case.judge("surface", case.run("peer_scarp", "-e", f"{goal:.17g}", variant))
            if verdict["max_error"] > goal or verdict["uncovered"] > 0:
                raise SystemExit(f"{case.name}: Scarp, {variant}, breaks {goal:g}")
            greedy.setdefault(goal, verdict["triangles"])
            made.append(row_of(case, percent, goal, f"Scarp {variant}", "", verdict, greedy[goal]))
    for peer in PEERS:
        if peer.name not in options.programs or (peer.program and not (options.bin / peer.program).exists()):
            continue
        if isinstance(peer, Inserting):
            found = search_errors(case, peer, list(goals))
        else:
            found = search_sizes(case, peer, list(goals), greedy)
        made += [row_of(case, goals[goal], goal, peer.name, peer.describe(setting), verdict, greedy[goal])
                 for goal, (verdict, setting) in found.items()]
        for row in made[-len(found):]:
            print(*row.values(), sep=",", flush=True)
    return made


def keep(rows, times):
    """Preserves old rows of other rasters, goals or programs. CPU times relative to greedy insertion's are stored as
    means of complete runs only."""
    programs = [f"Scarp {variant}" for variant in VARIANTS] + [peer.name for peer in PEERS]

    def place(row):
        return list(RASTERS).index(row["raster"]), -float(row["percent_of_relief"]), programs.index(row["program"])

    keep_rows(QUALITY / "peers.csv", rows, ("raster", "percent_of_relief", "program"), place)
    if times:
        means = [{"table": "peers", "variant": program,
                  "mean": f"{math.exp(sum(map(math.log, ratios)) / len(ratios)):.4g}",
                  "least": f"{min(ratios):.4g}", "most": f"{max(ratios):.4g}"} for program, ratios in times.items()]
        others = [row for row in read_table(QUALITY / "times.csv") if row["table"] != "peers"]
        write_table(QUALITY / "times.csv", [*others, *means])


def parse():
    names = [peer.name for peer in PEERS]
    parser = arguments_of(__doc__)
    parser.add_argument("--only", nargs="+", choices=RASTERS, help="some of the rasters; printed only")
    parser.add_argument("--programs", nargs="*", choices=names, help="some of the peers; printed only")
    parser.add_argument("--goals", nargs="+", type=float, default=GOALS, help="percent of the relief; printed only")
    parser.add_argument("--keep", action="store_true", help="keep the rows nevertheless")
    options = parser.parse_args()
    options.whole = options.only is None and options.programs is None and options.goals == GOALS
    options.programs = names if options.programs is None else options.programs
    return options


def add_times(rows, times):
    """Mean CPU times of rows that satisfy their goal, relative to greedy insertion's; removes times from rows."""
    seconds = {(row["percent_of_relief"], row["program"]): float(row.pop("cpu_seconds")) for row in rows}
    for row in rows:
        if row["program"] != "Scarp greedy" and float(row["max_error"]) <= float(row["max_error_asked"]) * (1 + 1e-7):
            goal = row["percent_of_relief"]
            times.setdefault(row["program"], []).append(seconds[goal, row["program"]] / seconds[goal, "Scarp greedy"])


def main():
    options, times = parse(), {}
    for program in ("delatin", "meshoptimizer"):
        if program in options.programs:
            install(program)
    for name in options.only or RASTERS:
        with tempfile.TemporaryDirectory() as scratch:
            rows = compare(Case(name, options, scratch), options)
        add_times(rows, times)
        if options.whole or options.keep:
            keep(rows, times if options.whole and name == list(RASTERS)[-1] else {})


if __name__ == "__main__":
    main()
