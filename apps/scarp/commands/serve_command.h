// scarp serve: a set of tiles over HTTP, or the tiles of a raster as they are asked for.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "serve/tile_answers.h"
#include "session/options/tile_options.h"
#include "session/options/values.h"
#include "session/plan/tile_plan.h"

namespace scarp::cli {

class ServeCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit ServeCommand(CLI::App& program);
  ServeCommand(const ServeCommand&) = delete;
  ServeCommand& operator=(const ServeCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  /// Returns once a signal asks to stop.
  Result<void> run() const;

 private:
  struct Served {
    OpenedJob job;  ///< job of a raster or a plan
    LiveTileSet* live = nullptr;
    std::unique_ptr<TileAnswers> answers;
  };
  /// Fails where options are given that a finished set or a plan has decided.
  Result<void> check_alone() const;
  Result<Served> open(int threads) const;

  CLI::App* command_;
  TileArguments tiles_;
  Given port_, host_, memory_, threads_;
  bool quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
