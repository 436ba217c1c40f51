// Samples of one band.
//
// Problem: bands have a dozen types, with or without scale, and nodata declared in several ways. Memory suffices for
// only one copy of the samples. A damaged file must never appear as flat ground.
//
// Idea: GDAL reads types with only float32 values (8 and 16 bits, float32) directly into the samples. Other types are
// read in windows of doubles (64-bit integers: windows of their own type). In a window, nodata is compared, scale and
// offset are applied, and the distance to the nearest float32 is recorded. A bound on the samples, increased by this
// distance, also holds for the file.
#include "io/gdal/read_samples.h"

#include <cpl_string.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/int128.h"
#include "base/parallel.h"
#include "grid/height_range.h"
#include "io/gdal/windows.h"

namespace scarp::gdal {
namespace {

constexpr std::size_t kCodes = 65536;
constexpr float kNodataSample = std::numeric_limits<float>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<float>::max();

/// "−3.40282e+38" and similar texts mean the lowest float, however few digits remain; no terrain has such heights.
constexpr double kNearLargest = 3.4e38;

/// GDAL's rule, made robust: a sample is nodata if it equals the declared value, converted to the band's type.
template <class Raw>
class NodataTest {
 public:
  explicit NodataTest(std::optional<Raw> value) : has_value_(value.has_value()), value_(value.value_or(Raw{})) {
    if constexpr (std::is_floating_point_v<Raw>) {
      constexpr Raw kNever = std::numeric_limits<Raw>::quiet_NaN();
      const Raw near = static_cast<Raw>(kNearLargest);
      if (!has_value_) value_ = kNever;
      least_ = value_ >= near ? near : kNever;
      most_ = value_ <= -near ? -near : kNever;
    }
  }
  bool operator()(Raw raw) const {
    if constexpr (std::is_floating_point_v<Raw>) return (raw == value_) | (raw >= least_) | (raw <= most_);
    return has_value_ && raw == value_;
  }

 private:
  bool has_value_;
  Raw value_;
  Raw least_{}, most_{};  // large values beyond these are nodata, too
};

/// Converts nodata and non-finite values to kNodataSample. Returns the number of infinities. Branchless, for
/// vectorisation.
std::uint32_t mark_nodata(std::span<float> heights, const NodataTest<float>& is_nodata) {
  std::uint32_t infinities = 0;
  for (float& z : heights) {
    const bool is_missing = is_nodata(z), is_finite = std::abs(z) <= kLargest;
    infinities += static_cast<std::uint32_t>(!is_missing & !is_finite & (z == z));
    z = (is_missing | !is_finite) ? kNodataSample : z;
  }
  return infinities;
}

float to_float32(double value) { return std::abs(value) <= kLargest ? static_cast<float>(value) : kNodataSample; }

/// |raw − rounded|, exactly.
double distance(double raw, float rounded) { return std::abs(raw - static_cast<double>(rounded)); }
template <class Integer>
requires std::is_integral_v<Integer>
double distance(Integer raw, float rounded) {
  const Int128 difference = static_cast<Int128>(raw) - static_cast<Int128>(rounded);
  return static_cast<double>(difference < 0 ? -difference : difference);
}

/// Bound on the error of GDAL's mean of `counted` valid cells. GDAL adds float32 values and stores a float32, for any
/// requested type. Sums of integer cells are exact. If mean · cells is an integer, so is mean · cells · counted. This
/// product differs from sum · cells by less than 1, so both are equal, and the mean is exact.
double rounding_of_mean(double mean, const Means& means) {
  if (means.cells == 1 || !std::isfinite(mean) || mean == 0) return 0;
  const double half_step = std::ldexp(1.0, std::ilogb(mean) - 24), cells = means.cells;
  if (!means.are_whole) return 4 * half_step;  // rounding of the cells, of their sum, of the mean
  const bool is_exact = cells * cells * half_step < 1 && std::floor(mean * cells) == mean * cells;
  return is_exact ? 0 : half_step;
}

bool is_scaled(const BandSense& sense) { return sense.scale != 1 || sense.offset != 0; }

class BandReader : public WindowReader {
 public:
  explicit BandReader(const BandSense& sense) : sense_(sense) {}

