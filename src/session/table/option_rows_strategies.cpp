// The strategies of the 1995 paper: which samples become vertices, and which edges join them.
#include "session/table/option_rows.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using enum OptionType;

constexpr OptionRow kStrategyRows[] = {
    {.id = kOrder,
     .name = "--order",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kChoice,
     .choices = "dominant greedy",
     .by_default = "dominant with -e alone, else greedy",
     .is_of_mesh = false,
     .help = "Next sample to insert. dominant: the worst of its neighbourhood, on all threads. greedy: the worst of "
             "the whole raster, as in the paper, on one thread.",
     .brief = "Next sample to insert: dominant or greedy"},
    {.id = kImportance,
     .name = "--importance",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kText,
     .value = "FORMULA",
     .choices = "global local local8 curvature distance global*local global*local8 global*curvature global*distance",
     .by_default = "global",
     .help = "Measure that ranks samples: global (error of the mesh), local or local8 (difference from the mean of its "
             "4 or 8 neighbours) or curvature. Or a product: global*local, 'global*(local+1)', "
             "'global*sqrt(curvature+1)'. The distance to the nearest corner of the sample's triangle attenuates "
             "errors near vertices: 'global*sqrt(distance+1)'.",
     .brief = "Measure that ranks samples, such as global*local"},
    {.id = kOnePass,
     .name = "--one-pass",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kFlag,
     .help = "Rank all samples once, by --importance local, local8 or curvature, and insert the best. Use it with -t "
             "or -p: with -e, nearly all samples are inserted.",
     .brief = "Rank all samples once and insert the best"},
    {.id = kAlgorithm,
     .name = "--algorithm",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kChoice,
     .choices = "brute local heap",
     .by_default = "heap",
     .is_of_mesh = false,
     .help = "Method to find the next sample of the greedy order: the paper's algorithm I, II or III. The mesh is the "
             "same.",
     .brief = "The paper's algorithms I, II and III of the greedy order"},
    {.id = kBatch,
     .name = "--batch",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kText,
     .value = "RULE",
     .choices = "const frac: independent",
     .by_default = "one sample at a time",
     .help = "Insert several samples per pass. const: all that break the bound. frac:A: all with at least A times the "
             "worst error. independent: those in triangles that the pass has not changed.",
     .brief = "Insert several samples per pass"},
    {.id = kEdges,
     .name = "--edges",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kChoice,
     .choices = "delaunay data",
     .by_default = "delaunay",
     .help = "Diagonals to use. delaunay: those of well-shaped triangles. data: those that fit the heights.",
     .brief = "Diagonals by shape (delaunay) or by the heights (data)"},
    {.id = kEdgeScore,
     .name = "--edge-score",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kChoice,
     .value = "SCORE",
     .choices = "sum max sqerr abn tight",
     .by_default = "sum",
     .help = "With --edges data: measure of a diagonal. sum or max of its triangles' largest errors, sqerr (squared "
             "errors), abn (angle between normals), tight (fewest triangles at equal error).",
     .brief = "With --edges data: the measure of a diagonal"},
    {.id = kShapeThreshold,
     .name = "--shape-threshold",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kNumber,
     .value = "Q",
     .by_default = "0.5, with tight 0.1",
     .least = 0,
     .most = 1,
     .limit_why = "0 counts the data alone, 1 the shape alone",
     .help = "With --edges data: 0 uses only the data, 1 only the shape.",
     .brief = "With --edges data: 0 uses only data, 1 only shape"},
    {.id = kSupersample,
     .name = "--supersample",
     .commands = kStrategies,
     .group = OptionGroup::kStrategies,
     .type = kNumber,
     .value = "F",
     .by_default = "0, off",
     .least = 0,
     .help = "With --edges data: judge thin triangles on a finer lattice of bilinear heights. 0.8 is moderate.",
     .brief = "With --edges data: judge thin triangles on a finer lattice"},
};

}  // namespace

std::span<const OptionRow> strategy_rows() { return kStrategyRows; }

}  // namespace scarp::cli
