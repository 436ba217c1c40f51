// The results of `scarp measure --volume`, and their report.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scarp/measure.h"
#include "session/inputs/surface.h"
#include "session/text/json.h"

namespace scarp::cli {

struct ComparedSurfaces {
  std::array<Surface, 2> surfaces;  ///< before and after, in one frame
  SurfaceUnits units;
  Volumes volumes;
  double seconds_read = 0, seconds_measure = 0;
  std::vector<std::string> warnings;

  /// Bound of each volume's error: the sum of the max errors times the common area. Nothing if a max error is unknown.
  std::optional<double> uncertainty() const;
};

/// The JSON of --json.
Json make_report(const ComparedSurfaces& compared, const std::string& command_line);
/// The table on standard output.
std::string make_table(const ComparedSurfaces& compared);

}  // namespace scarp::cli
