// scarp generate: synthetic height fields as rasters.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "session/options/values.h"

namespace scarp::cli {

class GenerateCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit GenerateCommand(CLI::App& program);
  GenerateCommand(const GenerateCommand&) = delete;
  GenerateCommand& operator=(const GenerateCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run() const;

 private:
  CLI::App* command_;
  std::string style_, cols_, rows_, output_;
  Given seed_, range_, size_, format_;
  bool overwrite_ = false, quiet_ = false;
};

}  // namespace scarp::cli
