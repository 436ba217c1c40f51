// Parts of the program's pictures: scale, units, titles, lines.
#pragma once

#include <string>

#include "scarp/picture.h"
#include "session/reports/simplify_outcome.h"

namespace scarp::cli {

/// Includes the run's lakes, rivers, breaklines, ridges, walls and cutlines.
PreviewOptions preview_options(const Outcome& outcome, int max_side);
/// `unit`: unit of the errors.
ErrorMapOptions error_map_options(const RasterInfo& info, const std::string& unit, const std::string& mesh_path,
                                  int max_side);
/// "m" for the metre by any name, else the file's unit.
std::string short_unit(const std::string& unit);

}  // namespace scarp::cli
