// Heights that are probably undeclared nodata: outliers too far from all others to be land.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scarp/height_field.h"

namespace scarp {

namespace {

using RareEnds = std::array<HeightCount, HeightRange::kEnds>;

/// Values that software writes for unknown heights.
constexpr std::array kSigns{-999.0,   -10000.0, -32768.0, -9999.0,  -99999.0, -999999.0, -32767.0,
                            -65535.0, 9999.0,   99999.0,  999999.0, 32767.0,  65535.0,   0.0};

struct Scale {
  double scale = 1, offset = 0;

  /// The file value of a height that was rounded to float32: an integer if possible, as nodata values are.
  double value_of(double height) const {
    if (scale == 1 && offset == 0) return height;
    const double value = (height - offset) / scale;
    const double off = 2 * std::abs(height) * std::numeric_limits<float>::epsilon() / std::abs(scale);
    return std::abs(value - std::round(value)) <= off ? std::round(value) : value;
  }
};

bool is_usual_sign(double value) {
  constexpr double kBeyond = 1e20;
  return std::abs(value) >= kBeyond || (value != 0 && std::find(kSigns.begin(), kSigns.end(), value) != kSigns.end());
}

/// True if a height is far from the others, which start at a distance of `gap` and span `range`. `are_many`: this end
/// has many other heights compared with the far ones.
bool is_far(const HeightCount& here, double value, double gap, double range, std::uint64_t valid, bool are_many) {
  constexpr double kOfSigns = 0.2, kOfZero = 0.05, kLeastOfZero = 10, kOfAny = 50;
  constexpr std::uint64_t kShareOfZero = 1000, kShareOfAny = 100, kLeastOfWhole = 10;
  if (is_usual_sign(value) && gap >= kOfSigns * range) return true;
  if (range == 0) return false;  // two heights, neither exceptional
  if (value == 0 && gap >= kLeastOfZero && gap >= kOfZero * range && here.samples >= valid / kShareOfZero) return true;
  const bool is_block = value == std::round(value) && here.samples >= std::max(kLeastOfWhole, valid / kShareOfZero) &&
                        here.samples <= valid / 2;
  if (are_many && is_block && gap >= range) return true;
  return gap >= kOfAny * range && here.samples <= valid / kShareOfAny;
}

/// Number of heights at one end, from the outermost inwards, that are far from all others, which extend to `other`.
std::size_t count_far(const RareEnds& ends, std::size_t first, double other, std::uint64_t valid, const Scale& scale) {
  for (std::size_t next = first + 1; next < HeightRange::kEnds && ends[next].samples > 0; ++next) {
    const double range = std::abs(other - ends[next].height);
    const auto far = [&](const HeightCount& here) {
      return is_far(here, scale.value_of(here.height), std::abs(ends[next].height - here.height), range, valid,
                    ends.back().samples > 0 && next - first <= HeightRange::kEnds / 2);
    };
    const bool may_tell =
        range > 0 || !is_usual_sign(scale.value_of(ends[next].height));  // all other heights may be equal
    if (may_tell && std::all_of(ends.begin() + static_cast<std::ptrdiff_t>(first),
                                ends.begin() + static_cast<std::ptrdiff_t>(next), far))
      return next;
  }
  return first;
}

}  // namespace

std::vector<UndeclaredNodata> find_undeclared_nodata(const HeightRange& range, double scale, double offset) {
  const Scale of_values{scale, offset};
  std::size_t low = 0, high = 0;
  // An outlier at one end may hide an outlier at the other.
  for (std::size_t look = 0; look < HeightRange::kEnds; ++look) {
    const std::size_t before = low + high;
    low = count_far(range.lowest, low, range.highest[high].height, range.valid, of_values);
    high = count_far(range.highest, high, range.lowest[low].height, range.valid, of_values);
    if (low + high == before) break;
  }
  std::vector<UndeclaredNodata> found;
  const double min = range.lowest[low].height, max = range.highest[high].height;
  for (std::size_t k = 0; k < low; ++k)
    found.push_back({range.lowest[k], of_values.value_of(range.lowest[k].height), false, min, max});
  for (std::size_t k = 0; k < high; ++k)
    found.push_back({range.highest[k], of_values.value_of(range.highest[k].height), true, min, max});
  return found;
}

}  // namespace scarp
