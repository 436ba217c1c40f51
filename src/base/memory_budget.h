// The memory limit of a run.
#pragma once

#include <cstdint>
#include <string_view>

#include "scarp/result.h"

namespace scarp {

/// The remedy at the end of an error message: it makes the mesh smaller. A budget search replaces this remedy, since
/// the runs of a search have no budget of their own.
inline constexpr std::string_view kLargerError = "a larger max error";

/// Memory of the process, from the caller's options. Without a limit, nothing is rejected.
struct MemoryBudget {
  std::uint64_t limit = 0;       ///< 0: none
  std::uint64_t taken = 0;       ///< bytes used by the caller: the program, the samples
  std::uint64_t per_vertex = 0;  ///< peak bytes of a run per vertex of the mesh

  bool is_limited() const { return limit > 0; }
  std::uint64_t rest() const { return limit > taken ? limit - taken : 0; }
  /// The number of threads, from 1 to `threads`, for which `bytes` each fit in a quarter of the remaining memory.
  int threads_within(std::uint64_t bytes, int threads) const;

  /// Fails with kMemory if a small mesh does not fit in addition to `work`, the memory that a run always uses.
  Result<void> check_start(std::uint64_t work) const;
  /// Fails with kMemory if `work` and `vertices` vertices do not fit. `share`: the finished fraction of the run, to
  /// extrapolate the requirement.
  Result<void> check_mesh(std::uint64_t work, std::uint64_t vertices, double share) const;
  /// Fails with kMemory if the `bytes` found so far, extrapolated from this share to the whole raster, do not fit.
  /// `what`: name of the data; `advice`: another remedy.
  Result<void> check_part(std::uint64_t bytes, double share, const char* what, const char* advice) const;
};

}  // namespace scarp
