#include "session/options/points_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scarp/points.h"
#include "session/options/option_rules.h"
#include "session/text/point_classes.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr Choice<DuplicatePolicy> kPolicies[] = {{"first", DuplicatePolicy::kFirst},
                                                 {"last", DuplicatePolicy::kLast},
                                                 {"highest", DuplicatePolicy::kHighest},
                                                 {"lowest", DuplicatePolicy::kLowest},
                                                 {"mean", DuplicatePolicy::kMean}};

constexpr Choice<PointReturns> kReturnChoices[] = {{"all", PointReturns::kAll},
                                                   {"first", PointReturns::kFirst},
                                                   {"last", PointReturns::kLast},
                                                   {"only", PointReturns::kOnly}};

bool is_of_points(const GivenOptions& given, const std::string& path) {
  return given.has(kPoints) || given.has(kColumns) || is_point_file(path);
}

/// The classes of --class while it is parsed.
struct ClassList {
  std::bitset<256> wanted, unwanted;
  PointChoice choice;

  /// False for a word that names no class.
  bool add(std::string_view word) {
    if (word == "all") return true;
    if (word == "withheld") return choice.withheld = true;
    const bool is_unwanted = word.starts_with("no-");
    if (is_unwanted) word.remove_prefix(3);
    if (word == "overlap" && is_unwanted) {  // a flag, not only a class, in some formats
      choice.overlap = false;
      return true;
    }
    const std::vector<std::uint8_t> numbers = find_classes(word);
    for (const std::uint8_t number : numbers) (is_unwanted ? unwanted : wanted).set(number);
    return !numbers.empty();
  }

  PointChoice finish() {
    if (wanted.none() && unwanted.none()) return choice;
    if (wanted.none()) wanted.set();
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (wanted[k] && !unwanted[k]) choice.classes.push_back(static_cast<std::uint8_t>(k));
    }
    return choice;
  }
};

Result<PointChoice> parse_choice(const GivenOptions& given) {
  ClassList list;
  std::string_view rest = given[kClass] ? std::string_view(*given[kClass]) : "all";
  while (!rest.empty() || rest.data() != nullptr) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    if (const std::string_view word = rest.substr(0, end); !list.add(word))
      return fail(ErrorKind::kUsage,
                  fmt::format("{} {} has {}, which is no class: choose a number from 0 to 255, {} or withheld; no- in "
                              "front of one omits it",
                              kClass, shell_word(*given[kClass]),
                              word.empty() ? "an empty word" : shell_word(std::string(word)), list_class_names()));
    rest = end == rest.size() ? std::string_view() : rest.substr(end + 1);
  }
  PointChoice choice = list.finish();
  const bool is_empty = choice.classes.empty() && list.unwanted.any();
  if (is_empty)
    return fail(ErrorKind::kUsage, fmt::format("{} {} leaves no class", kClass, shell_word(*given[kClass])));
  SCARP_TRY(const auto returns, given.choice(kReturns, kReturnChoices));
  choice.returns = returns.value_or(PointReturns::kAll);
  return choice;
}

}  // namespace

Result<ReadPointsOptions> parse_points(const GivenOptions& given, const ReadOptions& as) {
  for (const OptionId id : {kLayer, kZField, kColumns, kClass}) {
    if (given[id] == "") return fail(ErrorKind::kUsage, fmt::format("{} is empty: omit it", id));
  }
  SCARP_TRY(const auto& choice, parse_choice(given));
  SCARP_TRY(const int threads, given.threads());
  return ReadPointsOptions{.layer = given[kLayer].value_or(""),
                           .z_field = given[kZField].value_or(""),
                           .crs = as.crs,
                           .progress = as.run.progress,
                           .columns = given[kColumns].value_or(""),
                           .nodata = as.nodata,
                           .z_scale = as.z_scale,
                           .z_offset = as.z_offset,
                           .z_unit = as.z_unit,
                           .heights_in = as.heights_in,
                           .default_frame = as.default_frame,
                           .extent = as.view.extent,
                           .choice = choice,
                           .threads = threads};
}

