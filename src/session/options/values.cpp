#include "session/options/values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "session/table/option_table.h"

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

struct GoalUnit {
  const char* suffix;
  const char* unit;
  double of_one;  ///< how many are one of `unit`
};

constexpr GoalUnit kGoalUnits[] = {{"%", "", 1}, {"mm", "", 1}, {"cm", "m", 100}, {"m", "m", 1}, {"ft", "ft", 1}};

/// 50k, 2M, 1e5: a number with the letter of a power of 1000 behind it; nothing for other text.
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

/// --z-scale, --z-offset, --z-unit and --cell-size.
Result<void> parse_heights(const RasterArguments& given, ReadOptions& options) {
  for (const auto& [name, text, value] : {std::tuple{"--z-scale", &given.z_scale, &options.z_scale},
                                          std::tuple{"--z-offset", &given.z_offset, &options.z_offset}}) {
    if (!*text) continue;
    const Result<double> number = parse_number(name, **text);
    if (!number) return tl::unexpected(number.error());
    *value = *number;
  }
  if (options.z_scale == 0)
    return fail(ErrorKind::kUsage, "--z-scale 0 makes all heights equal: give a factor other than 0");
  if (given.z_unit && given.z_unit->empty()) return fail(ErrorKind::kUsage, "the unit of --z-unit is empty");
  options.z_unit = given.z_unit.value_or("");
  if (!given.cell_size) return {};
  const Result<double> cell = parse_number("--cell-size", *given.cell_size);
  if (!cell) return tl::unexpected(cell.error());
  if (*cell <= 0)
    return fail(ErrorKind::kUsage,
                fmt::format("--cell-size {} is not above 0: give the width of a cell", *given.cell_size));
  options.cell_size = *cell;
  return {};
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

Result<std::optional<double>> parse_nodata(const Given& nodata) {
  if (!nodata) return std::optional<double>();
  const std::optional<double> value = find_number(*nodata);
  if (auto fits = check_size("--nodata", *nodata, value); !fits) return tl::unexpected(fits.error());
  if (!value) return fail(ErrorKind::kUsage, fmt::format("--nodata {} is not a number or nan", shell_word(*nodata)));
  return value;
}

Result<double> parse_fill_distance(const Given& text, bool is_filled) {
  if (!text) return is_filled ? 100.0 : 0.0;
  if (!is_filled) return fail(ErrorKind::kUsage, "--fill-distance needs --nodata-policy fill");
  const Result<double> distance = parse_number("--fill-distance", *text);
  if (distance && *distance <= 0)
    return fail(ErrorKind::kUsage, fmt::format("--fill-distance {} is not above 0", shell_word(*text)));
  return distance;
}

Result<std::uint64_t> parse_count(std::string_view option, const std::string& text, std::uint64_t least) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_digits = end == text.data() + text.size() && error != std::errc::invalid_argument;
  const std::optional<double> rounded = is_digits ? std::nullopt : find_rounded_count(text);
  constexpr double kMost = 0x1p53;  // up to which doubles are exact
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
  std::string_view number = text;
  double divisor = 1;
  for (const auto& [suffix, unit, of_one] : kGoalUnits) {
    if (!number.ends_with(suffix)) continue;
    number.remove_suffix(std::string_view(suffix).size());
    goal.percent_of_relief = suffix[0] == '%';
    goal.is_on_print = std::string_view(suffix) == "mm";
    goal.unit = unit;
    divisor = of_one;
    break;
  }
  std::optional<double> value = find_number(number);
  if (auto fits = check_size(option, text, value); !fits) return tl::unexpected(fits.error());
  if (!value || !std::isfinite(*value)) {
    return fail(ErrorKind::kUsage, fmt::format("{} {} is neither a finite number, in the units of the heights, nor a "
                                               "percentage of the relief such as 0.5%, nor a length such as 1m",
                                               option, shell_word(text)));
  }
  *value /= divisor;
  if (*value < 0 || std::signbit(*value)) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} {} is negative: it must be at least 0, and 0 reproduces every sample", option,
                            shell_word(text)));
  }
  goal.value = *value;
  return goal;
}

Result<void> refuse_print(std::string_view option, const ErrorGoal& goal) {
  if (!goal.is_on_print) return {};
  return fail(ErrorKind::kUsage, fmt::format("{} {}mm is an error on a print, and there is none here: give it in the "
                                             "units of the heights",
                                             option, format_number(goal.value)));
}

