#include "grid/bands.h"

#include <utility>

#include "base/function_ref.h"
#include "grid/samples.h"
#include "grid/source_failure.h"
#include "grid/window.h"

namespace scarp::grid {

namespace {

constexpr std::int32_t kRowsOfSweep = 64;
constexpr std::int32_t kSamplesTogether = 1 << 18;

}  // namespace

Band::Band(const HeightField& field, std::int32_t most)
    : Band(
          field.cols, field.rows,
          [&field](Point first, std::int32_t cols, std::int32_t rows, float* out) {
            return read_window(field, first.x, first.y, cols, rows, out, cols);
          },
          most) {}

Band::Band(std::int32_t cols, std::int32_t rows, Read read, std::int32_t most)
    : cols_(cols), rows_(rows), read_(std::move(read)) {
  held_.reserve(static_cast<std::size_t>(std::min(most, rows)) * static_cast<std::size_t>(cols));
}

Result<void> Band::load(std::int32_t first, std::int32_t count) {
  const std::ptrdiff_t cols = cols_;
  const std::int32_t from = std::max(first, first_), to = std::min(first + count, first_ + count_);
  const auto read = [&](std::int32_t row, std::int32_t rows) {
    return rows > 0 ? read_({0, row}, cols_, rows, held_.data() + (row - first) * cols) : Result<void>();
  };
  Result<void> done;
  if (to <= from) {
    held_.resize(static_cast<std::size_t>(count * cols));
    count_ = 0;
    done = read(first, count);
  } else {
    // Kept rows are moved while the buffer holds both ranges.
    held_.resize(static_cast<std::size_t>(std::max(count, count_) * cols));
    const auto begin = held_.begin() + (from - first_) * cols, end = held_.begin() + (to - first_) * cols;
    if (first < first_) {
      std::move_backward(begin, end, held_.begin() + (to - first) * cols);
    } else {
      std::move(begin, end, held_.begin() + (from - first) * cols);
    }
    held_.resize(static_cast<std::size_t>(count * cols));
    count_ = 0;
    done = read(first, from - first);
    if (done) done = read(to, first + count - to);
  }
  SCARP_RETURN_IF_ERROR(done);
  first_ = first;
  count_ = count;
  return {};
}

void Band::hold(std::int32_t first, std::int32_t count) {
  if (auto loaded = load(first, count); !loaded) throw SourceFailure{loaded.error()};
}

const float* Band::samples(std::int32_t x, std::int32_t y, std::int32_t count) const {
  if (holds(y)) return held_.data() + std::ptrdiff_t{y - first_} * cols_ + x;
  apart_.resize(static_cast<std::size_t>(count));
  if (auto read = read_({x, y}, count, 1, apart_.data()); !read) throw SourceFailure{read.error()};
  return apart_.data();
}

Result<void> sweep_rows(const HeightField& field, std::int32_t reach,
                        FunctionRef<Result<void>(const RowRange& range)> visit) {
  if (field.samples != nullptr) {
    SCARP_TRY(const auto& samples, Samples::of(field));
    return visit({samples.raster(), 0, 0, field.rows});
  }
  Band band(field, kRowsOfSweep + 2 * reach);
  for (std::int32_t begin = 0; begin < field.rows; begin += kRowsOfSweep) {
    const std::int32_t end = std::min(begin + kRowsOfSweep, field.rows);
    const std::int32_t first = std::max(begin - reach, 0);
    SCARP_RETURN_IF_ERROR(band.load(first, std::min(end + reach, field.rows) - first));
    SCARP_RETURN_IF_ERROR(visit({band.raster(), first, begin, end}));
  }
  return {};
}

std::uint64_t sweep_bytes(const HeightField& field, std::int32_t reach) {
  if (field.samples != nullptr) return 0;
  return sizeof(float) * static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(kRowsOfSweep + 2 * reach);
}

RowReader::RowReader(const HeightField& field)
    : field_(field), most_(std::clamp(kSamplesTogether / field.cols, 1, field.rows)), band_(field_, most_) {}

Result<float*> RowReader::read(std::int32_t row) {
  if (!band_.holds(row)) {
    band_.clear();  // rows that the caller changed are read again
    SCARP_RETURN_IF_ERROR(band_.load(row, std::min(most_, field_.rows - row)));
  }
  return band_.row(row);
}

}  // namespace scarp::grid