  bool read(const Window& window, float* out, std::ptrdiff_t stride) override {
    out_ = out;
    stride_ = stride;
    bool done = false;
    if (sense_.type == GDT_Int64) {
      done = read_converted<std::int64_t>(window, GDT_Int64, NodataTest<std::int64_t>(sense_.nodata_int64));
    } else if (sense_.type == GDT_UInt64) {
      done = read_converted<std::uint64_t>(window, GDT_UInt64, NodataTest<std::uint64_t>(sense_.nodata_uint64));
    } else if (is_float32(sense_)) {
      done = read_direct(window);
    } else {
      done = read_converted<double>(window, GDT_Float64, NodataTest<double>(nodata_in_double()));
    }
    return done && apply_mask(window);
  }

  /// The height of a raw band value.
  float height_of(double raw) { return convert(raw, NodataTest<double>(nodata_in_double())); }

 private:
  float* row_of(int row) const { return out_ + row * stride_; }

  bool read_direct(const Window& window) {
    const GSpacing line = static_cast<GSpacing>(stride_) * static_cast<GSpacing>(sizeof(float));
    if (GDALRasterIOEx(sense_.band, GF_Read, window.col, window.row, window.cols, window.rows, out_, window.cols,
                       window.rows, GDT_Float32, sizeof(float), line, nullptr) != CE_None) {
      return false;
    }
    const NodataTest<float> is_nodata(narrowed_nodata());
    for (int row = 0; row < window.rows; ++row) {
      const std::span<float> heights(row_of(row), static_cast<std::size_t>(window.cols));
      if (sense_.signed_byte) {
        for (float& z : heights) z = z > 127 ? z - 256 : z;
      }
      findings_.infinities += mark_nodata(heights, is_nodata);
      if (sense_.means.cells <= 1) continue;
      for (const float z : heights) {
        if (!std::isnan(z)) findings_.rounding = std::max(findings_.rounding, rounding_of_mean(z, sense_.means));
      }
    }
    return true;
  }

  /// The declared value in the band's type; nothing if the type cannot represent it.
  std::optional<float> narrowed_nodata() const {
    if (!sense_.nodata) return {};
    const double nodata = *sense_.nodata;
    if (sense_.type != GDT_Float32) {
      return std::abs(nodata) <= 65535 && std::floor(nodata) == nodata ? std::optional(static_cast<float>(nodata))
                                                                       : std::nullopt;
    }
    if (std::isnan(nodata)) return {};
    return static_cast<float>(std::clamp(nodata, -kLargest, kLargest));
  }

  std::optional<double> nodata_in_double() const {
    if (sense_.type == GDT_Float32) return narrowed_nodata();
    return sense_.nodata;
  }

  template <class Raw>
  bool read_converted(const Window& window, GDALDataType type, const NodataTest<Raw>& is_nodata) {
    const auto count = static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows);
    buffer_.resize(count * sizeof(Raw));
    auto* raw = reinterpret_cast<Raw*>(buffer_.data());
    if (GDALRasterIOEx(sense_.band, GF_Read, window.col, window.row, window.cols, window.rows, raw, window.cols,
                       window.rows, type, 0, 0, nullptr) != CE_None) {
      return false;
    }
    for (int row = 0; row < window.rows; ++row) {
      float* z = row_of(row);
      for (int col = 0; col < window.cols; ++col, ++raw) {
        const std::uint64_t before = findings_.infinities;
        z[col] = convert(*raw, is_nodata);
        if (findings_.infinities == before || findings_.beyond) continue;
        const double value = static_cast<double>(*raw);
        if (std::isfinite(value)) findings_.beyond = {value, window.col + col, window.row + row};
      }
    }
    return true;
  }