Result<void> settle_goal(std::string_view option, const RasterInfo& heights, ErrorGoal& goal,
                         std::vector<std::string>& warnings) {
  if (goal.unit.empty()) return {};
  const double metres = heights.unit_in_metres;
  if (metres == 0)
    return fail(ErrorKind::kUsage,
                fmt::format("{} is in {}, and the heights are in '{}', which is no unit of length that is "
                            "known here: give a number without a unit, or name their unit (--z-unit)",
                            option, goal.unit, heights.unit));
  constexpr double kFoot = 0.3048;
  const bool are_feet = std::abs(metres / kFoot - 1) < 1e-5;  // of any kind: theirs is meant
  const double of_goal = goal.unit == "m" ? 1 : are_feet ? metres : kFoot;
  const double given = goal.value;
  if (of_goal != metres) goal.value *= of_goal / metres;
  if (heights.unit_is_assumed && heights.unit.empty())
    warnings.push_back(fmt::format(
        "the file does not tell the unit of its heights, which are taken for {}: {} {}{} is {} of "
        "them; --z-unit names another",
        metres == 1 ? "metres" : heights.crs_unit, option, format_number(given), goal.unit, format_number(goal.value)));
  return {};
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
  add_option(command, OptionId::kZScale, z_scale);
  add_option(command, OptionId::kZOffset, z_offset);
  add_option(command, OptionId::kZUnit, z_unit);
  add_option(command, OptionId::kCellSize, cell_size);
  add_numbers(command, OptionId::kExtent, extent, 4);
  add_option(command, OptionId::kResolution, resolution);
}

std::string RasterArguments::canonical() const {
  return canonical_option("--band", band) + canonical_option("--nodata", nodata) +
         canonical_option("--decode", decode) + canonical_option("--crs", crs) +
         canonical_option("--z-scale", z_scale) + canonical_option("--z-offset", z_offset) +
         canonical_option("--z-unit", z_unit) + canonical_option("--cell-size", cell_size) +
         (extent.empty() ? "" : fmt::format(" --te {}", fmt::join(extent, " "))) +
         canonical_option("--resolution", resolution);
}

Error RasterArguments::explain(Error error) const {
  if (error.kind != ErrorKind::kInput) return error;
  if (paths.size() == 1 && path() == "-" && error.message.starts_with("standard input"))
    error.message += "; it is read as a raster, with --points as points or lines, never as a mesh";
  else if (error.message.starts_with(path() + ": holds vector data"))
    error.message += "; --points takes it for points or lines";
  return error;
}

Result<ReadOptions> RasterArguments::parse() const {
  ReadOptions options;
  for (const std::string& path : paths) {
    if (path.empty()) return fail(ErrorKind::kUsage, "the name of the raster is empty");
  }
  options.view.more.assign(paths.begin() + 1, paths.end());
  if (!extent.empty()) {
    std::array<double, 4> box{};
    for (std::size_t k = 0; k < box.size(); ++k) {
      const Result<double> value = parse_number("--te", extent[k]);
      if (!value) return tl::unexpected(value.error());
      box[k] = *value;
    }
    if (!(box[0] < box[2]) || !(box[1] < box[3])) {
      return fail(ErrorKind::kUsage, fmt::format("--te {} {} {} {} is empty: its order is XMIN YMIN XMAX YMAX",
                                                 extent[0], extent[1], extent[2], extent[3]));
    }
    options.view.extent = box;
  }
  if (resolution) {
    const Result<double> value = parse_number("--resolution", *resolution);
    if (!value) return tl::unexpected(value.error());
    if (!(*value > 0)) return fail(ErrorKind::kUsage, fmt::format("--resolution {} is not above 0", *resolution));
    if (decode) {
      return fail(ErrorKind::kUsage,
                  "--resolution cannot be combined with --decode: means of packed colours are no heights");
    }
    options.view.resolution = *value;
  }
  if (band) {
    const Result<std::uint64_t> number = parse_count("--band", *band, 1);
    if (!number) return tl::unexpected(number.error());
    if (*number > 65535) {
      return fail(ErrorKind::kUsage, fmt::format("--band {} is more than any raster has (65535)", *band));
    }
    options.band = static_cast<int>(*number);
  }
  const auto value = parse_nodata(nodata);
  if (!value) return tl::unexpected(value.error());
  options.nodata = *value;
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
  if (auto heights = parse_heights(*this, options); !heights) return tl::unexpected(heights.error());
  return options;
}

}  // namespace scarp::cli
