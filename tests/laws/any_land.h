// Land and tiles for laws of tiles: heights from a hash, decoded edges, and errors at nodes by brute force.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "globe/sine.h"
#include "scarp/tile.h"

namespace scarp::testing {
inline constexpr float kNoHeight = std::numeric_limits<float>::quiet_NaN();

/// Heights from a hash of a node's place, plus waves: steep and flat, with steps and voids, around the globe.
class AnyLand final : public NodeSource {
 public:
  AnyLand(std::uint32_t seed, double relief, double noise, bool has_voids, DegreeBox covered)
      : seed_(seed), relief_(relief), noise_(noise), has_voids_(has_voids), covered_(covered) {}

  float at(const NodeWindow& window, std::int64_t col, std::int64_t row) const {
    col = ((col % window.per_turn) + window.per_turn) % window.per_turn;
    if (window.is_pole(row)) col = 0;
    const double lon = window.longitude(col), lat = window.latitude(row);
    if (lon < covered_.west || lon > covered_.east || lat < covered_.south || lat > covered_.north) return kNoHeight;
    const std::uint32_t hash =
        mix(static_cast<std::uint32_t>(col) * 2654435761u ^ mix(static_cast<std::uint32_t>(row) + seed_));
    if (has_voids_ &&
        mix(static_cast<std::uint32_t>(col / 9) * 31u + static_cast<std::uint32_t>(row / 7) + seed_) % 11 == 0)
      return kNoHeight;
    const double wave = globe::sine_of_degrees(std::fmod(lon * 977 + seed_ % 360, 720)).sine *
                        globe::sine_of_degrees(std::fmod(lat * 1201, 720)).cosine;
    const double step = std::fmod(lon * 53 + lat * 17 + 1e4, 7) < 0.4 ? relief_ / 3 : 0;
    return static_cast<float>(relief_ / 2 * wave + step + noise_ * (hash % 1024) / 1024.0);
  }
  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    std::size_t k = 0;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) out[k++] = at(window, window.col + i, window.row + j);
    }
    return {};
  }

 private:
  static std::uint32_t mix(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
  }

  std::uint32_t seed_;
  double relief_, noise_;
  bool has_voids_;
  DegreeBox covered_;
};

inline constexpr TileGrid kGrids[] = {{GridKind::kGeographic}, {GridKind::kMercator}};

inline TileGrid any_grid() { return kGrids[*rc::gen::inRange<std::size_t>(0, 2)]; }

inline PyramidPlan plan_of(double relief, double noise, int finest, int cells, Effort effort, const TileGrid& grid = {},
                           double share = 0.25) {
  SourceFacts source{{-180, -90, 180, 90}, 1, -relief, relief + noise};
  PyramidSettings settings;
  settings.cells = cells;
  settings.max_zoom = finest;
  settings.effort = effort;
  settings.grid = grid;
  settings.max_error = share * grid.geometric_error(finest);
  const Result<PyramidPlan> plan = plan_pyramid(source, settings);
  EXPECT_TRUE(plan) << plan.error().message;
  return *plan;
}

inline QuantizedMesh decode(const TerrainTile& tile, const TileGrid& grid = {}) {
  const auto decoded = decode_quantized_mesh(encode_quantized_mesh(tile, {}, grid), "tile");
  EXPECT_TRUE(decoded) << decoded.error().message;
  return *decoded;
}

/// A vertex on an edge in a client's view: place along the edge, height in single precision, normal.
using EdgeVertex = std::tuple<std::uint16_t, float, std::array<std::uint8_t, 2>>;

inline std::vector<EdgeVertex> edge_of(const QuantizedMesh& mesh, const std::vector<std::uint32_t>& vertices,
                                       const std::vector<std::uint16_t>& along) {
  std::vector<EdgeVertex> edge;
  for (const std::uint32_t v : vertices)
    edge.emplace_back(along[v], static_cast<float>(mesh.height(v)) + 0.0f, mesh.normals[v]);
  return edge;
}

