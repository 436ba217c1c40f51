#include "session/inputs/lines.h"

#include <fmt/format.h>

#include <utility>

#include "io/commands.h"
#include "scarp/lines.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {
using enum OptionId;
}

Result<std::vector<Line>> read_files(const std::vector<std::string>& files, const ReadLinesOptions& options,
                                     std::vector<std::string>& warnings) {
  auto set = read_lines(files, options);
  if (!set) return tl::unexpected(std::move(set.error()));
  warnings.insert(warnings.end(), set->warnings.begin(), set->warnings.end());
  return std::move(set->lines);
}

Result<LineConstraints> read_breaklines(const GivenOptions& given, const RasterInfo& raster, int rows,
                                        const ProgressCallback& progress, std::vector<std::string>& warnings) {
  LineConstraints constraints;
  constraints.affine = map_affine(raster, rows);
  constraints.conflict = conflict_rule(given).value_or(constraints.conflict);
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.z_field = given[OptionId::kBreaklineZ].value_or("");
  options.ignore_z = given.has(OptionId::kSoftBreaklines);
  options.progress = progress;
  auto set = read_lines(given.all(kBreaklines), options, raster);
  if (!set) return tl::unexpected(std::move(set.error()));
  warnings.insert(warnings.end(), set->warnings.begin(), set->warnings.end());
  constraints.lines = std::move(set->lines);
  // Lines have heights in their file's unit, like the raster.
  for (Line& each : constraints.lines) {
    for (auto& point : each.points) point[2] = raster.z_scale * point[2] + raster.z_offset;
  }
  return constraints;
}

Result<void> check_frame_of_lines(const std::string& lines, const Frame& frame, const std::string& crs_option,
                                  const std::string& input) {
  if (lines.empty() || frame.is_affine()) return {};
  const std::string crs = shell_word(crs_option);
  return fail(
      ErrorKind::kUsage,
      fmt::format(
          "{} cannot be combined with {} {}: lines are inserted where the grid is regular, and in that CRS it is "
          "bent. Omit {}, or bend the raster first ({})",
          lines, OptionId::kCrs, crs, OptionId::kCrs, io::warp_command("-t_srs " + crs, input)));
}

}  // namespace scarp::cli
