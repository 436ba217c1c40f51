// Merges corners at equal positions into shared vertices.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace scarp::io {

/// Gives equal points equal ids, in order of first appearance. A hash table with open addressing, at most half full.
class Welder {
 public:
  Welder(std::vector<double>& positions, std::size_t most_points) : positions_(positions) {
    std::size_t size = 16;
    while (size < 2 * most_points) size *= 2;
    slots_.assign(size, kEmpty);
  }

  std::uint32_t find_or_add(double x, double y, double z) {
    std::uint64_t hash = 0x9E3779B97F4A7C15u;
    for (const double coordinate : {x, y, z}) {
      hash ^= std::bit_cast<std::uint64_t>(coordinate + 0.0);  // −0 is 0
      hash *= 0xD6E8FEB86659FD93u;
      hash ^= hash >> 32;
    }
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
      const std::uint32_t id = slots_[slot];
      if (id == kEmpty) {
        slots_[slot] = static_cast<std::uint32_t>(positions_.size() / 3);
        positions_.insert(positions_.end(), {x, y, z});
        return slots_[slot];
      }
      const double* known = &positions_[3 * std::size_t{id}];
      if (known[0] == x && known[1] == y && known[2] == z) return id;
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();
  std::vector<double>& positions_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace scarp::io
