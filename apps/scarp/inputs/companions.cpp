#include "inputs/companions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "options/memory.h"
#include "options/option_table.h"
#include "scarp/regions.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

/// The raster's values, with the option that named the file in every complaint.
Result<OwnedHeightField> read_values(const char* option, const std::string& path, const RasterInfo& raster, int cols,
                                     int rows, const ProgressCallback& progress) {
  ReadOptions options;
  options.crs = "grid";
  options.progress = progress;
  Result<OwnedHeightField> values = read_height_field(path, options);
  if (!values) {
    if (values.error().kind == ErrorKind::kInput) {
      values.error().message = fmt::format("{}: {}", option, values.error().message);
    }
    return values;
  }
  const Result<void> fits = check_grid(raster, cols, rows, option, values->info, values->cols, values->rows);
  if (!fits) return tl::unexpected(fits.error());
  const auto negative = std::find_if(values->samples.begin(), values->samples.end(), [](float v) { return v < 0; });
  if (negative != values->samples.end()) {
    const std::ptrdiff_t at = negative - values->samples.begin();
    return refuse_negative(option, path, *negative, at % cols, at / cols);
  }
  return values;
}

Result<std::vector<float>> make_mask(OwnedHeightField values) {
  float largest = 0;
  for (float& weight : values.samples) {
    if (std::isnan(weight)) weight = 0;
    largest = std::max(largest, weight);
  }
  if (largest == 0) {
    return fail(ErrorKind::kInput,
                fmt::format("--mask {}: no weight is above 0, so no sample would have a bound", values.info.path));
  }
  if (largest > 1) {
    for (float& weight : values.samples) weight /= largest;
  }
  return std::move(values.samples);
}

std::vector<float> make_tolerance(OwnedHeightField values) {
  const bool is_rounded = values.sample_rounding > 0;
  for (float& bound : values.samples) bound = bound_of_value(bound, is_rounded);
  return std::move(values.samples);
}

/// A command that brings a raster onto the grid of `raster`.
std::string suggest_command(const RasterInfo& raster, int cols, int rows, const RasterInfo& other) {
  const std::string file = shell_word(base_name(other.path));
  const std::array<double, 6>& g = raster.geotransform;
  const bool is_upright = g[2] == 0 && g[4] == 0 && g[1] > 0 && g[5] < 0;
  if (!raster.has_georeference || !other.has_georeference || !is_upright) {
    return fmt::format("gdal_translate -outsize {} {} {} aligned.tif", cols, rows, file);
  }
  const std::string crs = raster.crs.empty() || raster.crs.size() > 40 || raster.crs == other.crs
                              ? ""
                              : fmt::format("-t_srs {} ", shell_word(raster.crs));
  return fmt::format("gdalwarp {}-te {} {} {} {} -ts {} {} -r bilinear {} aligned.tif", crs, g[0], g[3] + g[5] * rows,
                     g[0] + g[1] * cols, g[3], cols, rows, file);
}

struct RegionFile {
  std::string path;  ///< with the layer
  double tolerance;
};

Result<RegionFile> parse_region(const std::string& text) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0)
    return fail(ErrorKind::kUsage,
                fmt::format("--roi {}: behind the file an error is missing, such as {}=0.2", shell_word(text), text));
  const Result<double> tolerance = parse_non_negative("--roi FILE=", text.substr(at + 1));
  if (!tolerance) return tl::unexpected(tolerance.error());
  return RegionFile{text.substr(0, at), *tolerance};
}

/// In the order of CompanionArguments::roi.
Result<std::vector<Region>> read_regions(const CompanionArguments& given, const RasterInfo& raster,
                                         const ProgressCallback& progress, Companions& companions) {
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.ignore_z = true;
  options.progress = progress;
  std::vector<Region> regions;
  for (const std::string& text : given.roi) {
    const Result<RegionFile> file = parse_region(text);
    if (!file) return tl::unexpected(file.error());
    auto set = read_lines(file->path, options);
    if (!set) return tl::unexpected(std::move(set.error()));
    companions.warnings.insert(companions.warnings.end(), set->warnings.begin(), set->warnings.end());
    regions.push_back({std::move(set->lines), file->tolerance});
  }
  return regions;
}

RegionGrid grid_of(const CompanionArguments& given, const RasterInfo& raster, const OwnedHeightField& field,
                   std::optional<double> bound) {
  RegionGrid grid{field.cols, field.rows, map_affine(raster, field.rows)};
  const bool has_metres = raster.cell_x_m > 0 && raster.cell_y_m > 0;
  grid.cell_x = has_metres ? raster.cell_x_m : raster.cell_x;
  grid.cell_y = has_metres ? raster.cell_y_m : raster.cell_y;
  grid.beyond = bound;
  if (given.falloff) grid.falloff = *parse_non_negative("--falloff", *given.falloff);
  return grid;
}

