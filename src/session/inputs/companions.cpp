#include "session/inputs/companions.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "io/commands.h"
#include "scarp/lines.h"
#include "session/inputs/memory.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Prefixes the error with the option that named a file, as in "--tolerance FILE".
tl::unexpected<Error> name_option(OptionId option, const char* between, Error error) {
  if (error.kind == ErrorKind::kInput) error.message = fmt::format("{}{}{}", option, between, error.message);
  return tl::unexpected(std::move(error));
}

/// The values on the grid of `raster`, entirely in memory or within the limit.
Result<OwnedHeightField> read_values(OptionId option, const std::string& path, const RasterInfo& raster,
                                     const OwnedHeightField& field, const CompanionRun& run, bool in_windows,
                                     double scale = 1) {
  ReadOptions options;
  options.crs = "grid";
  options.as_values = true;
  options.z_scale = scale;
  options.run.progress = run.progress;
  Result<OwnedHeightField> values =
      in_windows ? read_beside(path, options, run.memory) : read_height_field(path, options);
  if (!values) return name_option(option, ": ", std::move(values.error()));
  SCARP_RETURN_IF_ERROR(
      check_grid(raster, field.cols, field.rows, name_of(option), values->info, values->cols, values->rows));
  return values;
}

void add_warnings(const OwnedHeightField& values, Companions& companions) {
  companions.warnings.insert(companions.warnings.end(), values.info.warnings.begin(), values.info.warnings.end());
}

/// A command that resamples a raster to the grid of `raster`.
std::string suggest_command(const RasterInfo& raster, int cols, int rows, const RasterInfo& other, int other_cols,
                            int other_rows) {
  const std::string file = shell_word(other.path);
  const std::array<double, 6>& g = raster.geotransform;
  const bool is_upright = g[2] == 0 && g[4] == 0 && g[1] > 0 && g[5] < 0;
  if (!raster.has_georeference || !other.has_georeference || !is_upright) {
    return fmt::format("gdal_translate -r bilinear -outsize {} {} {} {}", cols, rows, file, io::new_file(".tif"));
  }
  const std::string crs =
      raster.crs.empty() || raster.crs == other.crs ? "" : fmt::format("-t_srs {} ", shell_word(raster.crs));
  const double east = g[0] + g[1] * cols, south = g[3] + g[5] * rows;
  const std::array<double, 6>& o = other.geotransform;
  const bool is_covered = crs.empty() && o[2] == 0 && o[4] == 0 && o[1] > 0 && o[5] < 0 && o[0] <= g[0] &&
                          o[3] >= g[3] && o[0] + o[1] * other_cols >= east && o[3] + o[5] * other_rows <= south;
  // Without this, gdalwarp writes 0 outside.
  const char* beyond = is_covered ? "" : "-ot Float32 -dstnodata nan ";
  return fmt::format("gdalwarp {}-te {} {} {} {} -ts {} {} -r bilinear {}{} {}", crs, g[0], south, east, g[3], cols,
                     rows, beyond, file, io::new_file(".tif"));
}

/// The regions of --roi, in the order given.
Result<std::vector<Region>> read_regions(const GivenOptions& given, const RasterInfo& raster,
                                         const ProgressCallback& progress, Companions& companions) {
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.ignore_z = true;
  options.progress = progress;
  std::vector<Region> regions;
  for (const std::string& text : given.all(kRoi)) {
    SCARP_TRY(const RegionFile& file, settle_region(text, raster, companions.warnings));
    SCARP_TRY(auto&& set, read_lines(file.path, options));
    companions.warnings.insert(companions.warnings.end(), set.warnings.begin(), set.warnings.end());
    regions.push_back({std::move(set.lines), file.tolerance.value});
  }
  return regions;
}

Result<RegionGrid> grid_of(const GivenOptions& given, const RasterInfo& raster, const OwnedHeightField& field,
                           std::optional<double> bound) {
  RegionGrid grid{field.cols, field.rows, map_affine(raster, field.rows)};
  const bool has_metres = raster.cell_x_m > 0 && raster.cell_y_m > 0;
  grid.cell_x = has_metres ? raster.cell_x_m : raster.cell_x;
  grid.cell_y = has_metres ? raster.cell_y_m : raster.cell_y;
  grid.beyond = bound;
  SCARP_TRY(grid.falloff, read_falloff(given, has_metres));
  return grid;
}

void warn_of_missing(const GivenOptions& given, const std::vector<bool>& found, Companions& companions) {
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k])
      companions.warnings.push_back(
          fmt::format("{} {} lies beside the raster: it changes nothing", kRoi, given.all(kRoi)[k]));
  }
}

/// Fails if the regions do not fit in memory next to heights with a source.
Result<void> check_regions(const OwnedHeightField& field, const std::vector<Region>& regions, std::uint64_t memory) {
  std::uint64_t vertices = 0;
  for (const Region& region : regions) {
    for (const Line& line : region.lines) vertices += line.points.size();
  }
  constexpr std::uint64_t kBytesPerVertex = 100;
  return check_room(field, memory, kBytesPerVertex * vertices, name_of(kRoi));
}

