// Options for the goals of a mesh and the effort.
#include "session/table/option_rows.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using enum OptionType;

constexpr OptionRow kGoalRows[] = {
    {.id = kMaxError,
     .name = "--max-error",
     .short_name = "-e",
     .commands = kSimplify,
     .group = OptionGroup::kGoals,
     .type = kNumber,
     .value = "M|P%",
     .unit = "units of the heights, % of the relief, or m, cm, ft, mm",
     .least = 0,
     .is_for_points = true,
     .help = "No sample is farther than this from the mesh, measured vertically. M is in the units of the heights; P%, "
             "such as 0.5%, is a share of the relief. 1m, 50cm and 3ft name their unit. 0.1mm is measured on the print "
             "of --solid size=. 0 reproduces every sample.",
     .brief = "No sample is farther than this from the mesh; 0.5%: of the relief"},
    {.id = kMaxTriangles,
     .name = "--max-triangles",
     .short_name = "-t",
     .commands = kSimplify,
     .group = OptionGroup::kGoals,
     .type = kCount,
     .value = "N",
     .unit = "triangles",
     .least = 1,
     .is_for_points = true,
     .help = "At most N triangles. N may be 50k, 2M or 1e5.",
     .brief = "At most N triangles, such as 50k"},
    {.id = kMaxPoints,
     .name = "--max-points",
     .short_name = "-p",
     .commands = kSimplify,
     .group = OptionGroup::kGoals,
     .type = kCount,
     .value = "N",
     .unit = "vertices",
     .least = 1,
     .is_for_points = true,
     .help = "At most N vertices.",
     .brief = "At most N vertices"},
    {.id = kObjective,
     .name = "--objective",
     .commands = kSimplify,
     .group = OptionGroup::kGoals,
     .type = kChoice,
     .choices = "max rms",
     .by_default = "max",
     .is_for_points = true,
     .help = "Quantity to minimise with -t or -p: the max error or the RMSE. With rms, errors stay within -e or, "
             "without -e, within the max error of --effort fast. Needs --effort normal or more."},

    {.id = kFailAbove,
     .name = "--fail-above",
     .commands = kMeasure,
     .group = OptionGroup::kVerdict,
     .type = kNumber,
     .value = "E|P%",
     .unit = "units of the heights, % of the relief, or m, cm, ft",
     .least = 0,
     .is_for_points = true,
     .help = "End with exit code 3 if an error is above this, a sample is uncovered or the mesh is not sound. E and P% "
             "are like M and P% of simplify's --max-error. Errors are in units of the heights. --mask weights errors; "
             "--texture and --image combine those of several bands by --norm.",
     .brief = "Exit code 3 if an error is above this, or the mesh is not sound"},
    {.id = kVolume,
     .name = "--volume",
     .commands = kMeasure,
     .group = OptionGroup::kVerdict,
     .type = kFlag,
     .help = "Measure the volumes between two surfaces, the ground before and after: two meshes, or a mesh and "
             "level=H. Cut is the volume where the second surface is below the first; fill is the volume where it is "
             "above.",
     .brief = "Cut and fill from the first mesh to the second, or to level=H"},

    {.id = kEffort,
     .name = "--effort",
     .commands = kSimplify,
     .group = OptionGroup::kEffort,
     .type = kChoice,
     .value = "LEVEL",
     .choices = "fast normal high max",
     .by_default = "normal; fast with the 1995 paper's strategies, or with too little --memory",
     .is_for_points = true,
     .help = "Work to spend on fewer triangles. fast: refine only. normal: also remove vertices; 0.53 of the triangles "
             "of fast. high: also move vertices; 0.30. max: search longer; 0.27. CPU time is 0.4, 1.4, 10.7 and 54 "
             "times that of the 1995 paper's algorithm. With -t or -p, the work reduces the error instead.",
     .brief = "fast, normal, high or max: fewer triangles for more time"},
    {.id = kMinShape,
     .name = "--min-shape",
     .part_of = kEffort,
     .key = "min-shape",
     .commands = kSimplify,
     .group = OptionGroup::kEffort,
     .type = kNumber,
     .value = "Q",
     .unit = "height over longest edge",
     .by_default = "0.1 for high and max with free vertices, else 0",
     .least = 0,
     .most = 0.5,
     .limit_why = "0.5 is the shape of half a sample's square",
     .is_for_points = true,
     .help = "Do not create triangles thinner than this (height over longest edge)."},
    {.id = kTimeLimit,
     .name = "--time-limit",
     .part_of = kEffort,
     .key = "time-limit",
     .commands = kSimplify,
     .group = OptionGroup::kEffort,
     .type = kNumber,
     .value = "SECONDS",
     .unit = "seconds",
     .least = 0,
     .is_for_points = true,
     .help = "Stop improving after SECONDS and write the best mesh so far. The bound holds, but the mesh depends on "
             "timing. --effort max uses all the time."},
    {.id = kVertices,
     .name = "--vertices",
     .commands = kSimplify,
     .group = OptionGroup::kEffort,
     .type = kChoice,
     .choices = "free samples",
     .by_default = "free for high and max where possible, else samples",
     .is_for_points = true,
     .help =
         "Positions of vertices. free: also between samples; not with --effort fast. samples: only at samples; with "
         "--effort high this needs 0.41 times the triangles of --effort fast."},

    {.id = kLods,
     .name = "--lods",
     .commands = kSimplify,
     .group = OptionGroup::kLevels,
     .type = kText,
     .value = "N[:RATIO]",
     .unit = "levels",
     .is_for_points = true,
     .help = "Write N levels of detail, as files OUT_lod0.glb, OUT_lod1.glb and so on. The max error is -e at level 0 "
             "and grows by the factor RATIO (default 2) per level. All levels have the outline of --lock-border."},
    {.id = kLodsInOne,
     .name = "--lods-in-one",
     .part_of = kLods,
     .key = "in-one",
     .commands = kSimplify,
     .group = OptionGroup::kLevels,
     .type = kFlag,
     .is_of_mesh = false,
     .is_for_points = true,
     .help = "Write all levels to one GLB, as nodes with MSFT_lod."},
    {.id = kLockBorder,
     .name = "--lock-border",
     .commands = kSimplify,
     .group = OptionGroup::kLevels,
     .type = kFlag,
     .help = "Choose vertices on the raster's edge only by the edge's samples. Rasters that share a row or column of "
             "samples then meet exactly, if they are simplified with the same -e."},
};

}  // namespace

std::span<const OptionRow> goal_rows() { return kGoalRows; }

}  // namespace scarp::cli
