// The numbers of vertices in a file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace scarp::io {

/// Maps the numbers of vertices to their indices. Consecutive numbers, the usual case, cost 8 bytes each and are found
/// directly. Other numbers are sorted by finish().
class IdTable {
 public:
  /// Adds the number of the next vertex, counting from `first`.
  void add(std::int64_t number) { numbers_.push_back(number); }

  /// Must be called between the last add() and the first find(). Returns a number used by two vertices, if any.
  std::optional<std::int64_t> finish(std::uint32_t first) {
    first_ = first;
    is_row_ = true;
    for (std::size_t k = 1; k < numbers_.size() && is_row_; ++k) {
      is_row_ = numbers_[k] - 1 == numbers_[k - 1];
    }
    if (is_row_) return {};
    sorted_.reserve(numbers_.size());
    for (std::size_t k = 0; k < numbers_.size(); ++k) sorted_.emplace_back(numbers_[k], static_cast<std::uint32_t>(k));
    std::sort(sorted_.begin(), sorted_.end());
    for (std::size_t k = 1; k < sorted_.size(); ++k) {
      if (sorted_[k].first == sorted_[k - 1].first) return sorted_[k].first;
    }
    return {};
  }

  /// The vertex with the number; nothing if none.
  std::optional<std::uint32_t> find(std::int64_t number) const {
    if (numbers_.empty()) return {};
    if (is_row_) {
      if (number < numbers_.front() || number > numbers_.back()) return {};
      return first_ + static_cast<std::uint32_t>(number - numbers_.front());
    }
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair(number, std::uint32_t{0}));
    if (at == sorted_.end() || at->first != number) return {};
    return first_ + at->second;
  }

 private:
  std::vector<std::int64_t> numbers_;
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;
  std::uint32_t first_ = 0;
  bool is_row_ = true;
};

}  // namespace scarp::io
