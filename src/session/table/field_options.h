// The options that stand for the library's settings.
#pragma once

#include <iterator>

#include "pieces/conflicts.h"
#include "session/table/option_table.h"

namespace scarp::cli {

/// In the order of Field. kNone if no option sets the field: the format determines positions, and Ctrl-C ends a run.
inline constexpr OptionTerm kFieldOptions[] = {
    {OptionId::kMaxError},
    {OptionId::kMaxTriangles},
    {OptionId::kMaxPoints},
    {OptionId::kOutlineTolerance},
    {OptionId::kLockBorder},
    {},
    {OptionId::kMask},
    {OptionId::kMask},
    {OptionId::kTolerance},
    {OptionId::kTolerance},
    {OptionId::kBreaklines},
    {OptionId::kCliff},
    {OptionId::kRidges},
    {OptionId::kCutline},
    {OptionId::kScript},
    {OptionId::kScript},
    {OptionId::kOrder, "greedy"},
    {OptionId::kOrder, "dominant"},
    {OptionId::kEffort, "fast"},
    {OptionId::kEffort, "normal"},
    {OptionId::kEffort, "high"},
    {OptionId::kEffort, "max"},
    {OptionId::kVertices, "samples"},
    {OptionId::kVertices, "free"},
    {OptionId::kMinShape},
    {OptionId::kMinAngle},
    {OptionId::kTimeLimit},
    {},
    {OptionId::kObjective, "rms"},
    {OptionId::kImportance},
    {OptionId::kLods},
    {OptionId::kNorm},
    {OptionId::kCompress},
    {OptionId::kUvs},
    {OptionId::kNormals},
    {OptionId::kThreads},
    {OptionId::kMemory},
    {OptionId::kTexture},
    {OptionId::kCrs},
    {OptionId::kCrs, "enu"},
    {OptionId::kMemory},
    {OptionId::kGrid, "mercator"},
    {OptionId::kGrid, "local"},
    {OptionId::kOf, "qm"},
    {OptionId::kOf, "3dtiles"},
    {OptionId::kWater},
    {OptionId::kRivers},
    {OptionId::kWaterMask},
    {OptionId::kBreaklines},
    {OptionId::kDrape},
    {OptionId::kOnly},
    {OptionId::kGeoid},
    {OptionId::kVertical},
};
static_assert(std::size(kFieldOptions) == pieces::kFieldCount);

/// The option for a setting, with its value if that matters.
constexpr OptionTerm option_of(pieces::Field field) { return kFieldOptions[static_cast<int>(field)]; }

}  // namespace scarp::cli
