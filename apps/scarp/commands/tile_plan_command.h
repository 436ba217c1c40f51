// scarp tile plan: a job of tiles that many processes share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/tile_options.h"
#include "session/options/values.h"
#include "session/plan/tile_plan.h"

namespace scarp::cli {

class TilePlanCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit TilePlanCommand(CLI::App& program);
  TilePlanCommand(const TilePlanCommand&) = delete;
  TilePlanCommand& operator=(const TilePlanCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run() const;

 private:
  Result<OpenedJob> open(const ProgressCallback& progress) const;
  /// By --changed-since.
  Result<OpenedJob> follow(const ProgressCallback& progress) const;

  CLI::App* command_;
  TileArguments tiles_;
  std::string plan_;
  Given slurm_, shards_, changed_since_, hash_;
  bool survey_ = false, overwrite_ = false, quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
