// Lines of vector files, as the mesh must hold them.
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

/// The lines of --breaklines, in the CRS of the raster; sentences for the user in `warnings`.
Result<LineConstraints> read_breaklines(const GivenOptions& given, const RasterInfo& raster, int rows,
                                        const ProgressCallback& progress, std::vector<std::string>& warnings);

/// Refuses lines where the CRS that --crs names bends the grid of the raster.
/// `lines`: the option that asks for them; empty: there are none.
Result<void> check_frame_of_lines(const std::string& lines, const Frame& frame, const std::string& crs_option,
                                  const std::string& input);

}  // namespace scarp::cli
