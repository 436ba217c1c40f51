// Lines of vector files that become edges of the mesh.
#pragma once

#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/lines.h"
#include "session/options/line_options.h"

namespace scarp::cli {

/// The lines of all files.
Result<std::vector<Line>> read_files(const std::vector<std::string>& files, const ReadLinesOptions& options,
                                     std::vector<std::string>& warnings);

/// The lines of --breaklines in the CRS of the raster. Adds sentences for the user to `warnings`.
Result<LineConstraints> read_breaklines(const GivenOptions& given, const RasterInfo& raster, int rows,
                                        const ProgressCallback& progress, std::vector<std::string>& warnings);

/// Refuses lines if the CRS of --crs makes the raster's frame curved. `lines`: the option of the lines; empty: none.
Result<void> check_frame_of_lines(const std::string& lines, const Frame& frame, const std::string& crs_option,
                                  const std::string& input);

}  // namespace scarp::cli
