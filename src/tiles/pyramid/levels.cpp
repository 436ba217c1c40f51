// The levels of a pyramid: errors, quanta, and the finest one.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "globe/globe.h"
#include "globe/powers.h"
#include "scarp/tile.h"
#include "tiles/mesh/tile_lines.h"
#include "tiles/mesh/tile_rows.h"

namespace scarp {
namespace {

constexpr double kPi = 3.141592653589793;
/// Levels of tiles below a block's own. A block with 128 cells per tile then has 4096 × 4096 cells.
constexpr int kBlockDepth = 5;
/// Usual lower limit of max error / quantum.
constexpr double kQuantaOfError = 32;
/// Absolute lower limit: the rounding of heights to the quantum uses a part of the error.
constexpr double kLeastQuantaOfError = 4;
/// Smallest quantum on a globe, in metres: finer heights are noise, and 2²⁴ quanta hold no mountain.
constexpr double kLeastQuantum = 0x1p-10;
/// Quanta that quantized-mesh holds in a tile.
constexpr double kQuantaOfTile = 32767;
/// Quanta that a float32 holds exactly. The engine and GLB store heights in quanta.
constexpr double kQuantaOfFloat = 0x1p24;
/// Cubic interpolation exceeds the samples by at most this share of their range on either side.
constexpr double kOvershoot = 0.3;
/// The finest level's nodes may be this many cells of the source apart.
constexpr double kSpacing = 1.1;
/// Largest distance of heights from the ellipsoid in metres, on the earth, where larger heights are undeclared nodata,
/// and on planets with higher mountains.
constexpr double kHighestOnEarth = 20000, kHighest = 60000;

/// Limit on a local grid, whose heights may have any unit.
constexpr double kHighestLocal = 1e6;

/// Largest relief of a local grid in cells: 24 bits hold it in eighths of a cell.
constexpr double kSteepest = 0x1p20;

/// Number of segments of an edge, so short that the sag is at most an eighth of the geometric error.
int segments_of(int z, const TileGrid& grid) {
  if (grid.is_flat()) return 1;
  const int halves = z + std::countr_zero(grid.roots());  // number of halves of a whole turn
  return halves < 11 ? 64 >> ((halves + 1) / 2) : 1;
}

/// Degrees between two nodes, as the geometric mean of both directions.
double degrees_of_step(int z, int cells, double latitude, const TileGrid& grid) {
  return grid.largest_step(grid.per_turn(z, cells)) * std::sqrt(grid.row_step(latitude));
}

/// Metres between two nodes on the ground.
double spacing_of(int z, int cells, double latitude, const TileGrid& grid, const globe::Globe& globe) {
  const globe::Globe::Radii radii = globe.radii(latitude);
  return degrees_of_step(z, cells, latitude, grid) * (kPi / 180) * std::sqrt(radii.meridian * radii.parallel);
}

/// The part of a box within a grid; nothing if they are disjoint.
std::optional<DegreeBox> part_on(const TileGrid& grid, const DegreeBox& box) {
  const DegreeBox all = grid.bounds();
  if (box.south >= all.north || box.north <= all.south) return {};
  return DegreeBox{box.west, std::max(box.south, all.south), box.east, std::min(box.north, all.north)};
}

/// True if each row of nodes of a block has a distinct v. On some grids, rows crowd at a block's ends.
bool are_rows_apart(const TileGrid& grid, int z, std::int32_t steps) {
  const tiles::TileRows rows(grid, {z, 0, grid.rows(z) - 1}, steps);
  for (std::int32_t row = 0; !rows.are_even() && row < steps; ++row) {
    if (rows.v_of(row + 1) == rows.v_of(row)) return false;
  }
  return true;
}

int find_max_zoom(const SourceFacts& source, int cells, const TileGrid& grid, const globe::Globe& globe) {
  if (grid.is_flat()) return grid.finest_local(cells);
  const DegreeBox& covered = source.covered;
  // Nodes are arbitrarily dense at a covered pole, so the cover's edge counts.
  const double latitude = covered.north >= 90    ? std::max(covered.south, 0.0)
                          : covered.south <= -90 ? std::min(covered.north, 0.0)
                                                 : (covered.south + covered.north) / 2;
  const auto is_coarse = [&](int z) {
    return source.cell_degrees > 0 ? degrees_of_step(z, cells, latitude, grid) > kSpacing * source.cell_degrees
                                   : spacing_of(z, cells, latitude, grid, globe) > kSpacing * source.cell;
  };
  int z = 0;
  while (z < kMaxTileLevel && is_coarse(z)) ++z;
  return z;
}

/// The quanta of heights on each level.
class Quanta {
 public:
  Quanta(double low, double high, bool is_flat) : low_(low), high_(high), is_flat_(is_flat) {
    // A tile must hold its relief, which is at most that of the whole source.
    const double room = (high - low) / kQuantaOfTile;
    if (room > 0) compact_ = 2 * globe::power_of_two_below(room);
    least_ = std::max(kLeastQuantum, compact_);
    if (!is_flat) return;
    const double reach = std::max({high - low, std::abs(low), std::abs(high)}) / kQuantaOfFloat;
    least_ = reach > 0 ? globe::power_of_two_above(reach) : kLeastQuantum;
  }

