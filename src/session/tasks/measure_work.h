// scarp measure without its terminal: reads a raster and a mesh, and judges the mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/picture.h"
#include "session/options/given_options.h"
#include "session/reports/measure_report.h"
#include "session/tasks/runner.h"

namespace scarp::cli {

/// Handles the errors of streamed samples, row by row.
struct StreamedErrors {
  std::optional<ErrorMap> map = std::nullopt;
  std::optional<RasterFile> raster = std::nullopt;
};

/// Checks the files of --map and --error-raster before the work.
Result<void> check_measure_outputs(const GivenOptions& given);
/// Reads raster and mesh, and judges the mesh.
Result<void> judge_inputs(const GivenOptions& given, const Runner& runner, Judged& judged, StreamedErrors& errors);
/// Writes the files of --map and --error-raster.
Result<void> write_error_files(const GivenOptions& given, const Judged& judged, StreamedErrors& streamed);

}  // namespace scarp::cli
