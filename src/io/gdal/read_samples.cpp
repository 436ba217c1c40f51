// Samples of one band.
//
// Problem: bands come in a dozen types, scaled or not, with nodata declared in more than one way; memory for one copy
// of the samples only; and a damaged file must never look like flat ground.
//
// Idea: types whose every value is a float32 (8 and 16 bits, float32) are read by GDAL straight into the samples. All
// others go through a window in double (64-bit integers: in their own type), where nodata is compared, scale and offset
// are applied, and the distance to the nearest float32 is recorded: what the mesh promises about these samples it then
// promises about the file with that much in reserve.
#include "io/gdal/read_samples.h"

#include <cpl_string.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/int128.h"
#include "io/gdal/windows.h"

namespace scarp::gdal {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<float>::max();

/// "−3.40282e+38" and its like stand for the lowest float however few digits survived, and no terrain is that high.
constexpr double kNearLargest = 3.4e38;

/// GDAL's rule, made safe: equal once the declared value has the band's type.
template <class Raw>
class NodataTest {
 public:
  explicit NodataTest(std::optional<Raw> value) : value_(value) {}
  bool operator()(Raw raw) const {
    if (!value_) return false;
    if (raw == *value_) return true;
    if constexpr (std::is_floating_point_v<Raw>) {
      const Raw near = static_cast<Raw>(kNearLargest);
      return std::abs(*value_) >= near && std::abs(raw) >= near && std::signbit(raw) == std::signbit(*value_);
    }
    return false;
  }

 private:
  std::optional<Raw> value_;
};

float to_float32(double value) { return std::abs(value) <= kLargest ? static_cast<float>(value) : kVoid; }

/// |raw − rounded|, without error of its own.
double distance(double raw, float rounded) { return std::abs(raw - static_cast<double>(rounded)); }
template <class Integer>
requires std::is_integral_v<Integer>
double distance(Integer raw, float rounded) {
  const Int128 difference = static_cast<Int128>(raw) - static_cast<Int128>(rounded);
  return static_cast<double>(difference < 0 ? -difference : difference);
}

class BandReader {
 public:
  BandReader(const BandPlan& plan, OwnedHeightField& field, std::uint64_t& infinities)
      : plan_(plan), field_(field), infinities_(infinities) {}

  bool read(const Window& window) {
    bool done = false;
    if (plan_.type == GDT_Int64) {
      done = read_converted<std::int64_t>(window, GDT_Int64, NodataTest<std::int64_t>(plan_.nodata_int64));
    } else if (plan_.type == GDT_UInt64) {
      done = read_converted<std::uint64_t>(window, GDT_UInt64, NodataTest<std::uint64_t>(plan_.nodata_uint64));
    } else if (is_direct()) {
      done = read_direct(window);
    } else {
      done = read_converted<double>(window, GDT_Float64, NodataTest<double>(plan_.nodata));
    }
    return done && apply_mask(window);
  }

 private:
  bool is_scaled() const { return plan_.scale != 1 || plan_.offset != 0; }
  bool is_direct() const {
    const GDALDataType type = plan_.type;
    return !is_scaled() && (type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Float32);
  }

  float* row_of(const Window& window, int row) {
    return field_.samples.data() + static_cast<std::size_t>(window.row + row) * static_cast<std::size_t>(field_.cols) +
           window.col;
  }

  bool read_direct(const Window& window) {
    const GSpacing line = static_cast<GSpacing>(field_.cols) * static_cast<GSpacing>(sizeof(float));
    if (GDALRasterIOEx(plan_.band, GF_Read, window.col, window.row, window.cols, window.rows, row_of(window, 0),
                       window.cols, window.rows, GDT_Float32, sizeof(float), line, nullptr) != CE_None) {
      return false;
    }
    const NodataTest<float> is_nodata(narrowed_nodata());
    for (int row = 0; row < window.rows; ++row) {
      float* z = row_of(window, row);
      for (int col = 0; col < window.cols; ++col) {
        if (plan_.signed_byte && z[col] > 127) z[col] -= 256;
        if (is_nodata(z[col]) || std::isnan(z[col])) {
          z[col] = kVoid;
        } else if (std::isinf(z[col])) {
          z[col] = kVoid;
          ++infinities_;
        }
      }
    }
    return true;
  }