void warn_of_missing(const CompanionArguments& given, const std::vector<bool>& found, Companions& companions) {
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k])
      companions.warnings.push_back(fmt::format("--roi {} lies beside the raster: it changes nothing", given.roi[k]));
  }
}

/// Lowers the tolerances in and around the regions.
Result<void> add_regions(const CompanionArguments& given, const RasterInfo& raster, const OwnedHeightField& field,
                         std::optional<double> bound, const ProgressCallback& progress, Companions& companions) {
  const auto regions = read_regions(given, raster, progress, companions);
  if (!regions) return tl::unexpected(regions.error());
  std::vector<bool> found;
  std::vector<float> bounds = region_tolerances(*regions, grid_of(given, raster, field, bound), &found);
  warn_of_missing(given, found, companions);
  if (companions.tolerance.empty()) {
    companions.tolerance = std::move(bounds);
  } else {
    std::transform(bounds.begin(), bounds.end(), companions.tolerance.begin(), companions.tolerance.begin(),
                   [](float a, float b) { return std::min(a, b); });
  }
  return {};
}

/// The regions' bounds and what making them takes.
Result<BoundsInWindows> make_regions(const CompanionArguments& given, const RasterInfo& raster,
                                     const OwnedHeightField& field, std::optional<double> bound,
                                     const CompanionRun& run, Companions& companions) {
  const auto regions = read_regions(given, raster, run.progress, companions);
  if (!regions) return tl::unexpected(regions.error());
  std::uint64_t vertices = 0;
  for (const Region& region : *regions) {
    for (const Line& line : region.lines) vertices += line.points.size();
  }
  constexpr std::uint64_t kBytesPerVertex = 100;
  if (auto fits = check_room(field, run.memory, kBytesPerVertex * vertices, "--roi"); !fits)
    return tl::unexpected(fits.error());
  RegionBounds bounds = make_region_bounds(*regions, grid_of(given, raster, field, bound), run.threads);
  warn_of_missing(given, bounds.found, companions);
  return BoundsInWindows{std::move(bounds.source), bounds.bytes, !bound};
}

/// The bounds of heights that are not in memory.
Result<void> read_in_windows(const CompanionArguments& given, const RasterInfo& raster, const OwnedHeightField& field,
                             std::optional<double> bound, const CompanionRun& run, Companions& companions) {
  BoundsInWindows& bounds = companions.in_windows;
  if (given.tolerance) {
    auto opened =
        open_tolerances("--tolerance", *given.tolerance, raster, field, run.memory, run.progress, companions.warnings);
    if (!opened) return tl::unexpected(std::move(opened.error()));
    bounds = std::move(*opened);
  }
  if (!given.roi.empty()) {
    auto regions = make_regions(given, raster, field, bound, run, companions);
    if (!regions) return tl::unexpected(std::move(regions.error()));
    bounds = bounds.source ? least_of(*regions, bounds) : std::move(*regions);
  }
  return check_room(field, run.memory, bounds.bytes, given.find_tolerance());
}

}  // namespace

void CompanionArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kMask, mask);
  add_option(command, OptionId::kTolerance, tolerance);
  add_option(command, OptionId::kRoi, roi);
  add_option(command, OptionId::kFalloff, falloff);
  add_option(command, OptionId::kScript, script);
}

const char* CompanionArguments::find_tolerance() const {
  if (tolerance) return "--tolerance";
  return roi.empty() ? nullptr : "--roi";
}

Result<void> CompanionArguments::check(const char* bound_option, bool has_bound) const {
  for (const std::string& text : roi) {
    if (const auto region = parse_region(text); !region) return tl::unexpected(region.error());
  }
  if (mask && !roi.empty())
    return fail(ErrorKind::kUsage, "--mask and --roi contradict each other: regions have errors, not weights");
  if (falloff) {
    if (const auto distance = parse_non_negative("--falloff", *falloff); !distance)
      return tl::unexpected(distance.error());
    if (roi.empty())
      return fail(ErrorKind::kUsage, "--falloff needs --roi: there is no region that it could be around");
    if (!has_bound)
      return fail(ErrorKind::kUsage,
                  fmt::format("--falloff needs {}: the bound of a region grows to that", bound_option));
  }
  if (mask && tolerance) {
    return fail(ErrorKind::kUsage,
                "--mask and --tolerance contradict each other: divide the bound by the weights into one tolerance");
  }
  return {};
}

std::vector<std::string> CompanionArguments::files() const {
  std::vector<std::string> files;
  for (const Given* file : {&mask, &tolerance, &script}) {
    if (*file) files.push_back(**file);
  }
  for (const std::string& text : roi) {
    if (const auto region = parse_region(text)) files.push_back(region->path);
  }
  return files;
}

