#include "grid/row_sweep.h"

#include <algorithm>
#include <vector>

#include "grid/samples.h"
#include "grid/window.h"

namespace scarp {

namespace {

constexpr std::int32_t kRowsAtOnce = 64;

}  // namespace

Result<void> sweep_rows(const HeightField& field, std::int32_t reach,
                        const std::function<Result<void>(const RowStrip& strip)>& visit) {
  if (field.samples != nullptr) {
    const auto samples = Samples::of(field);
    if (!samples) return tl::unexpected(samples.error());
    return visit({samples->raster(), 0, 0, field.rows});
  }
  const auto cols = static_cast<std::size_t>(field.cols);
  std::vector<float> heights(cols * static_cast<std::size_t>(kRowsAtOnce + 2 * reach));
  std::int32_t first = 0, read = 0;  // rows [first, read) are there
  for (std::int32_t begin = 0; begin < field.rows; begin += kRowsAtOnce) {
    const std::int32_t end = std::min(begin + kRowsAtOnce, field.rows);
    const std::int32_t from = std::max(begin - reach, 0), to = std::min(end + reach, field.rows);
    const auto at = [&](std::int32_t row) { return heights.data() + static_cast<std::ptrdiff_t>(row) * field.cols; };
    std::copy(at(from - first), at(read - first), heights.data());
    first = from;
    if (to > read) {
      if (auto got = read_window(field, 0, read, field.cols, to - read, at(read - first), field.cols); !got) return got;
      read = to;
    }
    if (auto seen = visit({{heights.data(), field.cols, read - first}, first, begin, end}); !seen) return seen;
  }
  return {};
}

std::uint64_t sweep_bytes(const HeightField& field, std::int32_t reach) {
  if (field.samples != nullptr) return 0;
  return sizeof(float) * static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(kRowsAtOnce + 2 * reach);
}

}  // namespace scarp
