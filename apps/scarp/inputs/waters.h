// Lakes and rivers that the mesh must hold.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options/line_options.h"
#include "options/memory.h"
#include "reports/json.h"
#include "scarp/rivers.h"
#include "scarp/water.h"

namespace scarp::cli {

struct WatersFound {
  std::vector<Lake> lakes;
  std::vector<River> rivers;
  std::vector<Line> streams;  ///< what --rivers names, as it was read

  /// That the field keeps for them, where its samples are not in memory as one array.
  std::uint64_t bytes() const;
};

/// Makes the lakes of --water flat, or finds those of --detect-flats, lets --rivers flow, and makes shores and courses
/// `lines` of the mesh. `max_error`: what rivers may lie beside the lowest of what is upstream, twice; nothing: it is
/// not known yet, and add_rivers() is to make courses lines. `memory`: without that of the waters.
Result<WatersFound> add_waters(const LineArguments& given, const ProgressCallback& progress,
                               const std::optional<double>& max_error, const MemoryShare& memory,
                               OwnedHeightField& field, LineConstraints& lines, std::vector<std::string>& warnings);

/// Makes the courses of rivers, as a mesh of so large an error needs them, lines of it.
Result<void> add_rivers(const WatersFound& waters, const OwnedHeightField& field, double max_error,
                        LineConstraints& lines);

/// The "water" and "rivers" lists of a report.
Json describe_lakes(const std::vector<Lake>& lakes);
Json describe_rivers(const std::vector<River>& rivers);
/// Of the summary; empty without lakes and rivers.
std::string waters_lines(const WatersFound& waters);

}  // namespace scarp::cli
