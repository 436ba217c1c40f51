// scarp measure: judge a mesh file against its raster.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scarp/result.h"
#include "session/options/measure_options.h"

namespace scarp::cli {

class MeasureCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit MeasureCommand(CLI::App& program);
  MeasureCommand(const MeasureCommand&) = delete;
  MeasureCommand& operator=(const MeasureCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  /// `command_line` is what the user typed, for the report.
  Result<void> run(const std::string& command_line) const;

 private:
  CLI::App* command_;
  MeasureArguments given_;
};

}  // namespace scarp::cli
