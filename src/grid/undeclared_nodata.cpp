// Heights that stand for nodata without being declared: what lies so far from all others that no land does.
#include <algorithm>
#include <array>
#include <cmath>

#include "scarp/height_field.h"

namespace scarp {

namespace {

constexpr std::size_t kEnds = HeightRange::kEnds;
using Ends = std::array<HeightCount, kEnds>;

/// What software writes where it knows nothing.
bool is_usual_sign(double height) {
  constexpr double kHuge = 1e20;
  constexpr std::array kEither{9999.0, 99999.0, 999999.0, 32767.0, 65535.0};
  if (std::abs(height) >= kHuge || height == -999 || height == -32768) return true;
  return std::find(kEither.begin(), kEither.end(), std::abs(height)) != kEither.end();
}

/// From the others, which begin `gap` away and have that range.
bool is_far(const HeightCount& here, double gap, double range, std::uint64_t valid) {
  constexpr double kOfSigns = 0.2, kOfZero = 0.05, kLeastOfZero = 10, kOfAny = 50;
  constexpr std::uint64_t kShareOfZero = 1000, kShareOfAny = 100;
  if (is_usual_sign(here.height) && gap >= kOfSigns * range) return true;
  if (range == 0) return false;  // two heights, of which neither is odd
  if (here.height == 0 && gap >= kLeastOfZero && gap >= kOfZero * range && here.samples >= valid / kShareOfZero)
    return true;
  return gap >= kOfAny * range && here.samples <= valid / kShareOfAny;
}

/// How many of the heights at one end, from the outermost inwards, are far from all others, which reach to `other`.
std::size_t count_far(const Ends& ends, std::size_t first, double other, std::uint64_t valid) {
  for (std::size_t next = first + 1; next < kEnds && ends[next].samples > 0; ++next) {
    const double range = std::abs(other - ends[next].height);
    const auto far = [&](const HeightCount& here) {
      return is_far(here, std::abs(ends[next].height - here.height), range, valid);
    };
    const bool may_tell = range > 0 || !is_usual_sign(ends[next].height);  // all others may be one height
    if (may_tell && std::all_of(ends.begin() + static_cast<std::ptrdiff_t>(first),
                                ends.begin() + static_cast<std::ptrdiff_t>(next), far))
      return next;
  }
  return first;
}

}  // namespace

std::vector<UndeclaredNodata> find_undeclared_nodata(const HeightRange& range) {
  std::size_t low = 0, high = 0;
  // What is far at one end may hide behind what is far at the other.
  for (std::size_t look = 0; look < kEnds; ++look) {
    const std::size_t before = low + high;
    low = count_far(range.lowest, low, range.highest[high].height, range.valid);
    high = count_far(range.highest, high, range.lowest[low].height, range.valid);
    if (low + high == before) break;
  }
  std::vector<UndeclaredNodata> found;
  const double min = range.lowest[low].height, max = range.highest[high].height;
  for (std::size_t k = 0; k < low; ++k) found.push_back({range.lowest[k], false, min, max});
  for (std::size_t k = 0; k < high; ++k) found.push_back({range.highest[k], true, min, max});
  return found;
}

}  // namespace scarp
