// Makes a tile from its nodes: edges, then the mesh between them, then the proof of the decoded mesh.
#include "tiles/mesh/tile_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "globe/ground.h"
#include "scarp/mesh.h"
#include "scarp/simplify.h"
#include "scarp/tile.h"
#include "tiles/mesh/node_scan.h"
#include "tiles/mesh/source_samples.h"
#include "tiles/mesh/tile_edges.h"
#include "tiles/mesh/tile_lines.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/mesh/tile_nodes.h"
#include "tiles/mesh/tile_rows.h"
#include "tiles/mesh/tile_surface.h"

namespace scarp::tiles {
namespace {

/// Meshes to try until the decoded one satisfies the level's max error.
constexpr int kMeshTrials = 12;
/// Lattice steps between nodes: vertices of lines lie anywhere, free ones on eighths.
constexpr std::int32_t kParts = 256;
/// Share of the max error for edges if samples are bounded: only an edge's nodes determine its vertices, but samples
/// are next to it.
constexpr double kEdgeShare = 0.25;

class TileMaker {
 public:
  TileMaker(const PyramidPlan& plan, TileId id, const TileNodes& nodes, const TileJudge& judge)
      : plan_(plan),
        level_(plan.levels[static_cast<std::size_t>(id.z)]),
        id_(id),
        nodes_(nodes),
        land_(nodes.land()),
        units_(plan.grid.side_units()),
        rows_(plan.grid, id, nodes.steps()),
        judge_(judge) {
    if (plan.lines == nullptr) return;
    paths_ = plan.lines->find(id);
    if (paths_ != nullptr) is_left_out_.resize(paths_->steps.size());
  }

  /// `max_error`: that of the interior.
  Result<TerrainTile> make(double max_error) {
    if (samples_.empty()) lay_edges();
    forced_.clear();
    is_left_out_.assign(is_left_out_.size(), false);
    std::optional<TerrainTile> best;
    double least = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < kMeshTrials; ++trial) {
      // A smaller error in each trial: the rounding of a forced vertex may break the bound elsewhere.
      auto mesh = refine((max_error - level_.quantum / 2) * (1 - trial / 128.0));
      if (!mesh && std::count(is_left_out_.begin(), is_left_out_.end(), false) > 0) {
        leave_lines_out({}, true);
        continue;
      }
      SCARP_RETURN_IF_ERROR(mesh);
      TerrainTile tile = quantize(*mesh);
      tile.max_error = max_error;
      tile.lines_left_out = static_cast<std::uint64_t>(std::count(is_left_out_.begin(), is_left_out_.end(), true));
      if (paths_ != nullptr) unfold(tile);
      const std::vector<SampleAt> folds = find_folds(tile);
      if (!folds.empty()) {
        force_around(folds);
        if (trial + 1 >= kMeshTrials / 2) leave_lines_out(folds, trial + 2 >= kMeshTrials);
        continue;
      }
      SCARP_TRY(const TileVerdict& verdict, judge_(tile));
      tile.node_error = verdict.error;
      const double worst = std::max(verdict.error, verdict.sample_error);
      if (worst < least || !best) best = std::move(tile);
      least = std::min(least, worst);
      const std::size_t before = forced_.size();
      force_around(verdict.offenders);
      force_around(verdict.beside);
      if (worst <= max_error || verdict.offenders.size() + verdict.beside.size() == 0) break;
      // The surface between the nodes is too far from a sample.
      if (forced_.size() == before && verdict.error <= max_error) break;
    }
    if (!best) return fail(ErrorKind::kInternal, fmt::format("tile {}/{}/{} folds over", id_.z, id_.x, id_.y));
    finish(*best);
    return std::move(*best);
  }

  /// The range of heights in the mesh: larger max errors have no effect.
  double relief() const {
    const auto [low, high] = std::minmax_element(samples_.begin(), samples_.end());
    return double{*high} - double{*low};
  }

 private:
  std::int32_t steps() const { return nodes_.steps(); }
  std::int32_t cols() const { return land_.right + 1; }
  std::int32_t rows() const { return land_.bottom - land_.top + 1; }
  std::size_t index(std::int32_t col, std::int32_t row) const {
    return static_cast<std::size_t>(row - land_.top) * static_cast<std::size_t>(cols()) + static_cast<std::size_t>(col);
  }

