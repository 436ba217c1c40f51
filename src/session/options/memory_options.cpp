#include "session/options/memory_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr double kMostBytes = 1e18;

/// The value of a unit, a power of 1000 or 1024; nothing for an unknown unit.
std::optional<double> find_unit(std::string unit) {
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  if (!unit.empty() && unit.back() == 'b') unit.pop_back();
  if (unit.empty()) return 1;
  const std::size_t power = std::string_view("kmgt").find(unit[0]);
  if (power == std::string_view::npos || (unit.size() > 1 && unit.substr(1) != "i")) return std::nullopt;
  return std::pow(unit.size() > 1 ? 1024.0 : 1000.0, static_cast<double>(power + 1));
}

}  // namespace

Result<std::optional<std::uint64_t>> parse_memory(const GivenOptions& given) {
  const Given& text = given[OptionId::kMemory];
  if (!text) return std::nullopt;
  SCARP_TRY(const std::uint64_t limit, parse_bytes(name_of(OptionId::kMemory), *text));
  if (limit < kProgramBytes)
    return fail(ErrorKind::kUsage, fmt::format("{} {} is too little: the program alone needs {}M", OptionId::kMemory,
                                               *text, kProgramBytes / 1000000));
  return limit;
}

Result<std::uint64_t> parse_bytes(std::string_view option, const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) number = std::strtod(text.c_str(), nullptr);  // infinity, or almost 0
  const char* last = text.data() + text.size();
  const char* unit = end;
  while (unit != last && *unit == ' ') ++unit;
  const std::optional<double> factor = find_unit(std::string(unit, last));
  const double bytes = number * factor.value_or(1);
  const bool has_digits = text.find_first_of("0123456789") != std::string::npos;
  if (error == std::errc::invalid_argument || !has_digits || !factor || bytes < 0) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is no size of memory: give a number with k, M, G, T, Ki, Mi, Gi "
                                               "or Ti behind it, such as 1G",
                                               option, shell_word(text)));
  }
  if (bytes > kMostBytes) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is too large: give at most 1000000T, or leave {} out to have no "
                                               "limit",
                                               option, text, option));
  }
  return static_cast<std::uint64_t>(bytes);
}

}  // namespace scarp::cli
