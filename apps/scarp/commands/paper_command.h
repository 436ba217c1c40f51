// scarp paper: repeats the experiments of the 1995 paper.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/values.h"

namespace scarp::cli {

class PaperCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit PaperCommand(CLI::App& program);
  PaperCommand(const PaperCommand&) = delete;
  PaperCommand& operator=(const PaperCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run() const;

 private:
  CLI::App* command_;
  std::string data_, out_ = "bench";
  bool no_timing_ = false, overwrite_ = false, quiet_ = false;
};

}  // namespace scarp::cli
