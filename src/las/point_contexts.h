// The contexts of the statistics in both point decoders: the tables and the running median of the LASzip specification.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "las/range_decoder.h"

namespace scarp::las {

/// The median of about the last five values. A new value replaces the lowest or the highest, depending on the previous
/// values.
class RunningMedian {
 public:
  std::int32_t get() const { return sorted_[2]; }

  void add(std::int32_t value) {
    if (drops_highest_ ? value < sorted_[2] : !(sorted_[2] < value)) {
      insert_low(value);
    } else {
      insert_high(value);
    }
  }

 private:
  /// Inserts a value below the median. The five values stay sorted; the highest or the lowest is dropped.
  void insert_low(std::int32_t value) {
    if (!drops_highest_) {
      replace_lowest(value);
      drops_highest_ = true;
      return;
    }
    sorted_[4] = sorted_[3];
    sorted_[3] = sorted_[2];
    int place = 2;
    for (; place > 0 && value < sorted_[place - 1]; --place) sorted_[place] = sorted_[place - 1];
    sorted_[place] = value;
  }
  void insert_high(std::int32_t value) {
    if (drops_highest_) {
      replace_highest(value);
      drops_highest_ = false;
      return;
    }
    sorted_[0] = sorted_[1];
    sorted_[1] = sorted_[2];
    int place = 2;
    for (; place < 4 && sorted_[place + 1] < value; ++place) sorted_[place] = sorted_[place + 1];
    sorted_[place] = value;
  }
  void replace_lowest(std::int32_t value) {
    const bool is_second = sorted_[1] < value;
    if (is_second) sorted_[0] = sorted_[1];
    sorted_[is_second ? 1 : 0] = value;
  }
  void replace_highest(std::int32_t value) {
    const bool is_second = value < sorted_[3];
    if (is_second) sorted_[4] = sorted_[3];
    sorted_[is_second ? 3 : 4] = value;
  }

  std::array<std::int32_t, 5> sorted_{};
  bool drops_highest_ = true;
};

/// Initializes each model on first use, since many contexts never occur.
template <unsigned kSymbols, std::size_t kCount>
class ModelSet {
 public:
  void forget() {
    for (auto& model : *models_) model.forget();
  }
  SymbolModel<kSymbols>& operator[](std::size_t context) {
    SymbolModel<kSymbols>& model = (*models_)[context];
    if (!model.is_begun()) model.begin(kSymbols);
    return model;
  }

 private:
  using Models = std::array<SymbolModel<kSymbols>, kCount>;
  std::unique_ptr<Models> models_ = std::make_unique<Models>();
};

/// The context of return r of n, in legacy formats.
inline constexpr std::uint8_t kLegacyReturnContexts[8][8] = {
    {15, 14, 13, 12, 11, 10, 9, 8},  {14, 0, 1, 3, 6, 10, 10, 9},   {13, 1, 2, 4, 7, 11, 11, 10},
    {12, 3, 4, 5, 8, 12, 12, 11},    {11, 6, 7, 8, 9, 13, 13, 12},  {10, 10, 11, 12, 13, 14, 14, 13},
    {9, 10, 11, 12, 13, 14, 15, 14}, {8, 9, 10, 11, 12, 13, 14, 15}};

/// The context of return r of n, in formats 6 to 10: unlike the legacy one, it distinguishes few of the high returns.
constexpr std::uint8_t find_return_context(unsigned n, unsigned r) {
  constexpr std::uint8_t kOneNumber[16] = {0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5};  // if n or r is missing
  constexpr std::uint8_t kUpToThree[4][4] = {{}, {0, 0, 1, 3}, {0, 1, 2, 4}, {0, 3, 4, 5}};
  if (n == 0 || r == 0) return kOneNumber[n + r];
  if (n <= 3 && r <= 3) return kUpToThree[n][r];
  const unsigned least = n < r ? n : r, most = n < r ? r : n;
  if (least == 1 || (least == 2 && most >= 11)) return 3;
  return n == r || (least >= 11 && most - least == 1) ? 5 : 4;
}
inline constexpr auto kExtendedReturnContexts = [] {
  std::array<std::array<std::uint8_t, 16>, 16> contexts{};
  for (unsigned n = 0; n < 16; ++n) {
    for (unsigned r = 0; r < 16; ++r) contexts[n][r] = find_return_context(n, r);
  }
  return contexts;
}();

/// Distance of a return from the last one of its pulse, at most 7.
inline unsigned return_level(unsigned n, unsigned r) {
  const int level = std::abs(static_cast<int>(n) - static_cast<int>(r));
  return level < 7 ? static_cast<unsigned>(level) : 7;
}

}  // namespace scarp::las
