// Unpacks the geoid EGM96. tools/make_egm96.py packs it, and documents the format.
#include "globe/egm96.h"

#include <cstdlib>
#include <utility>
#include <vector>

#include "scarp/tile.h"

namespace scarp {
namespace {

constexpr int kGeoidCols = 1440, kGeoidRows = 721;
constexpr double kGeoidCell = 0.25;

class PackedBits {
 public:
  unsigned next() {
    if (at_ / 64 >= globe::kPackedEgm96Words) return 0;
    const unsigned bit = static_cast<unsigned>(globe::kPackedEgm96[at_ / 64] >> (63 - at_ % 64)) & 1;
    ++at_;
    return bit;
  }
  unsigned next(int count) {
    unsigned bits = 0;
    for (int k = 0; k < count; ++k) bits = bits << 1 | next();
    return bits;
  }

 private:
  std::size_t at_ = 0;
};

/// Integrates second differences: computes the next number from the last two and a difference.
int after(int last, int before, int difference) { return difference + 2 * last - before; }

std::vector<float> unpack_egm96() {
  PackedBits bits;
  std::vector<float> heights;
  heights.reserve(std::size_t{kGeoidCols} * kGeoidRows);
  // Horizontal second differences of the last two rows.
  std::vector<int> last(kGeoidCols), before(kGeoidCols);
  for (int row = 0; row < kGeoidRows; ++row) {
    int size = 32, left = 0, left_of_that = 0;
    for (std::size_t col = 0; col < kGeoidCols; ++col) {
      int k = 0;
      while ((40 << k) < 7 * size) ++k;
      unsigned code = 0;
      while (bits.next() != 0) ++code;
      code = code << k | bits.next(k);
      const int difference = (code & 1) == 0 ? static_cast<int>(code / 2) : -static_cast<int>(code / 2) - 1;
      size += std::abs(difference) - (size >> 3);
      before[col] = after(last[col], before[col], difference);
      left_of_that = after(left, left_of_that, before[col]);
      std::swap(left, left_of_that);
      heights.push_back(static_cast<float>(left / 100.0));
    }
    std::swap(last, before);
  }
  return heights;
}

}  // namespace

std::shared_ptr<const HeightZero> egm96() {
  static const std::shared_ptr<const HeightZero> geoid =
      *make_grid_zero({kGeoidCols, kGeoidRows, unpack_egm96(), {{-180, kGeoidCell, 0, 90, 0, -kGeoidCell}}});
  return geoid;
}

}  // namespace scarp
