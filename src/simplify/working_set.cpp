#include "simplify/working_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geom/convex_hull.h"
#include "measure/judge_blocks.h"

namespace scarp::run {

namespace {

constexpr std::size_t kLeastGroup = 16;
constexpr std::size_t kNeighbours = 8;                                // on either side, in the order of the block
constexpr std::uint64_t kBytesPerPoint = 110, kBytesPerVertex = 230;  // at the peak of a run with `normal` effort

/// Calls visit(first, end) for groups of neighbours, in the order of the block.
template <class Visit>
void visit_groups(std::size_t points, std::size_t size, const Visit& visit) {
  for (std::size_t first = 0; first < points; first += size) visit(first, std::min(points, first + size));
}

/// The points with the least and the largest error.
std::array<std::size_t, 2> find_extremes(std::span<const double> errors, std::size_t first, std::size_t end) {
  std::array<std::size_t, 2> extremes{first, first};
  for (std::size_t i = first; i < end; ++i) {
    if (errors[i] < errors[extremes[0]]) extremes[0] = i;
    if (errors[i] > errors[extremes[1]]) extremes[1] = i;
  }
  return extremes;
}

}  // namespace

WorkingSet::WorkingSet(const PointBlocks& blocks, const PointOptions& options) : blocks_(blocks), options_(options) {}

Result<void> WorkingSet::visit(const std::function<Result<void>(const PointSet&)>& visit) const {
  return judge::visit_blocks(blocks_, "survey", options_.run.progress, visit);
}

void WorkingSet::add(const PointSet& block, std::size_t point) {
  points_.x.push_back(block.x[point]);
  points_.y.push_back(block.y[point]);
  points_.z.push_back(block.z[point]);
}

std::size_t WorkingSet::group_size() const {
  const Memory& memory = options_.run.memory;
  if (memory.limit == 0) return kLeastGroup;
  const std::uint64_t half = (std::max(memory.limit, memory.taken) - memory.taken) / 2;
  const std::uint64_t most = std::max<std::uint64_t>(1, half / kBytesPerPoint);
  return std::max<std::size_t>(kLeastGroup, (3 * blocks_.size() + most - 1) / most);
}

Result<void> WorkingSet::check_memory(std::uint64_t vertices) const {
  const Memory& memory = options_.run.memory;
  const std::uint64_t needed = memory.taken + kBytesPerPoint * points_.size() + kBytesPerVertex * vertices;
  if (memory.limit == 0 || needed <= memory.limit) return {};
  return fail(ErrorKind::kMemory,
              fmt::format("the memory limit has no space for a mesh of {} vertices and {} of {} points: allow a larger "
                          "max error, or more memory, such as {}M",
                          vertices, std::min<std::uint64_t>(points_.size(), blocks_.size()), blocks_.size(),
                          2 * memory.limit / 1'000'000));
}

Result<void> WorkingSet::snap() {
  SCARP_RETURN_IF_ERROR(check_memory(0));
  SCARP_TRY(snapped_, grid::snap_points(points_, options_.duplicates, *lattice_));
  heights_ = snapped_.z;
  if (!options_.float32_positions) return {};
  for (double& height : heights_) height = double{static_cast<float>(height)};
  return {};
}

Result<void> WorkingSet::find_extent() {
  points_ = {};
  SCARP_RETURN_IF_ERROR(visit([&](const PointSet& block) -> Result<void> {
    finder_.include(block);
    for (const std::vector<double>* const axis : {&block.x, &block.y, &block.z}) {
      const auto [least, most] = std::minmax_element(axis->begin(), axis->end());
      for (const auto at : {least, most}) add(block, static_cast<std::size_t>(at - axis->begin()));
    }
    return {};
  }));
  return finder_.check();
}

Result<void> WorkingSet::start(grid::PointSteps steps) {
  if (steps != grid::PointSteps::kFloat32) {
    SCARP_RETURN_IF_ERROR(visit([&](const PointSet& block) -> Result<void> {
      finder_.read(block);
      return {};
    }));
  }
  lattice_ = finder_.find(steps);
  SCARP_RETURN_IF_ERROR(visit([&](const PointSet& block) -> Result<void> {
    SCARP_TRY(const auto& snapped, grid::snap_points(block, options_.duplicates, *lattice_));
    for (const std::uint32_t corner : geom::convex_hull(snapped.at)) add(block, snapped.source[corner]);
    visit_groups(block.size(), group_size(), [&](std::size_t first, std::size_t) { add(block, first); });
    return check_memory(0);
  }));
  return snap();
}

double WorkingSet::coverage_tolerance() const {
  const double area = finder_.x().size() * finder_.y().size();
  return MeasureOptions().coverage_tolerance * std::sqrt(area / static_cast<double>(blocks_.size()));
}

Result<void> WorkingSet::add_extremes(const Mesh& mesh) {
  MeasureOptions options;
  options.run.threads = options_.run.threads;
  SCARP_RETURN_IF_ERROR(visit([&](const PointSet& block) -> Result<void> {
    SCARP_TRY(const auto& errors, judge::judge_block(block, mesh, coverage_tolerance(), options));
    visit_groups(block.size(), group_size(), [&](std::size_t first, std::size_t end) {
      for (const std::size_t extreme : find_extremes(errors, first, end)) {
        if (extreme != first) add(block, extreme);
      }
    });
    return check_memory(0);
  }));
  return snap();
}

Result<bool> WorkingSet::judge(const Mesh& mesh, double bound, Measurement& result) {
  const std::size_t before = points_.size(), places = snapped_.size() + snapped_.echoes.size();
  MeasureOptions options;
  options.run.threads = options_.run.threads;
  options.run.progress = options_.run.progress;
  options.collect_above = bound;
  const auto see = [&](const PointSet& block, const std::vector<double>& errors) -> Result<void> {
    // Fitting may break the bound at neighbours of these points next.
    std::size_t added = 0;
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (std::abs(errors[i]) <= bound) continue;
      const std::size_t first = std::max(added, i - std::min(i, kNeighbours));
      added = std::max(added, std::min(block.size(), i + kNeighbours + 1));
      for (std::size_t k = first; k < added; ++k) add(block, k);
    }
    return check_memory(0);
  };
  SCARP_TRY(const auto& worst, judge::judge_blocks(blocks_, mesh, coverage_tolerance(), options, see, result));
  const bool has_grown = points_.size() > before;
  if (worst) {
    add(*worst, 0);
    result.max_error_at = {static_cast<std::int32_t>(points_.size() - 1), 0};
  }
  if (has_grown) {
    SCARP_RETURN_IF_ERROR(snap());
    if (snapped_.size() + snapped_.echoes.size() == places)
      return fail(ErrorKind::kInternal, "a point of the run breaks the bound that holds at all its points");
    has_grown_ = true;
  }
  return has_grown;
}

}  // namespace scarp::run
