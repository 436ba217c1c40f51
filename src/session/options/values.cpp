#include "session/options/values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace scarp::cli {
namespace {

/// 50k, 2M, 1e5: a number that may end with k, M or another power of 1000; nothing for other text.
std::optional<double> find_rounded_count(std::string_view text) {
  double factor = 1;
  if (!text.empty()) {
    constexpr std::pair<char, double> kFactors[] = {{'k', 1e3}, {'K', 1e3}, {'M', 1e6}, {'G', 1e9}};
    for (const auto& [letter, value] : kFactors) {
      if (text.back() == letter) factor = value;
    }
    if (factor > 1) text.remove_suffix(1);
  }
  const std::optional<double> number = find_number(text);
  if (!number || std::isnan(*number)) return std::nullopt;
  return *number * factor;
}

}  // namespace

std::optional<double> find_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  return error == std::errc() ? value : std::strtod(std::string(text).c_str(), nullptr);  // infinity, or almost 0
}

Result<void> check_size(std::string_view option, const std::string& text, const std::optional<double>& value) {
  if (!value || !std::isinf(*value) || text.find_first_of("0123456789") == std::string::npos) return {};
  return fail(ErrorKind::kUsage, fmt::format("{} {} is too large: a number goes up to 1.79e308", option, text));
}

Result<double> parse_number(std::string_view option, const std::string& text) {
  const std::optional<double> value = find_number(text);
  SCARP_RETURN_IF_ERROR(check_size(option, text, value));
  if (!value || !std::isfinite(*value)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is not a finite number", option, shell_word(text)));
  }
  return *value;
}

Result<double> parse_non_negative(std::string_view option, const std::string& text) {
  const Result<double> value = parse_number(option, text);
  if (value && *value < 0) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is negative: it must be at least 0", option, shell_word(text)));
  }
  return value;
}

Result<std::uint64_t> parse_count(std::string_view option, const std::string& text, std::uint64_t least) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_digits = end == text.data() + text.size() && error != std::errc::invalid_argument;
  const std::optional<double> rounded = is_digits ? std::nullopt : find_rounded_count(text);
  constexpr double kMost = 0x1p53;  // integers up to this are exact in double
  if ((is_digits && error == std::errc::result_out_of_range) || (rounded && *rounded > kMost)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is too large: give a smaller number", option, text));
  }
  const bool is_whole = is_digits || (rounded && *rounded >= 0 && *rounded == std::floor(*rounded));
  if (rounded && is_whole) value = static_cast<std::uint64_t>(*rounded);
  if (!is_whole || value < least) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is not a whole number of at least {}{}", option, shell_word(text),
                                               least, is_whole ? "" : ", such as 5000, 50k, 2M or 1e5"));
  }
  return value;
}

}  // namespace scarp::cli
