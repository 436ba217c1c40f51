// scarp info: what a raster holds, and which errors suit it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "options/options.h"

namespace scarp::cli {

class InfoCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit InfoCommand(CLI::App& program);
  InfoCommand(const InfoCommand&) = delete;
  InfoCommand& operator=(const InfoCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run(const std::string& command_line) const;

 private:
  CLI::App* command_;
  RasterArguments raster_;
  bool json_ = false, quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
