#include "base/sort.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

namespace scarp::detail {

void sort_bytes(std::byte* items, std::size_t count, std::size_t size,
                FunctionRef<bool(const std::byte* a, const std::byte* b)> before) {
  if (count < 2) return;
  std::vector<std::uint32_t> order(count), merged(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t run = 1; run < count; run *= 2) {
    for (std::size_t first = 0; first < count; first += 2 * run) {
      const std::size_t middle = std::min(first + run, count), end = std::min(middle + run, count);
      std::size_t a = first, b = middle;
      for (std::size_t to = first; to < end; ++to)
        merged[to] = b == end || (a < middle && !before(items + order[b] * size, items + order[a] * size)) ? order[a++]
                                                                                                           : order[b++];
    }
    order.swap(merged);
  }
  std::vector<std::byte> sorted(count * size);
  for (std::size_t k = 0; k < count; ++k) std::memcpy(sorted.data() + k * size, items + order[k] * size, size);
  std::memcpy(items, sorted.data(), count * size);
}

}  // namespace scarp::detail
