// How a run behaves: memory, threads, what it prints.
#include "session/table/option_rows.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using enum OptionType;

constexpr OptionRow kRunRows[] = {
    {.id = OptionId::kMemory,
     .name = "--memory",
     .commands = kSimplify,
     .group = OptionGroup::kMemory,
     .type = kNumber,
     .value = "SIZE",
     .unit = "bytes, or with k M G T Ki Mi Gi Ti",
     .by_default = "no limit",
     .range = "at least 72M",
     .is_of_mesh = false,
     .help =
         "Memory limit, such as 1G. Larger rasters are streamed: they stay in their file, some options are refused.",
     .brief = "Memory limit, such as 1G"},
    {.id = OptionId::kMemory,
     .name = "--memory",
     .commands = kMeasure,
     .group = OptionGroup::kMemory,
     .type = kNumber,
     .value = "SIZE",
     .unit = "bytes, or with k M G T Ki Mi Gi Ti",
     .by_default = "no limit",
     .range = "at least 72M",
     .help = "Memory limit, such as 1G. Larger rasters are read in bands of rows as they are judged.",
     .brief = "Memory limit, such as 1G"},

    {.id = kThreads,
     .name = "--num-threads",
     .short_name = "-j",
     .commands = kSimplify | kMeasure | kTile | kTileRun | kTileFinish | kTileCheck | kServe,
     .group = OptionGroup::kRun,
     .type = kCount,
     .value = "N",
     .by_default = "0, all cores",
     .least = 0,
     .most = 1024,
     .limit_why = "ask for fewer, or for 0, all cores",
     .is_of_mesh = false,
     .is_for_points = true,
     .help = "Number of threads. Never changes the result."},
    {.id = kQuiet,
     .name = "--quiet",
     .short_name = "-q",
     .commands = kSimplify | kMeasure | kView | kInfo | kGenerate | kTile | kTilePlan | kTileRun | kTileFinish |
                 kTileCheck | kServe,
     .group = OptionGroup::kRun,
     .type = kFlag,
     .is_of_mesh = false,
     .is_for_points = true,
     .help = "Print no summary, no progress and no warnings."},
    {.id = kTiming,
     .name = "--timing",
     .commands = kSimplify,
     .group = OptionGroup::kRun,
     .type = kFlag,
     .is_of_mesh = false,
     .help = "After the summary, print the time and work of each pass."},
    {.id = kJsonProgress,
     .name = "--json-progress",
     .commands = kSimplify | kMeasure | kInfo | kTile | kTilePlan | kTileRun | kTileFinish | kTileCheck | kServe,
     .group = OptionGroup::kRun,
     .type = kFlag,
     .is_of_mesh = false,
     .is_for_points = true,
     .help = "Print progress as one JSON object a line on standard error."},
    {.id = kHelp,
     .name = "--help",
     .short_name = "-h",
     .commands = kEveryCommand,
     .group = OptionGroup::kRun,
     .type = kFlag,
     .help = "Print the help of the command; where that is long, the most used options.",
     .brief = "Print this page"},
    {.id = kHelpAll,
     .name = "--help-all",
     .commands = kEveryCommand,
     .group = OptionGroup::kRun,
     .type = kFlag,
     .help = "Print all options, by subject.",
     .brief = "Print all options, by subject"},
    {.id = kVersion,
     .name = "--version",
     .commands = kEveryCommand,
     .group = OptionGroup::kRun,
     .type = kFlag,
     .help = "Print the version."},
};

}  // namespace

std::span<const OptionRow> run_rows() { return kRunRows; }

}  // namespace scarp::cli
