// Words and numbers in arbitrary text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scarp::io {

/// Parses the whole word as a number, correctly rounded and independent of the locale, including "nan" and "inf".
/// Returns false for other words.
bool parse_number(std::string_view word, double& value);
/// Parses the whole word as a decimal integer. Returns false for other words, and for integers beyond 64 bits.
bool parse_integer(std::string_view word, std::int64_t& value);

/// True if the bytes begin with those of the text.
bool begins_with(std::span<const std::uint8_t> bytes, std::string_view text);
/// Text in quotes for an error message: unprintable characters become '?', and long text is truncated.
std::string in_quotes(std::string_view text);
/// The text with its ASCII letters in lower case, independent of the locale.
std::string lowered(std::string_view text);

/// Walks over text word by word, line by line. Lines end with LF, CR or both.
class TextCursor {
 public:
  explicit TextCursor(std::span<const std::uint8_t> bytes)
      : at_(reinterpret_cast<const char*>(bytes.data())), end_(at_ + bytes.size()) {}

  bool at_end() const { return at_ == end_; }
  std::size_t line() const { return line_; }  ///< 1-based
  const char* position() const { return at_; }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

  /// The next word of this line; empty at the line's end. A backslash at the end continues the line.
  std::string_view word();
  /// The next word of this or a later line; empty at the end of the text.
  std::string_view word_anywhere();
  /// The rest of this line, without its end; the cursor moves to the next line.
  std::string_view rest_of_line();
  /// The next word of this line as a number.
  bool number(double& value) { return parse_number(word(), value); }

 private:
  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
};

}  // namespace scarp::io
