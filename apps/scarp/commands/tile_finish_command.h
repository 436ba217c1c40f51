// scarp tile finish: a set of tiles, of all parts of a plan.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/values.h"

namespace scarp::cli {

class TileFinishCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit TileFinishCommand(CLI::App& program);
  TileFinishCommand(const TileFinishCommand&) = delete;
  TileFinishCommand& operator=(const TileFinishCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run(const std::string& command_line) const;

 private:
  CLI::App* command_;
  std::string plan_, output_;
  Given parts_, report_, threads_;
  bool overwrite_ = false, quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