  /// Sets the samples for the engine: multiples of the quantum, and on edges the edge lines.
  void lay_edges() {
    samples_.resize(index(0, land_.bottom + 1));
    for (std::int32_t row = land_.top; row <= land_.bottom; ++row) {
      for (std::int32_t col = 0; col <= land_.right; ++col) samples_[index(col, row)] = rounded(nodes_.at(col, row));
    }
    const std::int32_t last = steps(), top = land_.top, right = land_.right;
    EdgeNodes across, down;
    for (std::int32_t i = 0; i <= right; ++i) {
      across.places.push_back(i);
      across.decoded.push_back(static_cast<double>(quantized(i, last, units_)) * last / units_);
    }
    for (std::int32_t i = top; i <= last; ++i) {
      down.places.push_back(rows_.line(i));
      down.decoded.push_back(static_cast<double>(units_ - rows_.v_of(last - i)) * last / units_);
    }
    edges_.top = lay_edge(across, &EdgeVertices::top, [&](std::int32_t i) { return std::pair{i, top}; });
    edges_.bottom = lay_edge(across, &EdgeVertices::bottom, [&](std::int32_t i) { return std::pair{i, last}; });
    edges_.left = lay_edge(down, &EdgeVertices::left, [&](std::int32_t i) { return std::pair{0, top + i}; });
    edges_.right = lay_edge(down, &EdgeVertices::right, [&](std::int32_t i) { return std::pair{right, top + i}; });
  }

  /// Steps between nodes of the tile per step of the lines' lattice.
  std::int32_t line_step() const { return steps() / plan_.cells; }

  template <class Place>
  std::vector<std::int32_t> lay_edge(EdgeNodes& nodes, std::vector<std::int32_t> EdgeVertices::*edge,
                                     const Place& place) {
    std::vector<float>& heights = nodes.heights;
    heights.clear();
    for (std::size_t i = 0; i < nodes.places.size(); ++i) {
      const auto [col, row] = place(static_cast<std::int32_t>(i));
      heights.push_back(nodes_.at(col, row));
    }
    std::vector<std::int32_t> crossed;
    if (paths_ != nullptr) crossed = paths_->edges.*edge;
    for (std::int32_t& i : crossed) i *= line_step();
    PyramidLevel level = level_;
    if (plan_.binds_samples) level.max_error *= kEdgeShare;
    std::vector<std::int32_t> vertices = choose_edge_vertices(nodes, level, crossed);
    for (std::size_t k = 1; k < vertices.size(); ++k) {
      const std::int32_t from = vertices[k - 1], to = vertices[k];
      const double low = double{rounded(heights[static_cast<std::size_t>(from)])};
      const double high = double{rounded(heights[static_cast<std::size_t>(to)])};
      for (std::int32_t i = from + 1; i < to; ++i) {
        const double line = low + (high - low) * (static_cast<double>(i - from) / (to - from));
        samples_[index(place(i).first, place(i).second)] = static_cast<float>(line);
      }
    }
    return vertices;
  }

  float rounded(float height) const {
    return static_cast<float>(level_.quantum * quanta_of(double{height}, level_.quantum));
  }

  /// Forces nodes with too large errors, and nodes around them, to be vertices. Otherwise a needle may end there,
  /// tilted by the rounding of its corner.
  void force_around(const std::vector<SampleAt>& nodes) {
    for (const auto& [col, row] : nodes) {
      for (std::int32_t y = std::max(row - 1, land_.top + 1); y <= std::min(row + 1, land_.bottom - 1); ++y) {
        for (std::int32_t x = std::max(col - 1, 1); x <= std::min(col + 1, land_.right - 1); ++x) {
          if (!is_beside_line(x, y)) forced_.insert({y, x});
        }
      }
    }
  }

