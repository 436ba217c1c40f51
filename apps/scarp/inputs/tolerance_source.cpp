#include "inputs/tolerance_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "inputs/companions.h"
#include "options/memory.h"
#include "terminal/clock.h"

namespace scarp::cli {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

/// Rows of so many samples at a time.
int rows_of(int samples, int cols) { return std::max(1, samples / cols); }

/// Calls look(first row, values) for all rows of a raster, some at a time, from the top.
template <class Look>
Result<void> for_each_band(const HeightField& raster, const Look& look) {
  constexpr int kSamples = 1 << 18;
  const int most = rows_of(kSamples, raster.cols);
  std::vector<float> buffer;
  for (int row = 0; row < raster.rows;) {
    const int rows = std::min(most, raster.rows - row);
    const std::size_t size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(raster.cols);
    std::span<const float> values;
    if (raster.source != nullptr) {
      buffer.resize(size);
      if (auto read = raster.source->read(0, row, raster.cols, rows, buffer.data(), raster.cols); !read) return read;
      values = buffer;
    } else {
      values = {raster.samples + static_cast<std::ptrdiff_t>(row) * raster.cols, size};
    }
    if (Result<void> looked = look(row, values); !looked) return looked;
    row += rows;
  }
  return {};
}

/// Names the option that named a file which cannot be read.
tl::unexpected<Error> name_option(const char* option, Error error) {
  if (error.kind == ErrorKind::kInput) error.message = fmt::format("{}: {}", option, error.message);
  return tl::unexpected(std::move(error));
}

/// Of a raster that was opened.
class RasterBounds final : public SampleSource {
 public:
  RasterBounds(const char* option, OwnedHeightField values) : option_(option), values_(std::move(values)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    if (values_.source) {
      auto read = values_.source->read(col, row, cols, rows, out, stride);
      if (!read) return name_option(option_, std::move(read.error()));
    }
    const bool is_rounded = values_.sample_rounding > 0;
    for (int y = 0; y < rows; ++y) {
      float* to = out + y * stride;
      if (!values_.source) std::copy_n(&values_.samples[index(col, row + y)], cols, to);
      for (int x = 0; x < cols; ++x) to[x] = bound_of_value(to[x], is_rounded);
    }
    return {};
  }
  bool is_in_memory() const override { return !values_.source || values_.source->is_in_memory(); }

 private:
  std::size_t index(int col, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(values_.cols) + static_cast<std::size_t>(col);
  }
  const char* option_;
  OwnedHeightField values_;
};

class LeastBounds final : public SampleSource {
 public:
  LeastBounds(std::shared_ptr<const SampleSource> a, std::shared_ptr<const SampleSource> b)
      : a_(std::move(a)), b_(std::move(b)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    if (auto read = a_->read(col, row, cols, rows, out, stride); !read) return read;
    constexpr int kSamples = 1 << 14;
    const int most = std::min(rows_of(kSamples, cols), rows);
    std::vector<float> other(static_cast<std::size_t>(most) * static_cast<std::size_t>(cols));
    for (int first = 0; first < rows; first += most) {
      const int count = std::min(most, rows - first);
      if (auto read = b_->read(col, row + first, cols, count, other.data(), cols); !read) return read;
      for (int y = 0; y < count; ++y) {
        float* to = out + (first + y) * stride;
        const float* from = other.data() + static_cast<std::ptrdiff_t>(y) * cols;
        for (int x = 0; x < cols; ++x) to[x] = std::min(to[x], from[x]);
      }
    }
    return {};
  }
  bool is_in_memory() const override { return a_->is_in_memory() && b_->is_in_memory(); }

 private:
  std::shared_ptr<const SampleSource> a_, b_;
};

}  // namespace

float bound_of_value(float value, bool is_rounded) {
  if (std::isnan(value)) return kNone;
  return is_rounded ? std::nextafter(value, 0.0F) : value;  // not above the value in the file
}

tl::unexpected<Error> refuse_negative(const char* option, const std::string& path, float value, std::int64_t col,
                                      std::int64_t row) {
  return fail(ErrorKind::kInput,
              fmt::format("{} {}: the value {} at column {}, row {} is negative: it must be at least 0", option, path,
                          value, col, row));
}

Result<BoundsInWindows> open_tolerances(const char* option, const std::string& path, const RasterInfo& raster,
                                        const OwnedHeightField& heights, std::uint64_t limit,
                                        const ProgressCallback& progress, std::vector<std::string>& warnings) {
  ReadOptions options;
  options.crs = "grid";
  options.progress = progress;
  Result<OwnedHeightField> values = read_beside(path, options, limit);
  if (!values) return name_option(option, std::move(values.error()));
  const Result<void> fits =
      check_grid(raster, heights.cols, heights.rows, option, values->info, values->cols, values->rows);
  if (!fits) return tl::unexpected(fits.error());
  std::uint64_t valid = 0;
  bool is_negative = false;
  Clock::time_point last = Clock::now();
  const Result<void> seen = for_each_band(*values, [&](int row, std::span<const float> band) -> Result<void> {
    for (std::size_t k = 0; k < band.size(); ++k) {
      if (band[k] < 0) {
        const auto at = static_cast<std::int64_t>(k);
        is_negative = true;
        return refuse_negative(option, path, band[k], at % values->cols, row + at / values->cols);
      }
      valid += !std::isnan(band[k]);
    }
    constexpr double kSecondsBetween = 0.1;
    if (!progress || seconds_since(last) < kSecondsBetween) return {};
    last = Clock::now();
    Progress now;
    now.pass = "read";
    now.fraction = static_cast<double>(row) / values->rows;
    if (progress(now)) return {};
    return fail(ErrorKind::kCancelled, path + ": reading was cancelled");
  });
  if (is_negative) return tl::unexpected(seen.error());
  if (!seen) return name_option(option, seen.error());
  if (valid == 0)
    return fail(ErrorKind::kInput, fmt::format("{}: {}: none of its {} x {} samples has a value", option, path,
                                               values->cols, values->rows));
  warnings.insert(warnings.end(), values->info.warnings.begin(), values->info.warnings.end());
  BoundsInWindows bounds;
  bounds.bytes = bytes_beside(*values, heights, limit);
  bounds.may_lack = valid < static_cast<std::uint64_t>(values->cols) * static_cast<std::uint64_t>(values->rows);
  bounds.source = std::make_shared<RasterBounds>(option, std::move(*values));
  return bounds;
}

BoundsInWindows least_of(const BoundsInWindows& a, const BoundsInWindows& b) {
  return {std::make_shared<LeastBounds>(a.source, b.source), a.bytes + b.bytes, a.may_lack && b.may_lack};
}

}  // namespace scarp::cli
