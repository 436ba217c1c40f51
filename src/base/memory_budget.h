// The memory limit of a run.
#pragma once

#include <cstdint>
#include <string_view>

#include "scarp/result.h"

namespace scarp {

/// The remedy that makes a mesh smaller, at the end of the sentence that refuses it. The runs of a search for a budget
/// know no budget, so the search puts its own words there.
inline constexpr std::string_view kLargerError = "a larger max error";

/// Bytes of the process, from the caller's options; without a limit nothing is refused.
struct MemoryBudget {
  std::uint64_t limit = 0;       ///< 0: none
  std::uint64_t taken = 0;       ///< part of it used by the caller: the program, the samples
  std::uint64_t per_vertex = 0;  ///< bytes of the mesh, at the moment of a run that needs most

  bool is_limited() const { return limit > 0; }
  std::uint64_t rest() const { return limit > taken ? limit - taken : 0; }
  /// At least one thread, at most `threads`, as many as a quarter of the rest holds at `bytes` each.
  int threads_within(std::uint64_t bytes, int threads) const;

  /// Fails with kMemory if the memory that a run uses whatever its mesh has no room for a small mesh.
  Result<void> check_start(std::uint64_t work) const;
  /// Fails with kMemory if `work` and so many vertices do not fit. `share`: of the run that is done, for what would be
  /// needed.
  Result<void> check_mesh(std::uint64_t work, std::uint64_t vertices, double share) const;
  /// Fails with kMemory if what has been found so far, in that share of the raster, does not fit. `what` it is, and
  /// what else to do.
  Result<void> check_part(std::uint64_t bytes, double share, const char* what, const char* advice) const;
};

}  // namespace scarp
