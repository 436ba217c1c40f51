// Facts that the rows of a text show about its columns, and conclusions from them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scarp::io {

inline constexpr std::size_t kMostColumns = 16;

struct ColumnFacts {
  std::uint64_t filled = 0, numbers = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low, first = 0, last = 0, step = 0;
  bool are_whole = true, has_even_steps = true;
  bool leads_with_zero = false;         ///< at least one number of several digits does
  std::size_t narrow = 1000, wide = 0;  ///< characters

  void add(std::string_view field, bool has_decimal_comma);
  bool lies_in(double from, double to) const { return low >= from && high < to; }
  double extent() const { return high - low; }
};

struct Rows {
  std::vector<ColumnFacts> columns;
  std::uint64_t count = 0;
  bool are_labels_unique = true;  ///< for the first column

  bool holds_numbers(std::size_t column) const {
    return columns[column].numbers > 0 && columns[column].numbers * 2 >= count;
  }
  /// The columns of numbers from the left, without the first one if it numbers the points.
  std::vector<std::size_t> coordinates() const;
};

/// The orders in which a pair of columns may be map coordinates, judged by size.
struct PairFit {
  bool is_east_first = false, is_north_first = false;
};
PairFit fit_pair(const ColumnFacts& one, const ColumnFacts& other);
/// UTM and most national grids have northings above a million, and eastings below.
bool is_northing(const ColumnFacts& facts);
bool is_easting(const ColumnFacts& facts);

struct HeightDoubt {
  std::string why;          ///< "counts", "is 0 everywhere"
  std::size_t instead = 0;  ///< a later column that may hold heights
  bool is_certain = true;   ///< false: a warning is enough
};
/// `list`: the columns of numbers, the first three of which would be x, y and the height.
std::optional<HeightDoubt> doubt_height(const Rows& rows, const std::vector<std::size_t>& list);

/// The position in `list` of two columns more likely to be x and y than the first two.
std::optional<std::size_t> find_later_pair(const Rows& rows, const std::vector<std::size_t>& list);

/// True if each number was split into two columns at its decimal comma.
bool are_split_at_commas(const Rows& rows);

}  // namespace scarp::io
