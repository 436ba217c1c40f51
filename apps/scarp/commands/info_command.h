// scarp info: what a raster, points or a mesh hold, and which errors suit a raster.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/raster_options.h"
#include "session/options/values.h"

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
  Given layer_, z_field_, columns_;
  bool points_ = false, no_suggest_ = false, json_ = false, quiet_ = false, json_progress_ = false;

  Result<void> run_points(const std::string& command_line) const;
  Result<void> run_mesh(const std::string& format, const std::string& command_line) const;
  /// Fails if an option was given that what the file holds has no use for.
  Result<void> refuse(const char* kind, bool takes_crs) const;
};

}  // namespace scarp::cli
