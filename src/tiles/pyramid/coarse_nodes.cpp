#include "tiles/pyramid/coarse_nodes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "globe/row_range.h"
#include "tiles/mesh/tile_mesh_parts.h"
#include "tiles/mesh/tile_rows.h"
#include "tiles/pyramid/larger.h"

namespace scarp::tiles {
namespace {

/// Rounds a number outwards to single precision.
float rounded_down(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}
float rounded_up(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

/// A corner of a piece of a triangle, in cells from the tile's north-western corner, with the mesh's height.
struct Corner {
  double x = 0, y = 0, z = 0;
};

/// A convex piece of a triangle.
using Piece = std::vector<Corner>;

/// Cuts off the part of the piece where sign · coordinate > sign · limit.
void cut(Piece& piece, double Corner::*coordinate, double limit, double sign, Piece& scratch) {
  scratch.clear();
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const Corner& from = piece[k];
    const Corner& to = piece[(k + 1) % piece.size()];
    const double a = sign * (from.*coordinate - limit), b = sign * (to.*coordinate - limit);
    if (a <= 0) scratch.push_back(from);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const double t = a / (a - b);
      Corner corner{from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t, from.z + (to.z - from.z) * t};
      corner.*coordinate = limit;
      scratch.push_back(corner);
    }
  }
  piece.swap(scratch);
}

/// Extremes of mesh − surface on a piece in a cell. They are at its corners, or along sides where both slopes are
/// equal; never inside, because the surface is a saddle.
struct Extremes {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// `north`, `height`: those of the cell.
Extremes extremes(const Piece& piece, const Corners& surface, std::int32_t col, double north, double height) {
  Extremes found;
  const double bend = surface.nw - surface.ne - surface.sw + surface.se;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const Corner& from = piece[k];
    const Corner& to = piece[(k + 1) % piece.size()];
    const auto difference = [&](double t) {
      const double x = from.x + (to.x - from.x) * t - col, y = (from.y + (to.y - from.y) * t - north) / height;
      return from.z + (to.z - from.z) * t - surface.at(x, y);
    };
    found.add(difference(0));
    const double curve = -bend * (to.x - from.x) * ((to.y - from.y) / height);
    if (curve == 0) continue;
    const double t = 0.5 - (difference(1) - difference(0)) / (2 * curve);
    if (t > 0 && t < 1) found.add(difference(t));
  }
  return found;
}

}  // namespace

Result<CoarseTile> CoarseTile::reduce(const PyramidPlan& plan, TileId id, const TileNodes& nodes,
                                      const NodeSource& source) {
  CoarseTile tile;
  const std::int32_t step = nodes.steps() / kCoarseCells;
  const TileRows rows(plan.grid, id, nodes.steps());
  for (std::int32_t row = 0; row <= kCoarseCells; ++row) {
    for (std::int32_t col = 0; col <= kCoarseCells; ++col) tile.nodes_.push_back(nodes.at(col * step, row * step));
  }
  for (std::int32_t row = 0; row < kCoarseCells; ++row) {
    for (std::int32_t col = 0; col < kCoarseCells; ++col) {
      const Corners surface = tile.corners(col, row);
      double low = 0, high = 0;
      Extremes heights;
      const double north = rows.line(row * step), cell = rows.line((row + 1) * step) - north;
      for (std::int32_t y = 0; y <= step; ++y) {
        const double down = (rows.line(row * step + y) - north) / cell;
        const float* const from = nodes.from(col * step, row * step + y);
        for (std::int32_t x = 0; x <= step; ++x) {
          const double height = from[x];
          const double off = height - surface.at(static_cast<double>(x) / step, down);
          low = std::min(low, off);
          high = std::max(high, off);
          heights.add(height);
        }
      }
      tile.cells_.push_back(
          {rounded_down(low), rounded_up(high), static_cast<float>(heights.low), static_cast<float>(heights.high), 0});
    }
  }
  SCARP_RETURN_IF_ERROR(tile.look_at_samples(plan, id, nodes, source));
  return tile;
}