  /// Distance of a node from a segment of a line, in nodes.
  double distance_to_line(std::size_t k, std::int32_t col, std::int32_t row) const {
    const auto& [from, to] = paths_->steps[k];
    const double dx = (to[0] - from[0]) * line_step(), dy = (to[1] - from[1]) * line_step();
    const double x = col - from[0] * line_step(), y = row - from[1] * line_step();
    const double share = std::clamp((x * dx + y * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return std::hypot(x - share * dx, y - share * dy);
  }

  /// True if the node is not on a line, but so close to it that a triangle between them would be a needle.
  bool is_beside_line(std::int32_t col, std::int32_t row) const {
    for (std::size_t k = 0; k < is_left_out_.size(); ++k) {
      if (is_left_out_[k]) continue;
      const double distance = distance_to_line(k, col, row);
      if (distance > 1e-6 && distance < 0.5) return true;
    }
    return false;
  }

  /// Omits segments of lines near triangles that rounding turns over, or all segments.
  void leave_lines_out(const std::vector<SampleAt>& folds, bool all) {
    for (std::size_t k = 0; k < is_left_out_.size(); ++k) {
      const auto is_near = [&](const SampleAt& at) { return distance_to_line(k, at.col, at.row) <= 1; };
      is_left_out_[k] = is_left_out_[k] || all || std::any_of(folds.begin(), folds.end(), is_near);
    }
  }

  void add_lines_to(SimplifyOptions& options) const {
    for (std::size_t k = 0; k < is_left_out_.size(); ++k) {
      if (is_left_out_[k]) continue;
      Line line;
      line.name = "a line";
      for (const TileLines::Node& node : paths_->steps[k])
        line.points.push_back({static_cast<double>(node[0] * line_step()), static_cast<double>(node[1] * line_step()),
                               std::numeric_limits<double>::quiet_NaN()});
      options.features.breaklines.lines.push_back(std::move(line));
    }
  }

  Result<Mesh> refine(double max_error) const {
    HeightField field;
    field.samples = samples_.data();
    field.cols = cols();
    field.rows = rows();
    field.frame = grid_frame(field.rows);
    SimplifyOptions options;
    options.goals.max_error = max_error;
    options.domain.border.is_locked = true;
    options.domain.border.vertices = edges_;
    options.quality.effort = plan_.effort;
    options.output.float32_positions = false;
    options.run.threads = 1;
    const std::int32_t segments = std::min(level_.segments, steps()), side = steps() / segments;
    for (std::int32_t row = side; row < steps(); row += side) {
      for (std::int32_t col = side; col < steps(); col += side) options.features.points.push_back({col, row});
    }
    for (const auto& [row, col] : forced_) options.features.points.push_back({col, row - land_.top});
    add_lines_to(options);
    SCARP_TRY(auto&& simplified, simplify(field, options));
    return std::move(simplified.mesh);
  }

  TerrainTile quantize(const Mesh& mesh) const {
    // A mesh with integer positions, for the order of its vertices.
    Mesh whole;
    whole.triangles = mesh.triangles;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const std::array<double, 3> at = mesh.vertex(v);
      const auto parts = [](double way) { return static_cast<std::int64_t>(std::floor(way * kParts + 0.5)); };
      whole.positions.push_back(quantized(parts(at[0]), std::int64_t{kParts} * steps(), units_));
      whole.positions.push_back(rows_.v_of(parts(at[1]), kParts));
      whole.positions.push_back(quanta_of(at[2], level_.quantum));
    }
    optimize_order(whole);
    TerrainTile tile;
    tile.id = id_;
    tile.units = units_;
    tile.quantum = level_.quantum;
    tile.triangles = std::move(whole.triangles);
    for (std::size_t v = 0; v < whole.vertex_count(); ++v) {
      const std::array<double, 3> at = whole.vertex(v);
      tile.u.push_back(static_cast<std::uint16_t>(at[0]));
      tile.v.push_back(static_cast<std::uint16_t>(at[1]));
      tile.heights.push_back(static_cast<std::int32_t>(at[2]));
    }
    return tile;
  }

  /// Twice the triangle's area, in units.
  static std::int64_t area_of(const TerrainTile& tile, std::size_t first) {
    const std::uint32_t a = tile.triangles[first], b = tile.triangles[first + 1], c = tile.triangles[first + 2];
    const std::int64_t abx = tile.u[b] - tile.u[a], aby = tile.v[b] - tile.v[a];
    const std::int64_t acx = tile.u[c] - tile.u[a], acy = tile.v[c] - tile.v[a];
    return abx * acy - acx * aby;
  }

  /// Unfolds slivers next to lines after rounding: moves an inner corner by at most two quanta to the best place.
  static void unfold(TerrainTile& tile) {
    std::vector<std::vector<std::size_t>> stars;
    const auto least_area = [&](std::uint32_t v) {
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      for (const std::size_t first : stars[v]) least = std::min(least, area_of(tile, first));
      return least;
    };
    const auto move_to_best = [&](std::uint32_t v) {
      const std::int32_t u0 = tile.u[v], v0 = tile.v[v];
      if (u0 < 3 || v0 < 3 || u0 > 32764 || v0 > 32764) return;
      std::int64_t best = least_area(v);
      std::pair<std::int32_t, std::int32_t> place{u0, v0};
      for (std::int32_t dv = -2; dv <= 2; ++dv) {
        for (std::int32_t du = -2; du <= 2; ++du) {
          tile.u[v] = static_cast<std::uint16_t>(u0 + du);
          tile.v[v] = static_cast<std::uint16_t>(v0 + dv);
          if (const std::int64_t area = least_area(v); area > best) {
            best = area;
            place = {u0 + du, v0 + dv};
          }
        }
      }
      tile.u[v] = static_cast<std::uint16_t>(place.first);
      tile.v[v] = static_cast<std::uint16_t>(place.second);
    };
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
      bool is_folded = false;
      for (std::size_t first = 0; first < tile.triangles.size(); first += 3) {
        if (area_of(tile, first) > 0) continue;
        is_folded = true;
        if (stars.empty()) {
          stars.resize(tile.u.size());
          for (std::size_t k = 0; k < tile.triangles.size(); ++k) stars[tile.triangles[k]].push_back(k - k % 3);
        }
        for (std::size_t k = first; k < first + 3 && area_of(tile, first) <= 0; ++k) move_to_best(tile.triangles[k]);
      }
      if (!is_folded) return;
    }
  }

