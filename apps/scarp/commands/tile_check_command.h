// scarp tile check: what a finished set of tiles promises, proven.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scarp/tile_check.h"
#include "session/options/tile_options.h"
#include "session/options/values.h"
#include "session/plan/tile_plan.h"

namespace scarp::cli {

class TileCheckCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit TileCheckCommand(CLI::App& program);
  TileCheckCommand(const TileCheckCommand&) = delete;
  TileCheckCommand& operator=(const TileCheckCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run(const std::string& command_line) const;

 private:
  Result<OpenedJob> open_source(const TileSetReader& set, const TileGrid& of_set, const ProgressCallback& progress,
                                int threads) const;
  /// Fails for options of a raster where there is none, or a plan that has decided them.
  Result<void> check_unused() const;

  CLI::App* command_;
  TileArguments tiles_;  ///< options of the source
  std::string set_;
  Given source_, threads_;
  bool json_ = false, quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
