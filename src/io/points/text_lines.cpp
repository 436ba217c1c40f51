#include "io/points/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace scarp::io {
namespace {

bool is_blank_in_line(char c) { return c == ' ' || c == '\t'; }

/// True if a number out of double's range is too small, not too large.
bool is_below_one(std::string_view number) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, e);
  std::int64_t exponent = 0;
  if (e < number.size()) {
    std::string_view text = number.substr(e + 1);
    if (text.starts_with('+')) text.remove_prefix(1);
    if (std::from_chars(text.data(), text.data() + text.size(), exponent).ec == std::errc::result_out_of_range)
      return text.starts_with('-');
  }
  const auto place = [&](std::string_view wanted) {
    return static_cast<std::int64_t>(std::min(digits.find_first_of(wanted), digits.size()));
  };
  return exponent < place("123456789") - place(".");
}

}  // namespace

std::string_view trim_field(std::string_view text) {
  while (!text.empty() && is_blank_in_line(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank_in_line(text.back())) text.remove_suffix(1);
  return text;
}

TextLines::TextLines(std::string_view text) : rest_(text) {
  if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);  // a byte order mark
}

bool TextLines::next(std::string_view& line) {
  comment_ = {};
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::string_view content = trim_field(line);
    if (content.empty()) continue;
    const std::size_t sign = content.front() == '#' || content.front() == '%' ? 1 : content.starts_with("//") ? 2 : 0;
    if (sign == 0) return true;
    comment_ = trim_field(content.substr(sign));
  }
  return false;
}

std::optional<std::string_view> take_field(std::string_view& line, char separator) {
  if (separator == ' ') {
    line = trim_field(line);
    if (line.empty()) return std::nullopt;
  } else if (line.data() == nullptr) {
    return std::nullopt;
  }
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  const std::size_t close = begin < line.size() && line[begin] == '"' ? line.find('"', begin + 1) : line.npos;
  const auto is_end = [&](std::size_t at) {
    return separator == ' ' ? line.find_first_of(" \t", at) : line.find(separator, at);
  };
  const std::size_t end = std::min(is_end(close == line.npos ? 0 : close), line.size());
  std::string_view field = trim_field(line.substr(0, end));
  if (close != line.npos && field.size() >= 2 && field.back() == '"')
    field = trim_field(field.substr(1, field.size() - 2));
  if (separator == ' ')
    line.remove_prefix(end);
  else
    line = end == line.size() ? std::string_view() : line.substr(end + 1);
  return field;
}

std::optional<double> parse_field(std::string_view text, bool has_decimal_comma) {
  std::string with_point;
  if (const std::size_t comma = has_decimal_comma ? text.find(',') : text.npos; comma != text.npos) {
    with_point = text;
    with_point[comma] = '.';
    text = with_point;
  }
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return is_below_one(text) ? 0 : HUGE_VAL;
  if (error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace scarp::io