Result<void> CoarseTile::look_at_samples(const PyramidPlan& plan, TileId id, const TileNodes& nodes,
                                         const NodeSource& source) {
  if (!source.has_samples()) {
    for (CoarseCell& cell : cells_) cell.apart = std::numeric_limits<float>::quiet_NaN();
    return {};
  }
  const DegreeBox box = plan.grid.bounds_of(id);
  const double per_x = kCoarseCells / (box.east - box.west), per_y = kCoarseCells / (box.north - box.south);
  const double finer = static_cast<double>(nodes.steps()) / kCoarseCells;
  const TileRows rows(plan.grid, id, kCoarseCells), fine_rows(plan.grid, id, nodes.steps());
  return source.visit_samples(box, [&](const SampleRow& row) {
    const auto [first, end] = globe::range_within(row.longitude, row.step_longitude, row.latitude, row.step_latitude,
                                                  row.heights.size(), box);
    for (std::size_t i = first; i < end; ++i) {
      const double height = row.heights[i];
      const double x = (row.longitude + row.step_longitude * static_cast<double>(i) - box.west) * per_x;
      const double y = (box.north - row.latitude - row.step_latitude * static_cast<double>(i)) * per_y;
      const std::int32_t at_col = std::clamp(static_cast<std::int32_t>(x), 0, kCoarseCells - 1), at_row = rows.above(y);
      const double north = rows.line(at_row), down = (y - north) / (rows.line(at_row + 1) - north);
      CoarseCell& cell = cells_[static_cast<std::size_t>(at_row * kCoarseCells + at_col)];
      const double off = height - corners(at_col, at_row).at(x - at_col, down);
      const double apart = std::max(
          {off - double{cell.high}, double{cell.low} - off, height - double{cell.max}, double{cell.min} - height});
      if (!(apart > double{cell.apart})) continue;
      if (nodes.has_voids() && !nodes.has_heights_around(x * finer, fine_rows.above(y * finer))) continue;
      cell.apart = rounded_up(apart);
    }
  });
}

CoarseTile CoarseTile::flat(float height) {
  CoarseTile tile;
  tile.nodes_.assign((kCoarseCells + 1) * (kCoarseCells + 1), height);
  tile.cells_.assign(kCoarseCells * kCoarseCells, {0, 0, height, height, 0});
  tile.has_heights = false;
  return tile;
}

CoarseTile CoarseTile::join(const TileGrid& grid, TileId id, const std::array<const CoarseTile*, 4>& children) {
  CoarseTile tile;
  const TileRows rows(grid, id, 2 * kCoarseCells);
  // A local grid's raster may end on the border of two tiles, and then the second tile does not exist.
  const bool has_north = grid.has({id.z + 1, 2 * id.x, 2 * id.y + 1});
  const auto child_of = [&](std::int32_t& col, std::int32_t& row, std::int32_t last) {
    std::size_t which = 0;
    if (col > last) {
      col -= kCoarseCells;
      which += 1;
    }
    if (row > last || (row == kCoarseCells && !has_north)) {
      row -= kCoarseCells;
      which += 2;
    }
    return children[which];
  };
  const auto fine_node = [&](std::int32_t col, std::int32_t row) {
    const CoarseTile* child = child_of(col, row, kCoarseCells);
    return child->node(col, row);
  };
  const auto fine_cell = [&](std::int32_t col, std::int32_t row) {
    const CoarseTile* child = child_of(col, row, kCoarseCells - 1);
    return child->cell(col, row);
  };
  for (std::int32_t row = 0; row <= kCoarseCells; ++row) {
    for (std::int32_t col = 0; col <= kCoarseCells; ++col) tile.nodes_.push_back(fine_node(2 * col, 2 * row));
  }
  for (std::int32_t row = 0; row < kCoarseCells; ++row) {
    for (std::int32_t col = 0; col < kCoarseCells; ++col) {
      const Corners surface = tile.corners(col, row);
      double low = 0, high = 0;
      float samples_apart = 0;
      Extremes heights;
      const double north = rows.line(2 * row),
                   middle = (rows.line(2 * row + 1) - north) / (rows.line(2 * row + 2) - north);
      const double downs[] = {0, middle, 1};
      for (std::int32_t y = 0; y < 2; ++y) {
        for (std::int32_t x = 0; x < 2; ++x) {
          Extremes apart;
          for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
            apart.add(double{fine_node(2 * col + x + dx, 2 * row + y + dy)} -
                      surface.at((x + dx) / 2.0, downs[y + dy]));
          const CoarseCell fine = fine_cell(2 * col + x, 2 * row + y);
          low = std::min(low, apart.low + double{fine.low});
          high = std::max(high, apart.high + double{fine.high});
          heights.add(double{fine.min});
          heights.add(double{fine.max});
          samples_apart = larger(samples_apart, fine.apart);
        }
      }
      tile.cells_.push_back({rounded_down(low), rounded_up(high), static_cast<float>(heights.low),
                             static_cast<float>(heights.high), samples_apart});
    }
  }
  tile.has_heights =
      std::any_of(children.begin(), children.end(), [](const CoarseTile* child) { return child->has_heights; });
  return tile;
}

std::vector<std::uint8_t> CoarseTile::to_bytes() const {
  static_assert(std::endian::native == std::endian::little);
  const std::size_t nodes = nodes_.size() * sizeof(float), cells = cells_.size() * sizeof(CoarseCell);
  std::vector<std::uint8_t> bytes(nodes + cells);
  std::memcpy(bytes.data(), nodes_.data(), nodes);
  std::memcpy(bytes.data() + nodes, cells_.data(), cells);
  return bytes;
}

