#include "io/mesh/mesh_file_text.h"

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <string>

namespace scarp::io {
namespace {

bool is_text_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Parses plain decimals up to 2^53 with at most 22 decimal places, where one division of two exact numbers is
/// correctly rounded.
bool parse_plain(std::string_view word, double& value) {
  const bool negative = word[0] == '-';
  std::size_t i = negative || word[0] == '+' ? 1 : 0;
  std::uint64_t digits = 0;
  std::size_t digit_count = 0, places = 0;
  bool point = false;
  for (; i < word.size(); ++i) {
    if (word[i] == '.' && !point) {
      point = true;
    } else if (is_digit(word[i]) && digit_count < 18) {
      digits = digits * 10 + static_cast<std::uint64_t>(word[i] - '0');
      ++digit_count;
      places += point;
    } else {
      return false;
    }
  }
  if (digit_count == 0 || digits > (std::uint64_t{1} << 53)) return false;
  value = static_cast<double>(digits) / kPowers[places];
  if (negative) value = -value;
  return true;
}

}  // namespace

bool parse_number(std::string_view word, double& value) {
  if (word.empty()) return false;
  if (parse_plain(word, value)) return true;
  // Plain strtod would parse "1.5" as 1 if the program has set a locale with a decimal comma.
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
  const std::string text(word);
  char* end = nullptr;
  value = strtod_l(text.c_str(), &end, c_locale);
  return end == text.c_str() + text.size();
}

bool parse_integer(std::string_view word, std::int64_t& value) {
  if (word.size() > 1 && word[0] == '+' && is_digit(word[1])) word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto parsed = std::from_chars(word.data(), end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

bool begins_with(std::span<const std::uint8_t> bytes, std::string_view text) {
  const auto is_same = [](char c, std::uint8_t byte) { return static_cast<std::uint8_t>(c) == byte; };
  return bytes.size() >= text.size() && std::equal(text.begin(), text.end(), bytes.begin(), is_same);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string plain;
  for (const char c : text.substr(0, kMost)) plain += c >= ' ' && c < 127 ? c : '?';
  return "'" + plain + (text.size() > kMost ? "…'" : "'");
}

std::string lowered(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

std::string_view TextCursor::word() {
  for (;;) {
    while (at_ != end_ && is_text_blank(*at_)) ++at_;
    if (at_ == end_ || *at_ != '\\') break;
    const char* next = at_ + 1;
    if (next != end_ && *next == '\r') ++next;
    if (next == end_ || *next != '\n') break;
    at_ = next + 1;
    ++line_;
  }
  const char* begin = at_;
  while (at_ != end_ && !is_text_blank(*at_) && !is_line_end(*at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::string_view TextCursor::word_anywhere() {
  for (;;) {
    const std::string_view found = word();
    if (!found.empty() || at_end()) return found;
    rest_of_line();
  }
}

std::string_view TextCursor::rest_of_line() {
  const char* begin = at_;
  while (at_ != end_ && !is_line_end(*at_)) ++at_;
  const std::string_view rest(begin, static_cast<std::size_t>(at_ - begin));
  if (at_ != end_) {
    const char first = *at_++;
    if (first == '\r' && at_ != end_ && *at_ == '\n') ++at_;
    ++line_;
  }
  return rest;
}

}  // namespace scarp::io
