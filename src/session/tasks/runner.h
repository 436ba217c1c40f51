// The caller of a command: the program in a terminal, or a user of the C library.
#pragma once

#include <functional>

#include "scarp/io.h"
#include "scarp/run.h"

namespace scarp::cli {

struct Runner {
  ProgressCallback progress;
  /// Slow efforts call it after on_keeping(). True if the present mesh is sufficient. May be empty.
  std::function<bool()> is_enough = {};
  /// Called as soon as a mesh satisfies the bound. May be empty.
  std::function<void()> on_keeping = {};
  /// May change the read options before inputs are read. May be empty.
  std::function<void(ReadOptions&)> on_plan = {};
};

}  // namespace scarp::cli