Result<CoarseTile> CoarseTile::from_bytes(std::span<const std::uint8_t> bytes) {
  CoarseTile tile = flat(0);
  const std::size_t nodes = tile.nodes_.size() * sizeof(float), cells = tile.cells_.size() * sizeof(CoarseCell);
  if (bytes.size() != nodes + cells) return fail(ErrorKind::kInput, "the reduced nodes of a block are damaged");
  std::memcpy(tile.nodes_.data(), bytes.data(), nodes);
  std::memcpy(tile.cells_.data(), bytes.data() + nodes, cells);
  tile.has_heights = true;
  return tile;
}

const CoarseTile& CoarseLevel::at(std::uint32_t x, std::uint32_t y) const {
  const auto found = tiles_.find(key(x, y));
  return found == tiles_.end() ? flat_ : found->second;
}

Result<void> CoarseLevel::read(const NodeWindow& window, std::span<float> out) const {
  const std::int64_t down = window.grid.rows(z_), turn = std::int64_t{window.grid.columns(z_)} * kCoarseCells;
  // The last nodes of a local grid's land are repeated outside.
  const NodeRange columns = window.grid.land_columns(turn), rows = window.grid.land_rows(turn);
  const std::int64_t last_column = (columns.last - 1) / kCoarseCells;
  for (int j = 0; j < window.rows; ++j) {
    const std::int64_t row = std::max(window.row + j, rows.first), tile_row = std::min(row / kCoarseCells, down - 1);
    for (int i = 0; i < window.cols; ++i) {
      const std::int64_t place = std::clamp(window.col + i, columns.first, columns.last);
      const std::int64_t col = window.grid.is_flat() ? place : ((place % turn) + turn) % turn;
      const std::int64_t tile_col = std::min(col / kCoarseCells, last_column);
      out[static_cast<std::size_t>(j) * static_cast<std::size_t>(window.cols) + static_cast<std::size_t>(i)] =
          at(static_cast<std::uint32_t>(tile_col), static_cast<std::uint32_t>(down - 1 - tile_row))
              .node(static_cast<std::int32_t>(col - tile_col * kCoarseCells),
                    static_cast<std::int32_t>(row - tile_row * kCoarseCells));
    }
  }
  return {};
}

CoarseVerdict bound_errors(const TerrainTile& tile, const TileGrid& grid, const CoarseLevel& level) {
  constexpr std::int32_t kSide = 2 * kCoarseCells;
  const TileRows rows(grid, tile.id, kSide);
  const Mesh mesh = decoded(tile, kSide);
  const auto corner = [&](std::uint32_t vertex) {
    const std::array<double, 3> at = mesh.vertex(vertex);
    return Corner{at[0], kSide - at[1], at[2]};
  };
  CoarseVerdict worst;
  Piece strip, piece, scratch;
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    const Piece triangle{corner(mesh.triangles[k]), corner(mesh.triangles[k + 1]), corner(mesh.triangles[k + 2])};
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    for (std::int32_t row = rows.above(low); row < kSide && rows.line(row) < high; ++row) {
      const double north = rows.line(row), south = rows.line(row + 1);
      strip = triangle;
      cut(strip, &Corner::y, north, -1, scratch);
      cut(strip, &Corner::y, south, 1, scratch);
      if (strip.size() < 3) continue;
      double left = kSide, right = 0;
      for (const Corner& at : strip) {
        left = std::min(left, at.x);
        right = std::max(right, at.x);
      }
      const std::int32_t first = std::clamp(static_cast<std::int32_t>(std::floor(left)), 0, kSide - 1);
      const std::int32_t last = std::clamp(static_cast<std::int32_t>(std::ceil(right)) - 1, first, kSide - 1);
      for (std::int32_t col = first; col <= last; ++col) {
        piece = strip;
        cut(piece, &Corner::x, col, -1, scratch);
        cut(piece, &Corner::x, col + 1, 1, scratch);
        if (piece.size() < 3) continue;
        const bool is_east = col >= kCoarseCells, is_south = row >= kCoarseCells;
        const CoarseTile& coarse = level.at(2 * tile.id.x + is_east, 2 * tile.id.y + !is_south);
        const std::int32_t x = col - is_east * kCoarseCells, y = row - is_south * kCoarseCells;
        const Corners surface = coarse.corners(x, y);
        const Extremes apart = extremes(piece, surface, col, north, south - north);
        const CoarseCell nodes = coarse.cell(x, y);
        const double from_surface = std::max(double{nodes.high} - apart.low, apart.high - double{nodes.low});
        Extremes flat;
        for (const Corner& at : piece) flat.add(at.z);
        const double from_range = std::max(double{nodes.max} - flat.low, flat.high - double{nodes.min});
        const double of_nodes = std::min(from_surface, from_range);
        worst.node_error = std::max(worst.node_error, of_nodes);
        worst.source_error = larger(worst.source_error, of_nodes + double{nodes.apart});
      }
    }
  }
  // Allowance for rounding in piece arithmetic.
  for (double* const error : {&worst.node_error, &worst.source_error}) *error = *error * (1 + 1e-9) + 1e-6;
  return worst;
}

}  // namespace scarp::tiles