  /// Nodes at the corners of triangles that rounding has turned over.
  std::vector<SampleAt> find_folds(const TerrainTile& tile) const {
    std::vector<SampleAt> nodes;
    for (std::size_t k = 0; k < tile.triangles.size(); k += 3) {
      if (area_of(tile, k) > 0) continue;
      for (const std::uint32_t v : {tile.triangles[k], tile.triangles[k + 1], tile.triangles[k + 2]}) {
        nodes.push_back({nearest_node(tile.u[v], steps(), units_), rows_.nearest(tile.v[v])});
      }
    }
    return nodes;
  }

  void finish(TerrainTile& tile) const {
    const globe::Ground ground(plan_.grid, plan_.ellipsoid);
    tile.sag = largest_sag(tile, plan_.grid, ground);
    tile.normals = node_normals(tile, nodes_, rows_, plan_.grid, ground);
  }

  const PyramidPlan& plan_;
  const PyramidLevel& level_;
  TileId id_;
  const TileNodes& nodes_;
  const NodeArea land_;
  const std::int32_t units_;
  const TileRows rows_;
  const TileJudge& judge_;
  const TileLines::Paths* paths_ = nullptr;  ///< null: no line passes through the tile
  std::vector<bool> is_left_out_;            ///< by step of the paths
  std::vector<float> samples_;
  EdgeVertices edges_;
  std::set<std::pair<std::int32_t, std::int32_t>> forced_;  ///< row, column of nodes that must be vertices
};

/// The nodes next to places in units of the tile.
std::vector<SampleAt> nodes_at(const std::vector<FarPoint>& points, const TileRows& rows, std::int32_t units) {
  std::vector<SampleAt> nodes;
  for (const FarPoint& far : points) {
    nodes.push_back({static_cast<std::int32_t>(std::floor(far.u * rows.steps() / units + 0.5)),
                     rows.nearest(static_cast<std::uint16_t>(std::floor(far.v + 0.5)))});
  }
  return nodes;
}

TileVerdict judge_by_rows(const TerrainTile& tile, const TileNodes& nodes, const TileRows& rows) {
  const std::int32_t steps = nodes.steps();
  TileSurface surface(tile, tile.max_error);
  for (std::int32_t row = 0; row <= steps; ++row) {
    const double v = tile.units * (1 - rows.line(row) / steps);
    surface.judge(
        {0, v, static_cast<double>(tile.units) / steps, 0, {nodes.from(0, row), static_cast<std::size_t>(steps) + 1}});
  }
  return {surface.largest_error(), nodes_at(surface.far_points(), rows, tile.units)};
}

Result<TileVerdict> judge_at_nodes_and_samples(const TerrainTile& tile, const TileNodes& nodes, const TileGrid& grid,
                                               const NodeSource& source) {
  SCARP_TRY(auto&& verdict, judge_at_nodes(tile, nodes, grid));
  SCARP_TRY(const SampleVerdict& samples, judge_at_samples(tile, grid, nodes, source, tile.max_error));
  verdict.sample_error = samples.error;
  verdict.beside = nodes_at(samples.far_points, TileRows(grid, tile.id, nodes.steps()), tile.units);
  return verdict;
}

Result<KeptTile> make_within_limit(TileMaker maker, const PyramidPlan& plan, TileId id, const TileCompletion& complete,
                                   const TileEncoder& encode) {
  for (double max_error = plan.levels[static_cast<std::size_t>(id.z)].max_error;; max_error *= 2) {
    SCARP_TRY(auto&& tile, maker.make(max_error));
    SCARP_RETURN_IF_ERROR(complete(tile));
    KeptTile kept{std::move(tile), {}};
    if (!encode) return kept;
    SCARP_TRY(kept.bytes, encode(kept.tile));
    const bool fits = plan.max_tile_bytes == 0 || kept.bytes.size() <= plan.max_tile_bytes;
    if (fits || max_error >= maker.relief()) return kept;
  }
}

}  // namespace

