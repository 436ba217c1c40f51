// Who runs a command: the program in a terminal, or a caller of the library's C door.
#pragma once

#include <functional>

#include "scarp/io.h"
#include "scarp/run.h"

namespace scarp::cli {

struct Runner {
  ProgressCallback progress;
  /// Polled by slow efforts, once on_keeping() was called: true if the mesh so far will do. May be empty.
  std::function<bool()> is_enough = {};
  /// From now on there is a mesh that keeps the promise. May be empty.
  std::function<void()> on_keeping = {};
  /// May change how inputs are read, before they are. May be empty.
  std::function<void(ReadOptions&)> on_plan = {};
};

}  // namespace scarp::cli