std::string CompanionArguments::canonical() const {
  std::string command;
  const std::pair<const char*, const Given*> options[] = {
      {"--mask", &mask}, {"--tolerance", &tolerance}, {"--script", &script}};
  for (const auto& [name, file] : options) {
    if (*file) command += canonical_option(name, base_name(**file));
  }
  for (const std::string& text : roi) command += " --roi " + shell_word(base_name(text));
  return command + canonical_option("--falloff", falloff);
}

bool Companions::ignores_samples() const {
  return std::any_of(script.begin(), script.end(),
                     [](const ScriptStep& step) { return step.action == ScriptStep::Action::kIgnore; });
}

Exceptions find_exceptions(const HeightField& heights, const Companions& companions, bool has_max_error) {
  Exceptions found;
  if (!companions.has_weights() && !companions.ignores_samples()) return found;
  if (companions.in_windows.source) {
    if (companions.in_windows.may_lack && !has_max_error) found.source = limits_of(companions.in_windows.source);
    return found;
  }
  constexpr float kNone = std::numeric_limits<float>::infinity();
  const auto cols = static_cast<std::size_t>(heights.cols);
  found.limits.resize(cols * static_cast<std::size_t>(heights.rows), 0);
  for (std::size_t k = 0; k < companions.mask.size(); ++k) {
    if (companions.mask[k] == 0) found.limits[k] = kNone;
  }
  for (std::size_t k = 0; k < companions.tolerance.size() && !has_max_error; ++k) {
    if (std::isinf(companions.tolerance[k])) found.limits[k] = kNone;
  }
  for (const ScriptStep& step : companions.script) {
    if (step.action != ScriptStep::Action::kIgnore) continue;
    found.limits[static_cast<std::size_t>(step.row) * cols + static_cast<std::size_t>(step.col)] = kNone;
  }
  for (std::size_t k = 0; k < found.limits.size(); ++k) {
    found.count += found.limits[k] > 0 && std::isfinite(heights.samples[k]);
  }
  if (found.count == 0) found.limits.clear();
  return found;
}

Result<Companions> read_companions(const CompanionArguments& given, const RasterInfo& raster,
                                   const OwnedHeightField& field, std::optional<double> bound,
                                   const CompanionRun& run) {
  Companions companions;
  const int cols = field.cols, rows = field.rows;
  const ProgressCallback& progress = run.progress;
  const bool is_in_windows = field.source && given.find_tolerance() != nullptr;
  if (is_in_windows) {
    const Result<void> read = read_in_windows(given, raster, field, bound, run, companions);
    if (!read) return tl::unexpected(read.error());
  }
  if (given.mask) {
    Result<OwnedHeightField> values = read_values("--mask", *given.mask, raster, cols, rows, progress);
    if (!values) return tl::unexpected(std::move(values.error()));
    companions.warnings = values->info.warnings;
    Result<std::vector<float>> mask = make_mask(std::move(*values));
    if (!mask) return tl::unexpected(std::move(mask.error()));
    companions.mask = std::move(*mask);
  }
  if (given.tolerance && !is_in_windows) {
    Result<OwnedHeightField> values = read_values("--tolerance", *given.tolerance, raster, cols, rows, progress);
    if (!values) return tl::unexpected(std::move(values.error()));
    companions.warnings.insert(companions.warnings.end(), values->info.warnings.begin(), values->info.warnings.end());
    companions.tolerance = make_tolerance(std::move(*values));
  }
  if (!given.roi.empty() && !is_in_windows) {
    const Result<void> read = add_regions(given, raster, field, bound, progress, companions);
    if (!read) return tl::unexpected(read.error());
  }
  if (given.script) {
    Result<std::vector<ScriptStep>> script = read_script(*given.script, cols, rows);
    if (!script) return tl::unexpected(std::move(script.error()));
    companions.script = std::move(*script);
    if (companions.script.empty()) {
      companions.warnings.push_back(fmt::format("--script {} holds no step: it changes nothing", *given.script));
    }
  }
  return companions;
}

Result<void> check_grid(const RasterInfo& raster, int cols, int rows, const char* option, const RasterInfo& other,
                        int other_cols, int other_rows) {
  const std::optional<std::string> difference = find_grid_difference(raster, cols, rows, other, other_cols, other_rows);
  if (!difference) return {};
  return fail(ErrorKind::kInput,
              fmt::format("{} {} {}: bring it onto the grid of {}, for example with {}", option, other.path,
                          *difference, raster.path, suggest_command(raster, cols, rows, other)));
}

}  // namespace scarp::cli