  template <class Raw>
  float convert(Raw raw, const NodataTest<Raw>& is_nodata) {
    if (sense_.signed_byte && raw > 127) raw -= 256;
    if (is_nodata(raw)) return kNodataSample;
    double value = static_cast<double>(raw);
    if (std::isnan(value)) return kNodataSample;
    if (is_scaled(sense_)) value = value * sense_.scale + sense_.offset;
    const float z = to_float32(value);
    if (std::isnan(z)) {
      ++findings_.infinities;
      return kNodataSample;
    }
    const double mean = rounding_of_mean(static_cast<double>(raw), sense_.means) * std::abs(sense_.scale);
    const double moved = is_scaled(sense_) || std::is_floating_point_v<Raw> ? distance(value, z) : distance(raw, z);
    findings_.rounding = std::max(findings_.rounding, moved + mean);
    return z;
  }

  bool apply_mask(const Window& window) {
    if (sense_.mask == nullptr) return true;
    const auto count = static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows);
    mask_.resize(count);
    if (GDALRasterIOEx(sense_.mask, GF_Read, window.col, window.row, window.cols, window.rows, mask_.data(),
                       window.cols, window.rows, GDT_Byte, 0, 0, nullptr) != CE_None) {
      return false;
    }
    const std::uint8_t* shown = mask_.data();
    for (int row = 0; row < window.rows; ++row) {
      float* z = row_of(row);
      for (int col = 0; col < window.cols; ++col, ++shown) {
        if (*shown == 0) z[col] = kNodataSample;
      }
    }
    return true;
  }

  const BandSense sense_;
  float* out_ = nullptr;
  std::ptrdiff_t stride_ = 0;
  std::vector<unsigned char> buffer_;  // window buffer, of the type that is read
  std::vector<std::uint8_t> mask_;
};

bool read_into(WindowReader& reader, const Window& window, OwnedHeightField& field) {
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(window.row) * field.cols + window.col;
  return reader.read(window, field.samples.data() + first, field.cols);
}

}  // namespace

bool is_float32(const BandSense& sense) {
  const GDALDataType type = sense.type;
  return !is_scaled(sense) && (type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Float32);
}

std::unique_ptr<WindowReader> make_band_reader(const BandSense& sense) { return std::make_unique<BandReader>(sense); }

Result<Findings> read_windows(Session& session, GDALRasterBandH band, WindowReader& reader, const OpenAgain& open_again,
                              const ReadOptions& options, OwnedHeightField& field) {
  const Extent extent{field.info.path, field.cols, field.rows};
  const WindowOrder order(band, field.cols, field.rows);
  const std::size_t most =
      std::min({static_cast<std::size_t>(thread_count(options.run.threads)), order.count(), order.most_at_once()});
  std::vector<ReadHandle> more;
  while (open_again && more.size() + 1 < most) {
    auto handle = open_again();
    if (!handle) break;
    more.push_back(std::move(*handle));
  }
  struct Stack {
    Result<void> status;
    Findings findings;
    std::vector<std::string> warnings;
  };
  std::vector<Stack> stacks(order.count());
  ReadProgress progress(extent, options.run.progress);
  Result<void> done;
  Findings findings;
  parallel_in_order(
      order.count(), static_cast<int>(more.size() + 1),
      [&](std::size_t i, std::size_t worker) {
        // GDAL stores messages per thread
        Session here(session);
        WindowReader& reads = worker == 0 ? reader : *more[worker - 1].reader;
        stacks[i].status = for_each_slice(order.stack(i), order.rows_at_once(), [&](const Window& window) {
          return read_or_explain(here, window, extent.path,
                                 [&](const Window& part) { return read_into(reads, part, field); });
        });
        stacks[i].findings = reads.take_findings();
        stacks[i].warnings = here.warnings();
      },
      [&](std::size_t i) {
        const Stack stack = std::exchange(stacks[i], {});
        for (const std::string& warning : stack.warnings) session.note(false, false, warning.c_str());
        findings.add(stack.findings);
        done = stack.status;
        if (done) done = progress.add(order.stack(i));
        return done.has_value();
      });
  SCARP_RETURN_IF_ERROR(done);
  field.sample_rounding = findings.rounding;
  return findings;
}

