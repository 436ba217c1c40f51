// scarp serve: a set of tiles over HTTP.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "options/options.h"

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
  CLI::App* command_;
  std::string input_;
  Given port_, host_;
  bool quiet_ = false;
};

}  // namespace scarp::cli
