// scarp tile: a pyramid of terrain tiles.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/tile_options.h"
#include "session/options/values.h"

namespace scarp::cli {

class TileCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit TileCommand(CLI::App& program);
  TileCommand(const TileCommand&) = delete;
  TileCommand& operator=(const TileCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run(const std::string& command_line) const;

 private:
  CLI::App* command_;
  TileArguments tiles_;
  std::string output_;
  Given threads_, report_;
  bool overwrite_ = false, quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
