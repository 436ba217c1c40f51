// scarp simplify: one raster to one mesh.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "commands/points_command.h"
#include "session/options/points_options.h"
#include "session/options/simplify_options.h"

namespace scarp::cli {

class SimplifyCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit SimplifyCommand(CLI::App& program);
  SimplifyCommand(const SimplifyCommand&) = delete;
  SimplifyCommand& operator=(const SimplifyCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  /// `command_line` is what the user typed, for the report.
  Result<void> run(const std::string& command_line) const;

 private:
  CLI::App* command_;
  SimplifyArguments given_;
  PointsArguments points_;
};

}  // namespace scarp::cli
