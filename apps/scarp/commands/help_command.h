// scarp help: what a command and its options do.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "scarp/result.h"

namespace scarp::cli {

class HelpCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit HelpCommand(CLI::App& program);
  HelpCommand(const HelpCommand&) = delete;
  HelpCommand& operator=(const HelpCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run() const;

 private:
  CLI::App* command_;
  std::optional<std::string> about_;
  bool json_ = false, all_ = false;
};

}  // namespace scarp::cli