/// Reads the tolerances of --tolerance and --roi, in windows like the heights.
Result<void> read_tolerances(const GivenOptions& given, const RasterInfo& raster, const OwnedHeightField& field,
                             std::optional<double> bound, const CompanionRun& run, Companions& companions) {
  const bool in_windows = field.source != nullptr;
  std::optional<OwnedHeightField> values;
  std::uint64_t bytes = 0;
  if (given.has(kTolerance)) {
    SCARP_TRY(auto&& read, read_values(kTolerance, *given[kTolerance], raster, field, run, in_windows));
    if (const double scale = units_of(read.info, raster); scale != 1) {
      SCARP_TRY(read, read_values(kTolerance, *given[kTolerance], raster, field, run, in_windows, scale));
    }
    add_warnings(read, companions);
    if (in_windows) bytes = bytes_beside(read, field, run.memory);
    values = std::move(read);
  }
  SCARP_TRY(const auto& regions, read_regions(given, raster, run.progress, companions));
  if (in_windows && !regions.empty()) {
    SCARP_RETURN_IF_ERROR(check_regions(field, regions, run.memory));
  }
  SCARP_TRY(const auto& grid, grid_of(given, raster, field, bound));
  auto made = make_tolerances(std::move(values), regions, grid, {in_windows, {run.threads, {}, run.progress}});
  if (!made) return name_option(kTolerance, " ", std::move(made.error()));
  if (given.has(kTolerance) && !made->has_values) {
    companions.warnings.push_back(
        fmt::format("{} {} holds no value: it changes nothing", kTolerance, *given[kTolerance]));
    if (regions.empty()) return {};
  }
  warn_of_missing(given, made->found, companions);
  companions.bytes += made->bytes + bytes;
  companions.tolerances = std::move(*made);
  return in_windows ? check_room(field, run.memory, companions.bytes, name_of(*find_tolerance(given))) : Result<void>();
}

/// Reads the weights of --mask, in windows like the heights.
Result<void> read_weights(const std::string& path, const RasterInfo& raster, const OwnedHeightField& field,
                          const CompanionRun& run, Companions& companions) {
  const bool in_windows = field.source != nullptr;
  SCARP_TRY(OwnedHeightField values, read_values(kMask, path, raster, field, run, in_windows));
  add_warnings(values, companions);
  if (in_windows) {
    companions.bytes += bytes_beside(values, field, run.memory);
    SCARP_RETURN_IF_ERROR(check_room(field, run.memory, companions.bytes, name_of(kMask)));
  }
  Result<OwnedWeights> mask = make_weights(std::move(values), {in_windows, {run.threads, {}, run.progress}});
  if (!mask) return name_option(kMask, " ", std::move(mask.error()));
  companions.mask = std::move(*mask);
  return {};
}

/// Reads the steps of --script, which use memory in addition to heights with a source.
Result<void> read_steps(const std::string& path, const OwnedHeightField& field, const CompanionRun& run,
                        Companions& companions) {
  SCARP_TRY(companions.script, read_script(path, field.cols, field.rows));
  if (companions.script.size() == 0)
    companions.warnings.push_back(fmt::format("{} {} holds no step: it changes nothing", kScript, path));
  if (!field.source) return {};
  constexpr std::uint64_t kBytesToRead = 100, kBytesPerStep = 24;
  const std::uint64_t before = companions.bytes, steps = companions.script.size();
  companions.bytes += kBytesPerStep * steps;
  return check_room(field, run.memory, before + kBytesToRead * steps, name_of(kScript));
}

}  // namespace

double units_of(const RasterInfo& values, const RasterInfo& heights) {
  const bool are_known = !values.unit.empty() && values.unit_in_metres > 0 && heights.unit_in_metres > 0;
  return are_known && values.unit_in_metres != heights.unit_in_metres ? values.unit_in_metres / heights.unit_in_metres
                                                                      : 1;
}

Tolerances Companions::bounds() const {
  return {tolerances.values, tolerances.source.get(), mask.values, mask.source.get(), script.ignored};
}

Result<Companions> read_companions(const GivenOptions& given, const RasterInfo& raster, const OwnedHeightField& field,
                                   std::optional<double> bound, const CompanionRun& run) {
  Companions companions;
  if (given.has(kMask)) {
    SCARP_RETURN_IF_ERROR(read_weights(*given[kMask], raster, field, run, companions));
  }
  if (find_tolerance(given)) {
    SCARP_RETURN_IF_ERROR(read_tolerances(given, raster, field, bound, run, companions));
  }
  if (given.has(kScript)) {
    SCARP_RETURN_IF_ERROR(read_steps(*given[kScript], field, run, companions));
  }
  return companions;
}

Result<void> check_grid(const RasterInfo& raster, int cols, int rows, const std::string& option,
                        const RasterInfo& other, int other_cols, int other_rows) {
  const std::optional<std::string> difference = find_grid_difference(raster, cols, rows, other, other_cols, other_rows);
  if (!difference) return {};
  return fail(ErrorKind::kInput,
              fmt::format("{} {} {}: bring it onto the grid of {} first ({})", option, other.path, *difference,
                          raster.path, suggest_command(raster, cols, rows, other, other_cols, other_rows)));
}

}  // namespace scarp::cli