void name_others(std::size_t files, PointSet& points) {
  if (files > 1) points.path += fmt::format(" and {} more", files - 1);
}

Result<PointSet> read_inputs(const GivenOptions& given, const ReadPointsOptions& options) {
  const std::vector<std::string>& files = given.inputs();
  SCARP_TRY(PointSet points, read_points(files.front(), options));
  for (std::size_t k = 1; k < files.size(); ++k) {
    SCARP_TRY(const PointSet& more, read_points(files[k], options));
    SCARP_RETURN_IF_ERROR(append_points(more, points));
  }
  name_others(files.size(), points);
  for (const std::string& outline : points.outlines) {
    if (given.has(kBoundary)) break;
    points.warnings.push_back(fmt::format("{} is a boundary that is not applied: {} {} ends the mesh there", outline,
                                          kBoundary, shell_word(outline)));
  }
  return points;
}

bool are_points_meant(const GivenOptions& given) { return is_of_points(given, given.input()); }

Result<void> check_kind_of_input(const GivenOptions& given) {
  const std::string input = shell_word(base_name(given.input()));
  const bool are_points = are_points_meant(given);
  for (const std::string& path : given.inputs()) {
    if (is_of_points(given, path) == are_points) continue;
    const auto name = [](bool is_of_points) { return is_of_points ? "holds points" : "is read as a raster"; };
    return fail(ErrorKind::kUsage, fmt::format("{} {}, and {} {}: rasters are joined, and so are points, but not both",
                                               shell_word(path), name(!are_points), input, name(are_points)));
  }
  if (const Given& errors = given[kErrorRaster]; errors && errors->ends_with(".csv") != are_points)
    return fail(ErrorKind::kUsage,
                fmt::format("{} {}: {} {}", kErrorRaster, shell_word(*errors), input,
                            are_points ? "holds points, whose errors are a table: name it .csv"
                                       : "is read as a raster, whose errors are a raster: name it .tif"));
  if (are_points) {
    SCARP_RETURN_IF_ERROR(check_rules(given.command(), given, true));
  }
  for (const OptionRow* row : given.given()) {
    // The other options of tiles apply to the raster that is made of the points.
    const bool is_of_reading = given.command() != kTile || row->group == OptionGroup::kInput;
    if (are_points && !row->is_for_points && is_of_reading)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for rasters, and {} holds points: leave it out", row->title(), input));
    if (!are_points && row->group == OptionGroup::kPoints)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for scattered points, and {} is read as a raster: {} reads it as points",
                              row->title(), input, kPoints));
  }
  return {};
}

const char* policy_name(DuplicatePolicy policy) { return name_of(policy, kPolicies); }

Result<DuplicatePolicy> parse_policy(const GivenOptions& given) {
  SCARP_TRY(const auto policy, given.choice(kDuplicates, kPolicies));
  return policy.value_or(DuplicatePolicy::kFirst);
}

Result<BoundaryChoice> parse_boundary(const GivenOptions& given) {
  constexpr std::string_view kConcave = "concave:";
  const Given& text = given[kBoundary];
  if (!text || *text == "hull") return BoundaryChoice{};
  if (text->starts_with(kConcave)) {
    const Result<double> length = parse_number(name_of(kBoundary), text->substr(kConcave.size()));
    if (length && *length > 0) return BoundaryChoice{*length, ""};
  } else if (text->find('.') != std::string::npos) {
    return BoundaryChoice{std::nullopt, *text};
  }
  return fail(ErrorKind::kUsage, fmt::format("{} {} is neither hull nor concave:LENGTH, such as concave:50 (LENGTH is "
                                             "above 0, in the unit of x and y), nor "
                                             "a file of polygons, such as site.geojson",
                                             kBoundary, shell_word(*text)));
}

}  // namespace scarp::cli