Result<TileVerdict> judge_at_nodes(const TerrainTile& tile, const TileNodes& nodes, const TileGrid& grid) {
  if (const TileRows rows(grid, tile.id, nodes.steps()); !rows.are_even()) return judge_by_rows(tile, nodes, rows);
  NodeErrors errors = scan_nodes(tile, nodes, tile.max_error);
  if (errors.uncovered > 0)
    return fail(ErrorKind::kInternal, fmt::format("tile {}/{}/{} leaves {} of its nodes uncovered", tile.id.z,
                                                  tile.id.x, tile.id.y, errors.uncovered));
  return TileVerdict{errors.largest, std::move(errors.worst)};
}

TileProof proof_at_nodes(const PyramidPlan& plan, const TileNodes& nodes, const NodeSource& source) {
  return {[&](const TerrainTile& tile) {
            return plan.binds_samples ? judge_at_nodes_and_samples(tile, nodes, plan.grid, source)
                                      : judge_at_nodes(tile, nodes, plan.grid);
          },
          [&](TerrainTile& tile) -> Result<void> {
            SCARP_TRY(const SampleVerdict& verdict, judge_at_samples(tile, plan.grid, nodes, source));
            tile.source_error = verdict.error;
            return {};
          }};
}

Result<KeptTile> make_tile_of(const PyramidPlan& plan, TileId id, const TileNodes& nodes, const TileProof& proof,
                              const TileEncoder& encode) {
  if (!nodes.is_flat()) return make_within_limit({plan, id, nodes, proof.judge}, plan, id, proof.complete, encode);
  const bool has_lines = plan.lines != nullptr && plan.lines->find(id) != nullptr;
  const std::int32_t least = 2 * plan.levels[static_cast<std::size_t>(id.z)].segments;
  const TileNodes few = TileNodes::flat(plan, id, has_lines ? std::max(least, plan.cells) : least);
  const TileJudge judge = [&](const TerrainTile& tile) { return judge_at_nodes(tile, few, plan.grid); };
  return make_within_limit({plan, id, few, judge}, plan, id, proof.complete, encode);
}

}  // namespace scarp::tiles
