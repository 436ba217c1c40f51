// Checks output files before the work, so that a missing folder is not found only after an hour.
#pragma once

#include <string>
#include <vector>

#include "scarp/result.h"
#include "session/table/option_table.h"

namespace scarp::cli {

/// A file that the run will write, and its option ("OUTPUT", "--report", …).
struct PlannedOutput {
  std::string option;
  std::string path;
};

/// All checks of output files that are possible before the work: folders exist and are writable, no file is replaced
/// without `overwrite`, and none is an input or another output.
Result<void> check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs,
                           bool overwrite);
/// Fails for a picture or raster without an ending that its row requires, unless it is a device.
Result<void> check_ending(const OptionRow& row, const PlannedOutput& output);

}  // namespace scarp::cli
