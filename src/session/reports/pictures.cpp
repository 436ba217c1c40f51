#include "session/reports/pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// The line's points as columns and rows of samples.
Mark mark_of(MarkKind kind, const Line& line, const std::array<double, 6>& affine) {
  const double det = affine[1] * affine[5] - affine[2] * affine[4];
  Mark mark{kind, {}};
  mark.points.reserve(line.points.size());
  for (const auto& point : line.points) {
    const double x = point[0] - affine[0], y = point[1] - affine[3];
    mark.points.push_back({(affine[5] * x - affine[2] * y) / det, (affine[1] * y - affine[4] * x) / det});
  }
  return mark;
}

MarkKind kind_of(const Line& line) {
  return line.kind == LineKind::kRiver ? MarkKind::kWater
         : is_wall(line)               ? MarkKind::kWall
         : is_ridge_line(line)         ? MarkKind::kRidge
                                       : MarkKind::kBreakline;
}

/// The size of a cell in metres; zeros if unknown.
std::array<double, 2> cell_metres(const RasterInfo& info) {
  return info.has_georeference && info.cell_x_m > 0 ? std::array{info.cell_x_m, info.cell_y_m} : std::array{0.0, 0.0};
}

}  // namespace

std::string short_unit(const std::string& unit) {
  const bool is_metre = unit == "metre" || unit == "meter" || unit == "metres" || unit == "meters";
  return is_metre ? "m" : unit;
}

PreviewOptions preview_options(const Outcome& outcome, int max_side) {
  PreviewOptions options{max_side, cell_metres(outcome.as_read), short_unit(outcome.as_read.unit), {}};
  const std::size_t given = outcome.features.breaklines.lines.size();
  const LineConstraints& lines = outcome.simplified.features.lines;
  for (std::size_t k = 0; k < lines.lines.size(); ++k) {
    const Line& line = lines.lines[k];
    const bool is_shore = k >= given && kind_of(line) == MarkKind::kBreakline;
    if (!is_shore) options.marks.push_back(mark_of(kind_of(line), line, lines.affine));
  }
  for (const Lake& lake : outcome.features.lakes) {
    for (const Line& ring : lake.shore)
      options.marks.push_back(mark_of(MarkKind::kLake, ring, outcome.features.breaklines.affine));
  }
  const Cutline& cut = outcome.cut.cutline;
  for (const Line& ring : cut.rings) options.marks.push_back(mark_of(MarkKind::kCutline, ring, cut.affine));
  return options;
}

ErrorMapOptions error_map_options(const RasterInfo& info, const std::string& unit, const std::string& mesh_path,
                                  int max_side) {
  ErrorMapOptions options;
  options.max_side = max_side;
  options.cell = cell_metres(info);
  options.unit = unit;
  options.title = fmt::format("{} minus {}", base_name(mesh_path), base_name(info.path));
  return options;
}

}  // namespace scarp::cli
