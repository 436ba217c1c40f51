#include "io/raster/height_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "io/commands.h"

namespace scarp::io {
namespace {

constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;

struct NamedLength {
  const char* name;
  double metres;
};
constexpr NamedLength kLengths[] = {{"m", 1},
                                    {"metre", 1},
                                    {"meter", 1},
                                    {"metres", 1},
                                    {"meters", 1},
                                    {"ft", kFoot},
                                    {"foot", kFoot},
                                    {"feet", kFoot},
                                    {"international foot", kFoot},
                                    {"international feet", kFoot},
                                    {"us-ft", kSurveyFoot},
                                    {"ftus", kSurveyFoot},
                                    {"usft", kSurveyFoot},
                                    {"us ft", kSurveyFoot},
                                    {"ft us", kSurveyFoot},
                                    {"us foot", kSurveyFoot},
                                    {"us feet", kSurveyFoot},
                                    {"survey ft", kSurveyFoot},
                                    {"us survey ft", kSurveyFoot},
                                    {"us survey foot", kSurveyFoot},
                                    {"us survey feet", kSurveyFoot},
                                    {"survey foot", kSurveyFoot},
                                    {"survey feet", kSurveyFoot},
                                    {"foot_us", kSurveyFoot},
                                    {"mm", 0.001},
                                    {"millimetre", 0.001},
                                    {"millimeter", 0.001},
                                    {"cm", 0.01},
                                    {"centimetre", 0.01},
                                    {"centimeter", 0.01},
                                    {"dm", 0.1},
                                    {"decimetre", 0.1},
                                    {"decimeter", 0.1},
                                    {"km", 1000},
                                    {"kilometre", 1000},
                                    {"kilometer", 1000},
                                    {"in", 0.0254},
                                    {"inch", 0.0254},
                                    {"yd", 0.9144},
                                    {"yard", 0.9144},
                                    {"fathom", 1.8288},
                                    {"mi", 1609.344},
                                    {"mile", 1609.344}};

/// Conversion factors have at least six digits.
bool is_about(double one, double other) { return std::abs(one / other - 1) < 1e-5; }

/// The unit assumed if none is declared.
HeightUnit assume_unit(const RasterInfo& info) {
  return info.crs_unit_in_metres > 0 ? HeightUnit{info.crs_unit, info.crs_unit_in_metres} : HeightUnit{"metre", 1};
}

/// The unit of heights scaled by the factor, if it converts the file's unit to a known one.
HeightUnit scaled_unit(double factor, const HeightUnit& of_file, const RasterInfo& info) {
  if (!(of_file.metres > 0)) return {};
  if (is_about(factor, of_file.metres)) return {"m", 1};
  const double of_crs = info.crs_unit_in_metres;
  if (of_crs > 0 && is_about(factor, of_file.metres / of_crs)) return {info.crs_unit, of_crs};
  return {};
}

std::string words_of_metres(const HeightUnit& unit, const RasterInfo& info) {
  if (!info.unit_is_assumed)
    return fmt::format("heights in {} become metres: an error or a height without a unit is in metres", unit.name);
  return fmt::format(
      "{} does not tell the unit of its heights: they are taken for {}, as x and y are, and become metres; "
      "--z-unit m says that they are metres",
      info.path, unit.name);
}

}  // namespace

std::optional<double> find_metres(const std::string& name) {
  std::string word = name;
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto find = [](const std::string& text) {
    return std::ranges::find_if(kLengths, [&](const NamedLength& length) { return text == length.name; });
  };
  auto found = find(word);
  if (found == std::end(kLengths) && word.ends_with('s')) found = find(word.substr(0, word.size() - 1));
  return found == std::end(kLengths) ? std::nullopt : std::optional(found->metres);
}

bool is_foot(double metres) { return is_about(metres, kFoot); }

Result<ReadOptions> settle_heights(const ReadOptions& options, const Frame& frame, RasterInfo& info,
                                   const HeightUnit& vertical) {
  ReadOptions settled = options;
  const HeightUnit of_file = info.unit.empty() || info.unit == vertical.name
                                 ? vertical
                                 : HeightUnit{info.unit, find_metres(info.unit).value_or(0)};
  HeightUnit unit = of_file;
  const double factor = std::abs(options.z_scale);
  if (!options.z_unit.empty() && options.z_unit != of_file.name) {
    const bool is_of_crs = options.z_unit == info.crs_unit && info.crs_unit_in_metres > 0;
    const auto metres = is_of_crs ? std::optional(info.crs_unit_in_metres) : find_metres(options.z_unit);
    if (!metres)
      return fail(
          ErrorKind::kUsage,
          fmt::format("--z-unit '{}' is no unit of length that is known here: choose m, ft, us-ft, cm, fathom … "
                      "or leave it out",
                      options.z_unit));
    unit = {options.z_unit, *metres};
  } else if (options.z_unit.empty() && factor != 1) {
    unit = scaled_unit(factor, of_file, info);
  }
  info.unit_is_assumed = unit.name.empty();
  if (info.unit_is_assumed) unit = factor == 1 ? assume_unit(info) : HeightUnit{"metre", 1};
  const bool is_metric = options.heights_in == HeightsIn::kMetres ||
                         (options.heights_in == HeightsIn::kFrame &&
                          (frame.space || (frame.kind == Frame::Kind::kLocal && frame.unit_in_metres == 1)));
  const bool is_converted = is_metric && unit.metres != 1;
  if (is_converted && unit.metres == 0)
    return fail(ErrorKind::kUsage,
                fmt::format("{}: its heights are in '{}', which is no unit of length that is known here, and they must "
                            "become metres: name their unit (--z-unit m, ft, us-ft, cm, fathom …), or give the factor "
                            "that makes metres of them (--z-scale F)",
                            info.path, unit.name));
  if (is_converted) info.warnings.push_back(words_of_metres(unit, info));
  if (is_converted && frame.unit_in_metres == 0 && info.has_georeference && info.crs.empty())
    info.warnings.push_back(
        fmt::format("x and y have no CRS and stay as they are, while heights become metres: give the raster its CRS "
                    "first ({}) if they are in another unit",
                    translate_command("-a_srs EPSG:CODE", info.path)));
  if (is_converted) {
    settled.z_scale *= unit.metres;
    if (of_file.name.empty()) info.file_unit = unit.name;
    unit = {"m", 1};
  }
  info.unit = info.unit_is_assumed && !is_converted ? "" : unit.name;
  info.unit_in_metres = unit.metres;
  if (!of_file.name.empty() && of_file.metres != unit.metres) info.file_unit = of_file.name;
  info.z_scale = settled.z_scale;
  info.z_offset = settled.z_offset;
  return settled;
}

void warn_of_units(const Frame& frame, RasterInfo& info) {
  const double across = frame.unit_in_metres, up = info.unit_in_metres;
  if (!(across > 0) || !(up > 0) || info.unit.empty() || std::abs(up / across - 1) < 1e-5) return;
  info.warnings.push_back(fmt::format(
      "z is in {} but x and y are in {}: if the shape matters, --z-scale {:.10g} makes them one unit", info.unit,
      frame.kind == Frame::Kind::kProjected || info.crs_unit.empty() ? fmt::format("units of {:.10g} m", across)
                                                                     : info.crs_unit,
      up / across));
}

double metres_in_file(const RasterInfo& info) {
  if (!info.file_unit.empty()) return find_metres(info.file_unit).value_or(0);
  const double factor = std::abs(info.z_scale);
  if (factor == 1 || !info.unit.empty()) return info.unit_in_metres;
  // A factor equal to a unit of length converts to metres; others only scale heights.
  const bool is_length =
      std::ranges::any_of(kLengths, [&](const NamedLength& length) { return is_about(factor, length.metres); });
  return is_length ? factor : info.unit_in_metres;
}

}  // namespace scarp::io
