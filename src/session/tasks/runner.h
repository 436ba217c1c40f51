// The caller of a command: the program in a terminal, or a user of the C library.
#pragma once

#include <functional>

#include "scarp/io.h"
#include "scarp/run.h"

namespace scarp::cli {

struct Runner {
  ProgressCallback progress;
  /// Polled by slow efforts after on_keeping(): true if the mesh so far is sufficient. May be empty.
  std::function<bool()> is_enough = {};
  /// Called once a mesh keeps the promise. May be empty.
  std::function<void()> on_keeping = {};
  /// May change the read options before inputs are read. May be empty.
  std::function<void(ReadOptions&)> on_plan = {};
};

}  // namespace scarp::cli
