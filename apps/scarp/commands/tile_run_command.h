// scarp tile run: a share of a plan's blocks.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/values.h"

namespace scarp::cli {

class TileRunCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit TileRunCommand(CLI::App& program);
  TileRunCommand(const TileRunCommand&) = delete;
  TileRunCommand& operator=(const TileRunCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run() const;

 private:
  CLI::App* command_;
  std::string plan_;
  Given shard_, only_, parts_, memory_, threads_;
  bool quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
