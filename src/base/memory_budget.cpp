#include "base/memory_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scarp {

namespace {

constexpr std::uint64_t kSmallMesh = 1000;  // vertices

/// In whole megabytes, rounded up.
std::uint64_t megabytes(double bytes) { return static_cast<std::uint64_t>(std::ceil(bytes / 1e6)); }

}  // namespace

int MemoryBudget::threads_within(std::uint64_t bytes, int threads) const {
  if (!is_limited()) return threads;
  const std::uint64_t most = rest() / 4 / std::max<std::uint64_t>(1, bytes);
  return static_cast<int>(std::clamp<std::uint64_t>(most, 1, static_cast<std::uint64_t>(threads)));
}

Result<void> MemoryBudget::check_start(std::uint64_t work) const {
  const std::uint64_t needed = work + kSmallMesh * per_vertex;
  if (!is_limited() || needed <= rest()) return {};
  return fail(ErrorKind::kMemory,
              fmt::format("the memory limit is too little: {}M are needed before the mesh has a thousand "
                          "vertices; allow that much and what the mesh needs",
                          megabytes(static_cast<double>(taken + needed))));
}

Result<void> MemoryBudget::check_mesh(std::uint64_t work, std::uint64_t vertices, double share) const {
  if (!is_limited() || work + vertices * per_vertex <= rest()) return {};
  const double whole = static_cast<double>(vertices) / std::clamp(share, 1e-6, 1.0);
  // Adds a quarter, since the rest may be rougher than the finished part.
  const double needed = static_cast<double>(taken + work) + 1.25 * whole * static_cast<double>(per_vertex);
  return fail(
      ErrorKind::kMemory,
      fmt::format("the memory limit is too little: the mesh has {} vertices when {:.0f} % of the run is done, and "
                  "the whole would need about {}M; allow that much, or {}",
                  vertices, 100 * share, megabytes(needed), kLargerError));
}

Result<void> MemoryBudget::check_part(std::uint64_t bytes, double share, const char* what, const char* advice) const {
  if (!is_limited() || bytes <= rest()) return {};
  const double needed = static_cast<double>(taken) + 1.25 * static_cast<double>(bytes) / std::clamp(share, 1e-6, 1.0);
  return fail(ErrorKind::kMemory,
              fmt::format("the memory limit is too little: {} take {}M when {:.0f} % of the raster is seen, and the whole "
                          "would need about {}M; allow that much, or {}",
                          what, megabytes(static_cast<double>(bytes)), 100 * share, megabytes(needed), advice));
}

}  // namespace scarp