/// Rounds heights near 0, the only ones at which clients may differ in single precision, by 1.5e-11 m.
inline std::vector<EdgeVertex> without_dust(std::vector<EdgeVertex> edge) {
  for (auto& [place, height, normal] : edge) {
    if (std::abs(height) < 1e-10f) height = 0;
  }
  return edge;
}

/// Positions of a tile's rows of nodes between its ends in degrees, in steps, by the library's formulas.
inline std::vector<double> lines_of(TileId id, std::int32_t steps, const TileGrid& grid) {
  constexpr double kPi = 3.141592653589793;
  std::vector<double> degrees, lines;
  for (std::int32_t row = 0; row <= steps; ++row) {
    const double part = (grid.rows(id.z) - 1.0 - id.y + static_cast<double>(row) / steps) / grid.rows(id.z);
    degrees.push_back(grid.has_poles() ? 90 - 180 * part : std::atan(std::sinh(kPi * (1 - 2 * part))) * 180 / kPi);
  }
  for (const double degree : degrees)
    lines.push_back((degrees.front() - degree) / (degrees.front() - degrees.back()) * steps);
  return lines;
}

/// Largest error at the nodes of a decoded tile, by brute force: every node against every triangle that contains it.
inline double brute_force(const QuantizedMesh& mesh, TileId id, std::int32_t steps, const NodeSource& source,
                          float background, const TileGrid& grid) {
  std::vector<float> nodes(static_cast<std::size_t>(steps + 1) * static_cast<std::size_t>(steps + 1));
  EXPECT_TRUE(source.read(grid.window_of(id, steps), nodes));
  const std::vector<double> lines = lines_of(id, steps, grid);
  const auto first_row = [&](double line) {
    return static_cast<std::int32_t>(std::lower_bound(lines.begin(), lines.end(), line - 1e-9) - lines.begin());
  };
  std::vector<double> worst(nodes.size(), -1);
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    std::array<double, 3> x{}, y{}, z{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[k + c];
      x[c] = mesh.u[v] * static_cast<double>(steps) / 32767;
      y[c] = steps - mesh.v[v] * static_cast<double>(steps) / 32767;
      z[c] = mesh.height(v);
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    const auto [left, right] = std::minmax({x[0], x[1], x[2]});
    const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
    for (std::int32_t j = first_row(top); j <= steps && lines[static_cast<std::size_t>(j)] <= bottom + 1e-9; ++j) {
      const double line = lines[static_cast<std::size_t>(j)];
      for (auto i = static_cast<std::int32_t>(std::ceil(left - 1e-9)); i <= right + 1e-9; ++i) {
        const double b = ((i - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (line - y[0])) / area;
        const double c = ((x[1] - x[0]) * (line - y[0]) - (i - x[0]) * (y[1] - y[0])) / area;
        if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
        const auto at = static_cast<std::size_t>(j * (steps + 1) + i);
        const double node = std::isnan(nodes[at]) ? double{background} : double{nodes[at]};
        worst[at] = std::max(worst[at], std::abs(z[0] + b * (z[1] - z[0]) + c * (z[2] - z[0]) - node));
      }
    }
  }
  EXPECT_GE(*std::min_element(worst.begin(), worst.end()), 0) << "a node without a triangle";
  return *std::max_element(worst.begin(), worst.end());
}

inline std::int32_t nodes_of(const PyramidPlan& plan, int z) { return plan.cells << (plan.max_zoom() - z); }

inline Effort any_effort() { return *rc::gen::element(Effort::kFast, Effort::kNormal, Effort::kHigh); }

inline AnyLand any_land(double& relief, double& noise) {
  relief = *rc::gen::element(0.0, 40.0, 900.0, 6000.0);
  noise = *rc::gen::element(0.0, 3.0, 200.0);
  return {*rc::gen::arbitrary<std::uint32_t>(), relief, noise, *rc::gen::arbitrary<bool>(), {-180, -90, 180, 90}};
}

}  // namespace scarp::testing
