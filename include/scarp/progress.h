// Progress and cancellation.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#pragma GCC visibility push(default)

namespace scarp {

/// A snapshot of a running pass.
struct Progress {
  std::string_view pass;  ///< "read", "refine", "fit", "search", "measure" or "topology"; valid during the call only
  double fraction = 0;    ///< 0..1 of this pass; an estimate that never decreases within a pass
  std::uint64_t vertices = 0;  ///< vertices so far; 0 where the pass does not count them
  double max_error = 0;        ///< current max error in z units; 0 where the pass does not know it
};

/// Called from the thread that called the library, a few times a second at most.
/// Return false to cancel: the call then ends with ErrorKind::kCancelled and no result.
using ProgressCallback = std::function<bool(const Progress&)>;

}  // namespace scarp

#pragma GCC visibility pop
