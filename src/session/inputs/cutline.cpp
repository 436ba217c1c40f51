#include "session/inputs/cutline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scarp/lines.h"
#include "session/inputs/lines.h"
#include "session/options/values.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

std::uint64_t count_polygons(const std::vector<Line>& rings) {
  return static_cast<std::uint64_t>(
      std::count_if(rings.begin(), rings.end(), [](const Line& ring) { return ring.role == LineRole::kOuter; }));
}

/// Lengths of the CRS' units along x and y, in metres if known.
std::array<double, 2> unit_of(const RasterInfo& raster) {
  const bool has_metres = raster.cell_x_m > 0 && raster.cell_y_m > 0 && raster.cell_x > 0 && raster.cell_y > 0;
  if (!has_metres) return {1, 1};
  return {raster.cell_x_m / raster.cell_x, raster.cell_y_m / raster.cell_y};
}

}  // namespace

Result<Cut> read_cut(const GivenOptions& given, const RasterInfo& raster, const ProgressCallback& progress,
                     OwnedHeightField& field, std::vector<std::string>& warnings) {
  Cut cut;
  if (!given.has(kCutline)) return cut;
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.ignore_z = true;
  options.progress = progress;
  SCARP_TRY(auto&& lines, read_files(given.all(kCutline), options, warnings));
  SCARP_TRY(auto&& rings, close_rings(std::move(lines)));
  cut.polygons = count_polygons(rings);
  cut.cutline.affine = map_affine(raster, field.rows);
  cut.cutline.rings = std::move(rings);
  if (given.has(kInset)) {
    const std::array<double, 2> unit = unit_of(raster);
    const double sample = std::min(raster.cell_x * unit[0], raster.cell_y * unit[1]);
    auto moved = inset_polygons(cut.cutline.rings, **given.number(kInset), unit, sample);
    if (!moved) {
      moved.error().message = fmt::format("{} {}: {}", kInset, shell_word(*given[kInset]), moved.error().message);
      return tl::unexpected(std::move(moved.error()));
    }
    if (moved->empty())
      return fail(ErrorKind::kInput, fmt::format("{} {}: nothing of the polygons is left, they are not that wide",
                                                 kInset, shell_word(*given[kInset])));
    cut.cutline.rings = std::move(*moved);
  }
  if (!given.has(kMaskOutside)) return cut;
  SCARP_TRY(const auto& left, mask_outside(field, cut.cutline, progress));
  cut.masked = left.lost;
  cut.bytes = left.bytes;
  cut.cutline.rings = {};
  const bool is_empty = left.kept == 0;
  if (is_empty || (cut.masked > 0 && !left.has_surface))
    return fail(
        ErrorKind::kInput,
        fmt::format("{} {},{}: no {} of {} lies in the polygons{}", kCutline, shell_word(given.all(kCutline).front()),
                    find_option(kSimplify, kMaskOutside)->key, is_empty ? "height" : "cell with three heights",
                    raster.path, is_empty ? "" : fmt::format(": omit {} to cut through cells", kMaskOutside)));
  return cut;
}

}  // namespace scarp::cli
