#include "session/options/cutline_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/options/line_options.h"
#include "session/reports/report.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

std::uint64_t count_polygons(const std::vector<Line>& rings) {
  return static_cast<std::uint64_t>(
      std::count_if(rings.begin(), rings.end(), [](const Line& ring) { return ring.role == LineRole::kOuter; }));
}

/// Lengths of the CRS' units along x and y: metres where they are known.
std::array<double, 2> unit_of(const RasterInfo& raster) {
  const bool has_metres = raster.cell_x_m > 0 && raster.cell_y_m > 0 && raster.cell_x > 0 && raster.cell_y > 0;
  if (!has_metres) return {1, 1};
  return {raster.cell_x_m / raster.cell_x, raster.cell_y_m / raster.cell_y};
}

}  // namespace

void CutlineArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kCutline, files);
  add_option(command, OptionId::kInset, inset);
  add_flag(command, OptionId::kMaskOutside, mask_outside);
}

Result<void> CutlineArguments::check() const {
  const char* needing = inset ? "--inset" : mask_outside ? "--mask-outside" : nullptr;
  if (needing != nullptr && files.empty())
    return fail(ErrorKind::kUsage, fmt::format("{} needs --cutline: there is no polygon without", needing));
  if (!inset) return {};
  const Result<double> distance = parse_number("--inset", *inset);
  return distance ? Result<void>() : tl::unexpected(distance.error());
}

std::string CutlineArguments::canonical() const {
  std::string text;
  for (const std::string& file : files) text += " --cutline " + shell_word(base_name(file));
  return text + canonical_option("--inset", inset) + (mask_outside ? " --mask-outside" : "");
}

Result<Cut> read_cut(const CutlineArguments& given, const RasterInfo& raster, const ProgressCallback& progress,
                     OwnedHeightField& field, std::vector<std::string>& warnings) {
  Cut cut;
  if (given.files.empty()) return cut;
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.ignore_z = true;
  options.progress = progress;
  auto lines = read_files(given.files, options, warnings);
  if (!lines) return tl::unexpected(std::move(lines.error()));
  auto rings = close_rings(std::move(*lines));
  if (!rings) return tl::unexpected(std::move(rings.error()));
  cut.polygons = count_polygons(*rings);
  cut.cutline.affine = map_affine(raster, field.rows);
  cut.cutline.rings = std::move(*rings);
  if (given.inset) {
    const std::array<double, 2> unit = unit_of(raster);
    const double sample = std::min(raster.cell_x * unit[0], raster.cell_y * unit[1]);
    auto moved = inset_polygons(cut.cutline.rings, *parse_number("--inset", *given.inset), unit, sample);
    if (!moved) {
      moved.error().message = fmt::format("--inset {}: {}", shell_word(*given.inset), moved.error().message);
      return tl::unexpected(std::move(moved.error()));
    }
    if (moved->empty())
      return fail(ErrorKind::kInput, fmt::format("--inset {}: nothing of the polygons is left, they are not that wide",
                                                 shell_word(*given.inset)));
    cut.cutline.rings = std::move(*moved);
  }
  if (!given.mask_outside) return cut;
  const auto left = mask_outside(field, cut.cutline, progress);
  if (!left) return tl::unexpected(left.error());
  cut.masked = left->lost;
  cut.bytes = left->bytes;
  cut.cutline.rings = {};
  const bool is_empty = left->kept == 0;
  if (is_empty || (cut.masked > 0 && !left->has_surface))
    return fail(ErrorKind::kInput,
                fmt::format("--cutline {} --mask-outside: no {} of {} lies in the polygons{}",
                            shell_word(given.files.front()), is_empty ? "height" : "cell with three heights",
                            raster.path, is_empty ? "" : ": leave --mask-outside out to cut through cells"));
  return cut;
}

Json describe_cut(const CutlineArguments& given, const Cut& cut, std::uint64_t outside) {
  if (given.files.empty()) return nullptr;
  return Json{{"files", given.files},
              {"polygons", cut.polygons},
              {"inset", or_null(given.inset)},
              {"mask_outside", given.mask_outside},
              {"samples_outside", cut.masked + outside}};
}

std::string cut_words(const Cut& cut, std::uint64_t outside) {
  return fmt::format("{}, {} outside left out", format_plural(cut.polygons, "polygon"),
                     format_plural(cut.masked + outside, "sample"));
}

}  // namespace scarp::cli
