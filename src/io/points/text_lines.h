// Lines, fields and numbers of text in columns.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace scarp::io {

/// The text without blanks and tabs at its ends.
std::string_view trim_field(std::string_view text);

/// The lines of a text without their ends. Skips comments (#, //, %) and empty lines.
class TextLines {
 public:
  explicit TextLines(std::string_view text);
  bool next(std::string_view& line);
  /// The 1-based number of the line that next() returned last.
  std::uint64_t number() const { return number_; }
  std::size_t bytes_left() const { return rest_.size(); }
  /// The comment just before that line, without its comment sign; empty if there is none.
  std::string_view comment() const { return comment_; }

 private:
  std::string_view rest_, comment_;
  std::uint64_t number_ = 0;
};

/// Removes the first field from the line and returns it; nothing if the line has none. The separator ' ' means runs of
/// blanks and tabs. A field in quotes may contain separators; the quotes are removed.
std::optional<std::string_view> take_field(std::string_view& line, char separator);

/// The number in the text, which may be infinite or NaN; infinity if it overflows, 0 if it underflows. Nothing if the
/// text is no number. `has_decimal_comma`: the decimal point is a comma.
std::optional<double> parse_field(std::string_view text, bool has_decimal_comma);

}  // namespace scarp::io
