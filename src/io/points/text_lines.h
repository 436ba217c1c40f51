// Lines, fields and numbers of text of columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace scarp {

/// Without blanks and tabs at its ends.
std::string_view trim_field(std::string_view text);

/// The lines of a text without their ends. Comments (#, //, %) and empty lines are passed over.
class TextLines {
 public:
  explicit TextLines(std::string_view text);
  bool next(std::string_view& line);
  /// The number of the line that next() gave last, from 1.
  std::uint64_t number() const { return number_; }
  std::size_t bytes_left() const { return rest_.size(); }
  /// The comment just before the line that next() gave last, without its sign; empty if there is none.
  std::string_view comment() const { return comment_; }

 private:
  std::string_view rest_, comment_;
  std::uint64_t number_ = 0;
};

/// Removes the first field from the line and returns it; nothing if there is none. ' ' stands for runs of blanks and
/// tabs. Quotes around a field may hold separators, and are removed.
std::optional<std::string_view> take_field(std::string_view& line, char separator);

/// Nothing if the text is no number; infinities and NaN are numbers here, as is what overflows. A number that
/// underflows is 0. `has_decimal_comma`: a comma stands for the point.
std::optional<double> parse_field(std::string_view text, bool has_decimal_comma);

}  // namespace scarp
