// Detection of the columns of a text that hold x, y and the height.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/io.h"

namespace scarp::io {

struct PointColumns {
  char separator = ',';
  std::array<std::size_t, 3> at{0, 1, 2};  ///< indices of x, y and height, from 0
  bool has_header = false;
  bool in_degrees = false;             ///< according to the header's names
  std::vector<std::size_t> heights{};  ///< other columns whose names show that they hold heights
  std::vector<std::string> names{};    ///< names in the header; may be empty
  std::array<std::string, 3> units{};  ///< units that the header names, for x, y and height; empty: none
  std::string words{};                 ///< "1 number, 2 y, 3 x, 4 height"
  std::vector<std::string> warnings{};

  bool has_decimal_comma() const { return separator != ','; }
};

/// The separator of a line's fields: that between its numbers if it has two, else that between its words.
char find_separator(std::string_view line);

/// True for a line of words, which are column names.
bool is_header(std::string_view line, char separator);

/// Determines the columns by ReadPointsOptions::columns, else by a header line (or a comment instead of it), else by
/// their contents: a first column that counts up holds point numbers. Fails with kInput and a sentence on --columns if
/// northing and easting cannot be distinguished. REQUIRES: a line other than comments.
Result<PointColumns> find_columns(std::string_view text, const std::string& name, const ReadPointsOptions& options);

}  // namespace scarp::io
