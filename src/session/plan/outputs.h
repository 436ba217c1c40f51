// Checks of output files before any work is done: a missing folder must not show up after an hour of work.
#pragma once

#include <string>
#include <vector>

#include "scarp/result.h"
#include "session/table/option_table.h"

namespace scarp::cli {

/// A file that the run will write, and the option that asked for it ("OUTPUT", "--report", …).
struct PlannedOutput {
  std::string option;
  std::string path;
};

/// Everything that can be known about output files before the work begins: their folders exist and can be written,
/// nothing is replaced without `overwrite`, none is an input or another output.
Result<void> check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs,
                           bool overwrite);
/// Fails for a picture or a raster whose name does not end as its row names, and is no device.
Result<void> check_ending(const OptionRow& row, const PlannedOutput& output);

}  // namespace scarp::cli
