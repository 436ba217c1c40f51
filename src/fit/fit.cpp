#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/rounds.h"
#include "fit/square_rounds.h"

namespace scarp::fit {

namespace {

/// Additional rounds end after two in a row that remove less than this share of the vertices.
constexpr double kWorthARound = 1e-3;
constexpr int kPoorRounds = 2;

/// Share of the triangles that a round of repair after the first leaves.
constexpr double kLeftByARound = 0.95;

bool is_small(const tin::Triangulation& tin) { return tin.triangle_count() <= 2 * kPatchTriangles; }

/// Side of squares with some kPatchTriangles triangles; on a narrow raster, length of pieces.
std::int32_t patch_side(const grid::Raster& raster, const tin::Triangulation& tin) {
  const double cols = raster.cols, rows = raster.rows;
  const double area = cols * rows * kPatchTriangles / static_cast<double>(tin.triangle_count());
  const double side = std::max(std::sqrt(area), area / std::min(cols, rows));
  return static_cast<std::int32_t>(std::clamp(side, 2.0, std::max(2.0, std::max(cols, rows))));
}

bool has_energies(const FitOptions& options) {
  const auto has = [](double bound) { return bound > 0x1p-60 && bound < 0x1p60; };
  if (options.read_bounds) return true;
  return options.bounds.empty() ? has(options.threshold)
                                : std::any_of(options.bounds.begin(), options.bounds.end(), has);
}

}  // namespace

Result<Fitted> fit(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice,
                   const FitOptions& options) {
  const std::int32_t longest = std::max(raster.cols, raster.rows);
  const std::int32_t most = options.most_side > 0 ? std::min(options.most_side, longest) : longest;
  const bool is_cut = most < longest || (options.patch_side > 0 ? options.patch_side < longest : !is_small(tin));
  if (options.squares) return fit_squares(raster, std::move(tin), std::move(lattice), options);
  Rounds rounds(raster, std::move(tin), std::move(lattice), options);
  const auto side = [&] {
    if (!is_cut) return longest;
    return std::min(most, options.patch_side > 0 ? options.patch_side : patch_side(raster, rounds.tin()));
  };
  const int repairs = has_energies(options) ? options.depth.rounds : 0;
  // A round of repair needs some five times the time of removal. The second round of removal and the last round of
  // repair handle few vertices other than those on earlier borders.
  const double removal = 1.0 / (1 + 5 * repairs);
  const std::int32_t first_side = side();
  const bool relocates = options.depth.relocates && has_energies(options);
  const auto remove = [&] {
    return rounds.run({first_side, 0}, is_cut ? 0.8 * removal : removal, relocates) &&
           (!is_cut || rounds.run({first_side, first_side / 2}, removal));
  };
  bool goes_on = remove();
  while (goes_on && repairs == 0 && rounds.raise_threshold()) goes_on = remove();
  rounds.forget_held();
  // Squares become larger as triangles become fewer.
  const auto grid = [&](int round) {
    const std::int32_t now = side();
    return PatchGrid{now, is_cut && round % 2 == 1 ? now / 2 : 0};
  };
  const bool has_last = is_cut && repairs > 0;
  const double whole = repairs + (has_last ? 0.2 : 0.0);
  for (int round = 0; goes_on && round < repairs; ++round) {
    const double end = removal + (1 - removal) * (round + 1) / whole;
    if (round > 0) rounds.raise_threshold(kLeftByARound);
    const int polishes = !has_last && round + 1 == repairs ? options.depth.polishes : 0;
    goes_on = rounds.repair(grid(round), end, rounds.repair_options(polishes, 0));
  }
  if (goes_on && has_last) {
    const std::int32_t now = side();
    goes_on = rounds.repair({now, now / 4}, 1, rounds.repair_options(options.depth.polishes, 0), true);
  }
  for (int round = repairs; goes_on && repairs > 0 && rounds.raise_threshold(); ++round)
    goes_on =
        rounds.repair(grid(round), 1, rounds.repair_options(rounds.is_last_rise() ? options.depth.polishes : 0, 0));
  int poor = repairs > 0 && options.goes_on ? 0 : kPoorRounds;
  for (int round = repairs; goes_on && poor < kPoorRounds && !rounds.is_time_up(); ++round) {
    const std::uint64_t before = rounds.vertices();
    goes_on =
        rounds.repair(grid(round), 1, rounds.repair_options(options.depth.polishes, static_cast<std::uint32_t>(round)));
    const std::uint64_t gain = before - rounds.vertices();
    poor = static_cast<double>(gain) < kWorthARound * static_cast<double>(before) ? poor + 1 : 0;
  }
  if (!goes_on) return fail(ErrorKind::kCancelled, "cancelled while removing vertices");
  return rounds.finish();
}

}  // namespace scarp::fit
