#include "check/tileset_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "check/space.h"

namespace scarp::check {
namespace {

constexpr double kRadians = 0.017453292519943295;
/// Slack for rounding to decimals: for a root's sides, and for heights in metres.
constexpr double kSideSlack = 1e-9, kHeightSlack = 1e-6;
/// Slack in metres at the centre of a plane, where the plane's transform is exact.
constexpr double kCentreSlack = 0.01;
/// Checked raster positions in each direction: a subset of those for which the set declares the distance from the
/// globe.
constexpr int kLooks = 5;

class TilesetCheck {
 public:
  TilesetCheck(const io::SetClaims& claims, const TileGrid& grid, double low, double high, const CheckedNodes& nodes,
               std::vector<TileFault>& faults)
      : claims_(claims), grid_(grid), low_(low), high_(high), nodes_(nodes), faults_(faults) {}

  void run(std::size_t levels) {
    std::string refine;
    std::optional<double> above = claims_.geometric_error;
    if (!above) add("it has no geometricError, by which clients decide to load it");
    std::uint32_t implicit = 0;
    for (const io::ClaimedRoot& root : claims_.roots) {
      if (!root.refine.empty()) refine = root.refine;
      if (refine != "REPLACE")
        add(fmt::format(
            "its tiles are refined by \"{}\", and finer tiles have to take the place of coarser ones: REPLACE",
            refine));
      if (!root.geometric_error || !(*root.geometric_error >= 0))
        add("a root has no geometricError");
      else if (above && *root.geometric_error > *above)
        add(fmt::format("a root has a geometricError of {} m, more than the {} m of what is above it",
                        *root.geometric_error, *above));
      // The roots of implicit tiles are siblings.
      if (!root.is_implicit && root.geometric_error) above = root.geometric_error;
      check_heights(root);
      if (root.is_implicit) {
        if (implicit < grid_.roots()) check_sides(root, implicit);
        check_error(root, implicit++);
        if (root.levels.value_or(0) != levels)
          add(fmt::format("root {} has {} availableLevels, and the set has {} levels", implicit - 1,
                          root.levels.value_or(0), levels));
      }
      if (root.has_transform && !grid_.is_flat())
        add("a root has a transform, which moves tiles that are earth-centred already");
    }
    if (implicit != grid_.roots())
      add(fmt::format("it has {} roots of implicit tiles, and its grid has {}", implicit, grid_.roots()));
    if (grid_.is_flat() && !claims_.roots.empty()) check_transform(claims_.roots.front());
  }

 private:
  void add(const std::string& what) { faults_.push_back({TileFaultKind::kTileset, "tileset.json: " + what}); }

  /// Checks the volumes that include heights.
  void check_heights(const io::ClaimedRoot& root) {
    const std::vector<double>& of = root.numbers;
    if (root.volume.empty()) return add("a root has no boundingVolume that is a region or a box");
    const double low = root.volume == "region" ? of[4] : of[2] - std::abs(of[11]),
                 high = root.volume == "region" ? of[5] : of[2] + std::abs(of[11]);
    if (!(low <= low_ + kHeightSlack) || !(high >= high_ - kHeightSlack))
      add(fmt::format("the boundingVolume of a root is {:.9g} to {:.9g} m high, and tiles are {:.9g} to {:.9g} m", low,
                      high, low_, high_));
  }

  /// Clients halve the root's sides to locate tiles.
  void check_sides(const io::ClaimedRoot& root, std::uint32_t x) {
    const std::vector<double>& of = root.numbers;
    if (root.volume != (grid_.is_flat() ? "box" : "region"))
      return add(fmt::format("root {} has to have a {} for its boundingVolume", x, grid_.is_flat() ? "box" : "region"));
    const DegreeBox box = grid_.bounds_of({0, x, 0});
    std::array<double, 4> told{}, wanted{};
    if (grid_.is_flat()) {
      const LocalRaster& raster = grid_.local;
      const double col = static_cast<double>(raster.centre_col()), row = static_cast<double>(raster.centre_row());
      const bool is_straight = of[4] == 0 && of[5] == 0 && of[6] == 0 && of[8] == 0 && of[9] == 0 && of[10] == 0;
      if (!is_straight) return add("the box of the root is turned");
      told = {of[0] - of[3], of[1] - of[7], of[0] + of[3], of[1] + of[7]};
      wanted = {(box.west - col) * raster.cell_x, (box.south - row) * raster.cell_y, (box.east - col) * raster.cell_x,
                (box.north - row) * raster.cell_y};
    } else {
      told = {of[0], of[1], of[2], of[3]};
      wanted = {box.west * kRadians, box.south * kRadians, box.east * kRadians, box.north * kRadians};
    }
    const double slack = kSideSlack * (wanted[2] - wanted[0]);
    for (std::size_t k = 0; k < told.size(); ++k) {
      if (std::abs(told[k] - wanted[k]) <= slack) continue;
      return add(fmt::format(
          "the boundingVolume of root {} goes from {:.9g}, {:.9g} to {:.9g}, {:.9g}, and its tiles lie from "
          "{:.9g}, {:.9g} to {:.9g}, {:.9g}",
          x, told[0], told[1], told[2], told[3], wanted[0], wanted[1], wanted[2], wanted[3]));
    }
  }