  double least() const { return least_; }
  double least_error() const { return kLeastQuantaOfError * least_; }
  /// REQUIRES: a max error of least_error() or more.
  double of(double max_error) const {
    const double fine = std::max(globe::power_of_two_below(max_error / kQuantaOfError), least_);
    // GLB holds any relief, but needs fewer bytes for few quanta.
    return std::max(fine, std::min(compact_, globe::power_of_two_below(max_error / kLeastQuantaOfError)));
  }
  Result<void> check(double max_error, int level) const {
    if (max_error >= least_error()) return {};
    if (is_flat_)
      return fail(ErrorKind::kUsage,
                  fmt::format("a max error of {} at level {}, the finest, is too fine for heights of {} to {}, the "
                              "background included: float32 holds them in steps of {}; give {} or more",
                              max_error, level, low_, high_, least_, least_error()));
    return fail(
        ErrorKind::kUsage,
        fmt::format("a max error of {} m at level {}, the finest, is less than quantized-mesh holds for heights "
                    "of {} to {} m, the background and what cubics may add included: its steps are {} m; give "
                    "{} m or more",
                    max_error, level, low_, high_, least_, least_error()));
  }

 private:
  double low_, high_;
  bool is_flat_;
  double compact_ = 0, least_ = 0;
};

/// True if the box spans the whole turn.
bool is_round(const TileGrid& grid, const DegreeBox& box) { return !grid.is_flat() && box.east - box.west >= 360; }

/// Combines ranges and covers of all sources.
SourceFacts join_facts(std::span<const SourceFacts> stack, const TileGrid& grid) {
  SourceFacts all = stack.front();
  for (const SourceFacts& one : stack) {
    all.covered = {std::min(all.covered.west, one.covered.west), std::min(all.covered.south, one.covered.south),
                   std::max(all.covered.east, one.covered.east), std::max(all.covered.north, one.covered.north)};
    all.cell = std::min(all.cell, one.cell);
    all.min = std::min(all.min, one.min);
    all.max = std::max(all.max, one.max);
  }
  if (is_round(grid, all.covered)) {
    all.covered.west = -180;
    all.covered.east = 180;
  }
  return all;
}

/// The intersection of two boxes; if they meet twice around the globe, the larger part. A source that spans the whole
/// turn covers any box.
std::optional<DegreeBox> intersection_of(const TileGrid& grid, const DegreeBox& covered, const DegreeBox& only) {
  std::optional<DegreeBox> best;
  if (is_round(grid, covered)) best = {only.west, covered.south, only.east, covered.north};
  for (const double turn : grid.turns()) {
    const DegreeBox shared{std::max(covered.west, only.west + turn), covered.south,
                           std::min(covered.east, only.east + turn), covered.north};
    if (shared.east >= shared.west && (!best || shared.east - shared.west > best->east - best->west)) best = shared;
  }
  if (!best) return {};
  best->south = std::max(covered.south, only.south);
  best->north = std::min(covered.north, only.north);
  if (best->north < best->south) return {};
  return best;
}

}  // namespace

Result<PyramidPlan> plan_pyramid(const SourceFacts& source, const PyramidSettings& settings) {
  return plan_pyramid(std::span(&source, 1), settings);
}

Result<PyramidPlan> plan_pyramid(std::span<const SourceFacts> given, const PyramidSettings& settings) {
  std::vector<SourceFacts> stack;
  for (const SourceFacts& one : given) {
    const std::optional<DegreeBox> covered = part_on(settings.grid, one.covered);
    if (!covered) continue;
    stack.push_back(one);
    stack.back().covered = *covered;
  }
  if (stack.empty())
    return fail(ErrorKind::kUsage,
                fmt::format("the {} grid ends at {:.4f} degrees, and the raster lies beyond: take the geographic grid",
                            settings.grid.name(), settings.grid.bounds().north));
  const SourceFacts source = join_facts(stack, settings.grid);
  if (settings.cells < 16 || settings.cells > 256 || !std::has_single_bit(static_cast<unsigned>(settings.cells)))
    return fail(ErrorKind::kUsage, fmt::format("{} cells a tile: give 16, 32, 64, 128 or 256", settings.cells));
  if (settings.max_zoom < -1 || settings.max_zoom > kMaxTileLevel)
    return fail(ErrorKind::kUsage,
                fmt::format("level {} does not exist: the finest is at most {}", settings.max_zoom, kMaxTileLevel));
  if (settings.grid.is_flat() && settings.max_zoom >= 0 &&
      settings.max_zoom != settings.grid.finest_local(settings.cells))
    return fail(ErrorKind::kUsage,
                fmt::format("the nodes of a local grid are the raster's samples, and its finest level "
                            "is {}: leave --zoom out, or coarsen the raster with --resolution",
                            settings.grid.finest_local(settings.cells)));
  if (!(settings.quality >= 0.5) || !(settings.quality <= 1e6))
    return fail(ErrorKind::kUsage, fmt::format("a quality of {} is none: give 0.5 to 1000000", settings.quality));
  if (!(settings.max_error >= 0) || !std::isfinite(settings.max_error))
    return fail(ErrorKind::kUsage, fmt::format("a max error of {} m is none: give more than 0", settings.max_error));
  const bool is_high = !settings.grid.is_flat() && std::abs(settings.background) > kHighestOnEarth;
  if (!std::isfinite(settings.background) || is_high)
    return fail(ErrorKind::kUsage, fmt::format("a background of {} m is no height of a planet: give one within {}",
                                               settings.background, kHighestOnEarth));
  if (auto conflicts = list_conflicts(settings); !conflicts.empty())
    return fail(ErrorKind::kUsage, std::move(conflicts.front()));
  // The nodes of a local grid are samples.
  const double overshoot = settings.grid.is_flat() ? 0 : kOvershoot * (source.max - source.min);
  const double low = std::min<double>(source.min - overshoot, settings.background);
  const double high = std::max<double>(source.max + overshoot, settings.background);
  const bool is_earth = std::abs(settings.ellipsoid.semi_major / Geodetic{}.semi_major - 1) <= 0.01;
  const double highest = settings.grid.is_flat() ? kHighestLocal : is_earth ? kHighestOnEarth : kHighest;
  if (settings.grid.is_flat() && !(std::max(std::abs(low), std::abs(high)) <= highest))
    return fail(ErrorKind::kUsage, fmt::format("heights of {} to {} are beyond {}: is nodata undeclared? Else give "
                                               "--z-scale",
                                               source.min, source.max, highest));
  if (settings.grid.is_flat() && !(high - low <= kSteepest * source.cell))
    return fail(ErrorKind::kUsage,
                fmt::format("heights of {} to {} on cells of {} are no land: is nodata undeclared? Else "
                            "give --z-scale",
                            source.min, source.max, source.cell));
  if (!(source.cell > 0) || !(high - low <= 2 * highest) || std::max(std::abs(low), std::abs(high)) > highest)
    return fail(ErrorKind::kUsage,
                fmt::format("heights of {} to {} are not metres of a planet: give them in metres, within {} (is "
                            "nodata undeclared?)",
                            source.min, source.max, highest));

  const globe::Globe globe(settings.ellipsoid);
  PyramidPlan plan;
  plan.cells = settings.cells;
  plan.effort = settings.effort;
  plan.background = settings.background;
  plan.has_siblings = settings.has_siblings;
  plan.max_tile_bytes = settings.max_tile_bytes;
  plan.binds_samples = settings.binds_samples;
  plan.ellipsoid = settings.ellipsoid;
  plan.grid = settings.grid;
  plan.covered = source.covered;
  if (settings.only) {
    const std::optional<DegreeBox> shared = intersection_of(settings.grid, source.covered, *settings.only);
    if (!shared) return fail(ErrorKind::kUsage, "the raster has nothing in that box");
    plan.covered = *shared;
  }
  std::vector<int> asked;
  const int cells = settings.binds_samples ? settings.cells / 2 : settings.cells;
  for (const SourceFacts& one : stack) asked.push_back(find_max_zoom(one, cells, settings.grid, globe));
  const int most = *std::max_element(asked.begin(), asked.end());
  const int finest = settings.max_zoom >= 0 ? settings.max_zoom : most;
  for (std::size_t k = 0; stack.size() > 1 && k < stack.size(); ++k)
    plan.sources.push_back({stack[k].covered, asked[k] == most ? finest : std::min(asked[k], finest)});
  plan.block_level = std::max(0, finest - kBlockDepth);
  while (!are_rows_apart(plan.grid, plan.block_level, plan.cells << (finest - plan.block_level))) ++plan.block_level;
  const Quanta quanta(low, high, settings.grid.is_flat());
  const double least = settings.max_error > 0 ? settings.max_error
                                              : std::max(settings.grid.geometric_error(finest, globe.semi_major()) / 4,
                                                         quanta.least_error());
  SCARP_RETURN_IF_ERROR(quanta.check(least, finest));
  plan.least_quantum = quanta.least();
  for (int z = 0; z <= finest; ++z) {
    PyramidLevel level;
    level.geometric_error = settings.grid.geometric_error(z, globe.semi_major());
    level.max_error = z == finest ? least : std::max(least, level.geometric_error / settings.quality);
    level.quantum = quanta.of(level.max_error);
    level.segments = segments_of(z, settings.grid);
    plan.levels.push_back(level);
  }
  set_lines(plan, settings.lines);
  return plan;
}

void set_lines(PyramidPlan& plan, std::vector<DegreeLine> lines) {
  plan.lines = lines.empty() ? nullptr
                             : std::make_shared<TileLines>(std::move(lines), plan.grid, plan.cells, plan.max_zoom(),
                                                           plan.block_level, plan.covered);
}

}  // namespace scarp