  /// The declared value as the band would hold it; nothing where the band cannot hold it.
  std::optional<float> narrowed_nodata() const {
    if (!plan_.nodata) return {};
    const double nodata = *plan_.nodata;
    if (plan_.type != GDT_Float32) {
      return std::abs(nodata) <= 65535 && std::floor(nodata) == nodata ? std::optional(static_cast<float>(nodata))
                                                                       : std::nullopt;
    }
    if (std::isnan(nodata)) return {};
    return static_cast<float>(std::clamp(nodata, -kLargest, kLargest));
  }

  template <class Raw>
  bool read_converted(const Window& window, GDALDataType type, const NodataTest<Raw>& is_nodata) {
    const auto count = static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows);
    buffer_.resize(count * sizeof(Raw));
    auto* raw = reinterpret_cast<Raw*>(buffer_.data());
    if (GDALRasterIOEx(plan_.band, GF_Read, window.col, window.row, window.cols, window.rows, raw, window.cols,
                       window.rows, type, 0, 0, nullptr) != CE_None) {
      return false;
    }
    for (int row = 0; row < window.rows; ++row) {
      float* z = row_of(window, row);
      for (int col = 0; col < window.cols; ++col, ++raw) {
        z[col] = convert(*raw, is_nodata);
      }
    }
    return true;
  }

  template <class Raw>
  float convert(Raw raw, const NodataTest<Raw>& is_nodata) {
    if (plan_.signed_byte && raw > 127) raw -= 256;
    if (is_nodata(raw)) return kVoid;
    double value = static_cast<double>(raw);
    if (std::isnan(value)) return kVoid;
    if (is_scaled()) value = value * plan_.scale + plan_.offset;
    const float z = to_float32(value);
    if (std::isnan(z)) {
      ++infinities_;
      return kVoid;
    }
    const double moved = is_scaled() || std::is_floating_point_v<Raw> ? distance(value, z) : distance(raw, z);
    if (moved > field_.sample_rounding) field_.sample_rounding = moved;
    return z;
  }

  bool apply_mask(const Window& window) {
    if (plan_.mask == nullptr) return true;
    const auto count = static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows);
    mask_.resize(count);
    if (GDALRasterIOEx(plan_.mask, GF_Read, window.col, window.row, window.cols, window.rows, mask_.data(), window.cols,
                       window.rows, GDT_Byte, 0, 0, nullptr) != CE_None) {
      return false;
    }
    const std::uint8_t* shown = mask_.data();
    for (int row = 0; row < window.rows; ++row) {
      float* z = row_of(window, row);
      for (int col = 0; col < window.cols; ++col, ++shown) {
        if (*shown == 0) z[col] = kVoid;
      }
    }
    return true;
  }

  const BandPlan& plan_;
  OwnedHeightField& field_;
  std::uint64_t& infinities_;
  std::vector<unsigned char> buffer_;  // of whatever type the window is read in
  std::vector<std::uint8_t> mask_;
};

}  // namespace

Result<void> read_band(Session& session, const BandPlan& plan, const ReadOptions& options, OwnedHeightField& field,
                       std::uint64_t& infinities) {
  return read_bands(session, {&plan, 1}, options, {&field, 1}, infinities);
}

Result<void> read_bands(Session& session, std::span<const BandPlan> plans, const ReadOptions& options,
                        std::span<OwnedHeightField> fields, std::uint64_t& infinities) {
  std::vector<BandReader> readers;
  readers.reserve(plans.size());
  for (std::size_t k = 0; k < plans.size(); ++k) readers.emplace_back(plans[k], fields[k], infinities);
  return for_each_window(session, plans[0].band, fields[0], options.progress, [&](const Window& window) {
    return std::all_of(readers.begin(), readers.end(), [&](BandReader& reader) { return reader.read(window); });
  });
}

}  // namespace scarp::gdal
