#include "pieces/source_windows.h"

#include <algorithm>
#include <cmath>

#include "grid/source_failure.h"
#include "grid/window.h"

namespace scarp::pieces {

namespace {

constexpr std::int32_t kMostRows = 2048, kFewestRows = 16;
constexpr std::int64_t kLeastWindow = 256 * 256;
constexpr int kSidesPerWindow = 2;  ///< triangles reach beyond the square that holds their centres

std::uint64_t bytes_per_sample(bool has_bounds) { return (has_bounds ? 2 : 1) * sizeof(float); }

}  // namespace

std::int32_t rows_at_once(const HeightField& field, const MemoryBudget& memory, const metric::SourceBounds* bounds) {
  std::int32_t rows = kMostRows;
  const auto bytes = [&] {
    return bytes_per_sample(bounds != nullptr) * static_cast<std::uint64_t>(field.cols) * static_cast<unsigned>(rows);
  };
  while (memory.is_limited() && rows > kFewestRows && bytes() > memory.rest() / 4) rows /= 2;
  return rows;
}

std::uint64_t bytes_at_once(const HeightField& field, const MemoryBudget& memory, const metric::SourceBounds* bounds) {
  const std::int32_t rows = std::min(rows_at_once(field, memory, bounds), field.rows);
  return bytes_per_sample(bounds != nullptr) * static_cast<std::uint64_t>(field.cols) *
         static_cast<std::uint64_t>(rows);
}

void read_windows(const HeightField& field, const MemoryBudget& memory, fit::FitOptions& options,
                  const metric::SourceBounds* bounds) {
  options.read = [&field](const fit::Patch::Window& window, float* to, std::ptrdiff_t stride) {
    const auto read = grid::read_window(field, window.first.x, window.first.y, window.cols, window.rows, to, stride);
    if (!read) throw grid::SourceFailure{read.error()};
  };
  if (bounds != nullptr)
    options.read_bounds = [bounds](const fit::Patch::Window& window, float* to, std::ptrdiff_t stride) {
      const auto read = bounds->read_aims(window.first, window.cols, window.rows, to, stride);
      if (!read) throw grid::SourceFailure{read.error()};
    };
  if (!memory.is_limited()) return;
  options.most_window =
      std::max(static_cast<std::int64_t>(memory.rest() / 4 / bytes_per_sample(bounds != nullptr)), kLeastWindow);
  options.most_side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(options.most_window))) / kSidesPerWindow;
}

std::uint64_t window_bytes(const fit::FitOptions& options) {
  return bytes_per_sample(options.read_bounds != nullptr) * static_cast<std::uint64_t>(options.most_window);
}

}  // namespace scarp::pieces