  /// Each level has half the error of the level above.
  void check_error(const io::ClaimedRoot& root, std::uint32_t x) {
    double error = root.geometric_error.value_or(0);
    for (std::size_t z = 0; z < claims_.bounds.size(); ++z, error /= 2) {
      if (!claims_.bounds[z] || !(*claims_.bounds[z] > error)) continue;
      return add(fmt::format("of root {} clients take {} m for the error of level {}, whose bound is {} m", x, error, z,
                             *claims_.bounds[z]));
    }
  }

  /// A position of the plane on the globe.
  static Place put(const std::vector<double>& by, double east, double north, double height) {
    Place at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = by[k] * east + by[4 + k] * north + by[8 + k] * height + by[12 + k];
    return at;
  }

  void check_transform(const io::ClaimedRoot& root) {
    if (!root.has_transform) {
      if (nodes_.place) add("it has no transform, and its source has a place on the globe");
      return;
    }
    const std::vector<double>& by = root.transform;
    if (by.empty()) return add("its transform is not 16 numbers");
    const Place x{by[0], by[1], by[2]}, y{by[4], by[5], by[6]}, up{by[8], by[9], by[10]};
    if (by[3] != 0 || by[7] != 0 || by[11] != 0 || by[15] != 1 || std::abs(length(up) - 1) > 1e-9 ||
        std::abs(inner(x, up)) > 1e-9 || std::abs(inner(y, up)) > 1e-9 || inner(cross(x, y), up) <= 0)
      return add("its transform is no turn and move: the way up has to be of length 1, and upright on the plane");
    if (nodes_.source == nullptr) return;
    if (!nodes_.place) return add("it has a transform, and its source has no place on the globe");
    check_place(by);
  }

  void check_place(const std::vector<double>& by) {
    const LocalRaster& raster = grid_.local;
    const World globe(TileGrid{}, nodes_.place->ellipsoid);
    const double col = static_cast<double>(raster.centre_col()), row = static_cast<double>(raster.centre_row());
    const double height = (low_ + high_) / 2;
    // Distances in metres: on the ground, and in height.
    const auto off = [&](double east, double north, double above) -> std::array<double, 2> {
      const std::array<double, 3> at = nodes_.place->find(east, north);
      const Place way = put(by, (east - col) * raster.cell_x, (north - row) * raster.cell_y, above) -
                        globe.place({at[0], at[1], at[2] + above});
      const double up = inner(way, World::up(at[0], at[1]));
      return {std::sqrt(std::max(inner(way, way) - up * up, 0.0)), std::abs(up)};
    };
    const auto [along, up] = off(col, row, 0);
    if (!(along <= kCentreSlack) || !(up <= kCentreSlack))
      return add(
          fmt::format("its transform puts the raster's centre {:.6g} m along the ground and {:.6g} m in height "
                      "from where the source has it",
                      along, up));
    if (!claims_.off_globe) return;
    const auto [told_along, told_up] = *claims_.off_globe;
    std::array<double, 2> worst{};
    for (int j = 0; j < kLooks; ++j) {
      for (int i = 0; i < kLooks; ++i) {
        const auto found =
            off((raster.cols - 1) * (i / (kLooks - 1.0)), (raster.rows - 1) * (j / (kLooks - 1.0)), height);
        for (std::size_t k = 0; k < 2; ++k) worst[k] = std::max(worst[k], found[k]);
      }
    }
    if (worst[0] > told_along + kCentreSlack || worst[1] > told_up + kCentreSlack)
      add(
          fmt::format("its plane is {:.6g} m along the ground and {:.6g} m in height from the source, and {:.6g} and "
                      "{:.6g} m are told (off_globe)",
                      worst[0], worst[1], told_along, told_up));
  }

  const io::SetClaims& claims_;
  const TileGrid& grid_;
  double low_, high_;
  const CheckedNodes& nodes_;
  std::vector<TileFault>& faults_;
};

}  // namespace

void check_tileset(const io::SetClaims& claims, const TileGrid& grid, std::size_t levels, double low, double high,
                   const CheckedNodes& nodes, std::vector<TileFault>& faults) {
  // Without roots a fault was added before.
  if (claims.roots.empty()) return;
  TilesetCheck(claims, grid, low, high, nodes, faults).run(levels);
}

}  // namespace scarp::check