Result<void> read_bands(Session& session, std::span<const BandSense> bands, const ReadOptions& options,
                        std::span<OwnedHeightField> fields, std::uint64_t& infinities) {
  std::vector<BandReader> readers(bands.begin(), bands.end());
  const Extent extent{fields[0].info.path, fields[0].cols, fields[0].rows};
  auto done = for_each_window(session, bands[0].band, extent, options.run.progress, [&](const Window& window) {
    bool all = true;
    for (std::size_t k = 0; all && k < readers.size(); ++k) all = read_into(readers[k], window, fields[k]);
    return all;
  });
  for (std::size_t k = 0; k < readers.size(); ++k) {
    fields[k].sample_rounding = readers[k].findings().rounding;
    infinities += readers[k].findings().infinities;
  }
  return done;
}

bool has_codes(const BandSense& sense) {
  const bool is_16_bit = sense.type == GDT_Byte || sense.type == GDT_Int16 || sense.type == GDT_UInt16;
  return is_16_bit && sense.mask == nullptr;
}

Result<void> read_codes(Session& session, const BandSense& sense, const ReadOptions& options, OwnedHeightField& field,
                        std::uint64_t& infinities) {
  const auto cols = static_cast<std::size_t>(field.cols);
  std::vector<std::uint16_t> codes;
  try {
    codes.resize(cols * static_cast<std::size_t>(field.rows));
  } catch (const std::exception&) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: the machine refuses the memory that {} x {} samples of 16 bits need", field.info.path,
                            field.cols, field.rows));
  }
  const GDALDataType type = sense.type == GDT_Int16 ? GDT_Int16 : GDT_UInt16;
  std::vector<std::uint64_t> counts(kCodes);
  const auto read = [&](const Window& window) {
    std::uint16_t* first = codes.data() + static_cast<std::size_t>(window.row) * cols + window.col;
    return GDALRasterIOEx(sense.band, GF_Read, window.col, window.row, window.cols, window.rows, first, window.cols,
                          window.rows, type, sizeof(std::uint16_t), static_cast<GSpacing>(cols * sizeof(std::uint16_t)),
                          nullptr) == CE_None;
  };
  const Extent extent{field.info.path, field.cols, field.rows};
  SCARP_RETURN_IF_ERROR(for_each_window(session, sense.band, extent, options.run.progress, read));
  for (const std::uint16_t code : codes) ++counts[code];

  BandReader reader(sense);
  HeightRange range;
  std::vector<float> heights(kCodes, kNodataSample);
  for (std::size_t code = 0; code < kCodes; ++code) {
    if (counts[code] == 0) continue;
    const std::uint64_t infinities_before = reader.findings().infinities;
    const auto bits = static_cast<std::uint16_t>(code);
    const float z = reader.height_of(type == GDT_Int16 ? static_cast<std::int16_t>(bits) : bits);
    infinities += counts[code] * (reader.findings().infinities - infinities_before);
    if (std::isnan(z)) continue;
    heights[code] = z;
    HeightRange here{counts[code], z, z};
    here.lowest[0] = here.highest[0] = {z, counts[code]};
    range.add(here);
  }
  grid::set_range(range, field.info);
  field.sample_rounding = reader.findings().rounding;
  field.source = make_coded_source(std::move(codes), field.cols, std::move(heights));
  return {};
}

}  // namespace scarp::gdal
