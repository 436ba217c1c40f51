#include "options/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "options/option_table.h"

namespace scarp::cli {
namespace {

/// The whole text as a number; "inf" and "nan" are numbers here.
std::optional<double> find_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  return error == std::errc() ? value : std::strtod(std::string(text).c_str(), nullptr);  // infinity, or next to 0
}

/// Fails for digits, as in 1e999, that stand for more than a number can be.
Result<void> check_size(std::string_view option, const std::string& text, const std::optional<double>& value) {
  if (!value || !std::isinf(*value) || text.find_first_of("0123456789") == std::string::npos) return {};
  return fail(ErrorKind::kUsage, fmt::format("{} {} is too large: a number goes up to 1.79e308", option, text));
}

}  // namespace

Result<double> parse_number(std::string_view option, const std::string& text) {
  const std::optional<double> value = find_number(text);
  if (auto fits = check_size(option, text, value); !fits) return tl::unexpected(fits.error());
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
  const bool is_whole = end == text.data() + text.size();
  if (is_whole && error == std::errc::result_out_of_range) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is too large: give a smaller number", option, text));
  }
  if (!is_whole || error != std::errc() || value < least) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is not a whole number of at least {}, in digits alone", option,
                                               shell_word(text), least));
  }
  return value;
}

Result<int> parse_threads(const Given& text) {
  if (!text) return 0;
  const Result<std::uint64_t> threads = parse_count("--num-threads", *text, 0);
  if (!threads) return tl::unexpected(threads.error());
  if (*threads > 1024) {
    return fail(ErrorKind::kUsage,
                fmt::format("--num-threads {} is more than 1024: ask for fewer, or for 0, all cores", *text));
  }
  return static_cast<int>(*threads);
}

std::string canonical_option(const char* name, const Given& text) {
  return text ? fmt::format(" {} {}", name, shell_word(*text)) : "";
}

Result<ErrorGoal> parse_error_goal(std::string_view option, const std::string& text) {
  ErrorGoal goal;
  goal.percent_of_relief = !text.empty() && text.back() == '%';
  const std::optional<double> value =
      find_number(std::string_view(text).substr(0, text.size() - (goal.percent_of_relief ? 1 : 0)));
  if (auto fits = check_size(option, text, value); !fits) return tl::unexpected(fits.error());
  if (!value || !std::isfinite(*value)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is neither a finite number, in the units of the heights, nor a "
                                               "percentage of the relief such as 0.5%",
                                               option, shell_word(text)));
  }
  if (*value < 0 || std::signbit(*value)) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is negative: it must be at least 0, and 0 reproduces every sample", option,
                            shell_word(text)));
  }
  goal.value = *value;
  return goal;
}

Error name_goal(const ErrorGoal& goal, double relief, Error error) {
  const std::string absolute = fmt::format("a max error of {}", goal.absolute(relief));
  if (goal.percent_of_relief && error.message.starts_with(absolute + " "))
    error.message.replace(0, absolute.size(),
                          fmt::format("-e {}% of a relief of {:.10g}, {},", goal.value, relief, absolute));
  return error;
}

void RasterArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kBand, band);
  add_option(command, OptionId::kNodata, nodata);
  add_option(command, OptionId::kDecode, decode);
  add_option(command, OptionId::kCrs, crs);
}

Result<ReadOptions> RasterArguments::parse() const {
  ReadOptions options;
  if (path.empty()) return fail(ErrorKind::kUsage, "the name of the raster is empty");
  if (band) {
    const Result<std::uint64_t> number = parse_count("--band", *band, 1);
    if (!number) return tl::unexpected(number.error());
    if (*number > 65535) {
      return fail(ErrorKind::kUsage, fmt::format("--band {} is more than any raster has (65535)", *band));
    }
    options.band = static_cast<int>(*number);
  }
  if (nodata) {
    const std::optional<double> value = find_number(*nodata);
    if (auto fits = check_size("--nodata", *nodata, value); !fits) return tl::unexpected(fits.error());
    if (!value) {
      return fail(ErrorKind::kUsage, fmt::format("--nodata {} is not a number or nan", shell_word(*nodata)));
    }
    options.nodata = *value;
  }
  if (decode) {
    if (*decode == "terrarium") {
      options.decode = Decode::kTerrarium;
    } else if (*decode == "mapbox") {
      options.decode = Decode::kMapbox;
    } else {
      return fail(ErrorKind::kUsage,
                  fmt::format("--decode {} is unknown: choose terrarium or mapbox", shell_word(*decode)));
    }
    if (band) {
      return fail(ErrorKind::kUsage, "--decode cannot be combined with --band: decoding takes bands 1, 2 and 3");
    }
  }
  if (crs) {
    if (crs->empty()) return fail(ErrorKind::kUsage, "--crs is empty: choose source, local, grid or a CRS");
    options.crs = *crs;
  }
  return options;
}

}  // namespace scarp::cli
