#include "session/options/measure_options.h"

#include "session/table/option_table.h"

namespace scarp::cli {

void MeasureArguments::add_to(CLI::App& command) {
  add_arguments(command, OptionId::kRaster, raster.paths, OptionId::kMesh, mesh);
  raster.add_to(command);
  add_option(command, OptionId::kUp, up);
  points.add_to(command);
  add_option(command, OptionId::kFailAbove, fail_above);
  companions.add_to(command);
  cut.add_to(command);
  channels.add_to(command);
  add_flag(command, OptionId::kJson, json);
  add_option(command, OptionId::kMap, map);
  add_option(command, OptionId::kErrorRaster, error_raster);
  add_flag(command, OptionId::kOverwrite, overwrite);
  add_option(command, OptionId::kThreads, threads);
  memory.add_to(command);
  add_flag(command, OptionId::kQuiet, quiet);
  add_flag(command, OptionId::kJsonProgress, json_progress);
}

}  // namespace scarp::cli
