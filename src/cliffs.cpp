#include "scarp/cliffs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "crack_chains.h"
#include "fault_lines.h"
#include "line_marks.h"
#include "refine/samples.h"

namespace scarp {
namespace {

/// Share of the max error that heights of samples along a line may leave it by: less leaves more vertices, more leaves
/// refinement no room.
constexpr double kHeightShare = 0.9;

Line to_map(const std::vector<FaultVertex>& vertices, const std::array<double, 6>& affine, std::string name) {
  Line line;
  line.polygon = kFaultLine;
  line.yields = true;
  line.name = std::move(name);
  for (const FaultVertex& v : vertices) {
    const double col = v.at.x / double{kLatticeSteps}, row = v.at.y / double{kLatticeSteps};
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

}  // namespace

Result<Cliffs> detect_cliffs(const HeightField& field, const CliffOptions& options) {
  if (auto sound = check_cliffs(options); !sound) return tl::unexpected(sound.error());
  const auto samples = Samples::of(field);
  if (!samples) return tl::unexpected(samples.error());
  const Raster raster = samples->raster();
  Cliffs cliffs;
  // Lines on a finer lattice need room.
  if (std::max(raster.cols, raster.rows) > kMaxCoordinate / kLatticeSteps) return cliffs;
  std::optional<LineMarks> marks;
  if (!options.avoid.empty()) marks.emplace(options.affine, raster.cols, raster.rows);
  for (const Line& line : options.avoid) marks->add_course(line);
  const auto is_left_out = [&](Point p) {
    return marks && marks->has(static_cast<std::size_t>(p.y) * static_cast<std::size_t>(raster.cols) +
                               static_cast<std::size_t>(p.x));
  };
  for (const CrackChain& chain : find_crack_chains(raster, options.height, is_left_out)) {
    for (const Fault& fault : find_faults(raster, chain, kHeightShare * options.max_error)) {
      ++cliffs.faults;
      cliffs.vertices += 2 * (fault.top.size() - (fault.top.front() == fault.top.back() ? 1 : 0));
      for (const auto& [line, side] : {std::pair{&fault.top, "top"}, std::pair{&fault.foot, "foot"}})
        cliffs.lines.push_back(to_map(*line, options.affine, fmt::format("the {} of cliff {}", side, cliffs.faults)));
    }
  }
  return cliffs;
}

}  // namespace scarp
