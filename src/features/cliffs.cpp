#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/memory_budget.h"
#include "features/crack_chains.h"
#include "features/wall_lines.h"
#include "grid/bands.h"
#include "grid/line_marks.h"
#include "grid/samples.h"
#include "scarp/features.h"

namespace scarp {
namespace {

/// Share of the max error by which samples may differ from a line. A smaller share costs more vertices; a larger one
/// gives refinement no margin.
constexpr double kCliffShare = 0.9;

Line to_map(const std::vector<features::WallVertex>& vertices, const std::array<double, 6>& affine, std::string name) {
  Line line;
  line.kind = LineKind::kWall;
  line.name = std::move(name);
  line.points.reserve(vertices.size());
  for (const features::WallVertex& v : vertices) {
    const double col = v.at.x / double{grid::kLatticeSteps}, row = v.at.y / double{grid::kLatticeSteps};
    line.points.push_back({affine[0] + affine[1] * col + affine[2] * row, affine[3] + affine[4] * col + affine[5] * row,
                           double{v.height}});
  }
  return line;
}

Result<void> check_cliffs(const CliffOptions& options) {
  if (!(options.height > 0 && std::isfinite(options.height)))
    return fail(ErrorKind::kUsage,
                fmt::format("the height of cliffs must be a finite number above 0, not {}", options.height));
  if (!(options.max_error >= 0 && std::isfinite(options.max_error)))
    return fail(
        ErrorKind::kUsage,
        fmt::format("the max error beside cliffs must be a finite number of at least 0, not {}", options.max_error));
  return {};
}

constexpr std::uint64_t kBytesPerLine = 3 * sizeof(Line);  // position, name, and spare capacity of the list
constexpr const char *kWhat = "walls", *kAdvice = "a larger height of cliffs";

Result<features::CrackChains> find_cracks(const HeightField& field, double height, const grid::SampleSet& marks,
                                          const MemoryBudget& memory) {
  features::CrackChains cracks(field.cols, field.rows, height, [&marks](Point p) { return marks.has(p); });
  const std::uint64_t bytes = grid::sweep_bytes(field, 1);
  auto swept = grid::sweep_rows(field, 1, [&](const grid::RowRange& strip) {
    for (std::int32_t row = strip.begin; row < strip.end; ++row)
      cracks.add_row(row, row > 0 ? strip.row(row - 1) : nullptr, strip.row(row),
                     row + 1 < field.rows ? strip.row(row + 1) : nullptr);
    return memory.check_part(bytes + features::CrackChains::kBytesPerCrack * cracks.count(),
                             static_cast<double>(strip.end) / field.rows, kWhat, kAdvice);
  });
  SCARP_RETURN_IF_ERROR(swept);
  return cracks;
}

}  // namespace

Result<Cliffs> detect_cliffs(const HeightField& field, const CliffOptions& options) {
  SCARP_RETURN_IF_ERROR(check_cliffs(options));
  SCARP_RETURN_IF_ERROR(grid::check_size(field));
  Cliffs cliffs;
  // The finer lattice of lines must fit.
  if (std::max(field.cols, field.rows) > kMaxCoordinate / grid::kLatticeSteps) return cliffs;
  grid::LineRuns runs(options.affine, field.cols, field.rows);
  for (const Line& line : options.avoid) runs.add_course(line);
  const grid::SampleSet marks(runs.runs(), field.rows);
  MemoryBudget memory;
  if (field.samples == nullptr) memory = {options.run.memory.limit, options.run.memory.taken, 0};
  SCARP_TRY(auto&& cracks, find_cracks(field, options.height, marks, memory));
  cracks.link();
  std::uint64_t line_bytes = 0;
  Result<void> fits;
  cracks.visit([&](const features::CrackChain& chain) {
    if (!fits) return;
    fits = memory.check_part(features::CrackChains::kBytesPerCrack * cracks.count() + line_bytes +
                                 features::kWallBytesPerCrack * chain.cracks.size(),
                             1, kWhat, kAdvice);
    if (!fits) return;
    for (const features::Wall& wall : features::find_walls(chain, kCliffShare * options.max_error)) {
      ++cliffs.wall_count;
      cliffs.vertices += 2 * (wall.top.size() - (wall.top.front() == wall.top.back() ? 1 : 0));
      for (const auto& [line, side] : {std::pair{&wall.top, "top"}, std::pair{&wall.foot, "foot"}}) {
        cliffs.lines.push_back(
            to_map(*line, options.affine, fmt::format("the {} of cliff {}", side, cliffs.wall_count)));
        line_bytes += kBytesPerLine + sizeof(cliffs.lines.back().points[0]) * line->size();
      }
    }
  });
  SCARP_RETURN_IF_ERROR(fits);
  return cliffs;
}

}  // namespace scarp
