// A large print consists of print tiles. The cuts follow rows and columns of samples, where the mesh can have edges
// whose ends lie on samples. A tab in the middle of each shared edge is a trapezoid that is wider at its head, so that
// print tiles interlock like a jigsaw and are assembled from above.
//
// Every cut is a polyline across the raster. simplify() inserts it into the mesh as a soft line, so that each triangle
// lies on one side of the line, and belongs to the print tile that contains its centre. Both neighbours get their
// vertices from the same mesh, so their edges are identical.
//
// A gap lies between two polylines, each half the gap's width from the cut; no print tile covers it.

#include "mesh/print_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scarp::mesh {
namespace {

using Point2 = std::array<double, 2>;

constexpr int kLeastCells = 2;                               // smallest number of cells across a print tile
constexpr int kLeastTabCells = 12;                           // smallest number of cells across a print tile with tabs
constexpr double kHead = 0.30, kNeck = 0.18, kDepth = 0.12;  // relative to the print tile that the tab touches

/// The indices of samples at which print tiles begin and end.
std::vector<int> divide(int samples, int parts) {
  std::vector<int> at;
  for (int k = 0; k <= parts; ++k) {
    at.push_back(static_cast<int>((std::int64_t{samples - 1} * k + parts / 2) / parts));
  }
  return at;
}

/// A cut at `across`, from the first sample to the last: straight, or with a tab in the middle of each print tile.
/// Points are (along, across).
std::vector<Point2> draw_cut(int across, const std::vector<int>& tiles, double depth, bool dovetail) {
  std::vector<Point2> cut{{double(tiles.front()), double(across)}};
  for (std::size_t k = 0; dovetail && k + 1 < tiles.size(); ++k) {
    const double middle = (tiles[k] + tiles[k + 1]) / 2, span = tiles[k + 1] - tiles[k];
    const double neck = std::max(1.0, std::round(span * kNeck / 2)),
                 head = std::max(neck + 1, std::round(span * kHead / 2));
    const double from = std::floor(middle);
    cut.push_back({from - neck, double(across)});
    cut.push_back({from - head, across + depth});
    cut.push_back({from + head, across + depth});
    cut.push_back({from + neck, double(across)});
  }
  cut.push_back({double(tiles.back()), double(across)});
  return cut;
}

/// The polyline offset by `distance` to its left, in units of `cell`; its ends do not move along the cut. Points are
/// (along, across).
std::vector<Point2> shift(const std::vector<Point2>& line, double distance, Point2 cell) {
  if (distance == 0) return line;
  const auto normal = [&](std::size_t k) {  // normal of the segment from point k
    const double x = (line[k + 1][0] - line[k][0]) * cell[0], y = (line[k + 1][1] - line[k][1]) * cell[1];
    const double length = std::hypot(x, y);
    return Point2{-y / length, x / length};
  };
  std::vector<Point2> shifted;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point2 a = normal(k > 0 ? k - 1 : 0), b = normal(std::min(k, line.size() - 2));
    // The point at this distance from both segments, along the bisector.
    const double scale = distance / (1 + a[0] * b[0] + a[1] * b[1]);
    shifted.push_back({line[k][0] + scale * (a[0] + b[0]) / cell[0], line[k][1] + scale * (a[1] + b[1]) / cell[1]});
  }
  return shifted;
}

void turn_over(std::vector<Point2>& line) {
  for (Point2& point : line) std::swap(point[0], point[1]);
}

/// True if the point lies before a cut, by the number of crossings between it and the far end. The cut continues
/// straight at both ends. Points are (along, across).
bool is_before(const std::vector<Point2>& cut, Point2 p) {
  bool before = false;
  for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
    Point2 a = cut[k], b = cut[k + 1];
    if (k == 0) a[0] = -std::numeric_limits<double>::infinity();
    if (k + 2 == cut.size()) b[0] = std::numeric_limits<double>::infinity();
    if ((a[0] <= p[0]) == (b[0] <= p[0])) continue;
    const bool is_level = a[1] == b[1];
    const double across = is_level ? a[1] : a[1] + (b[1] - a[1]) * ((p[0] - a[0]) / (b[0] - a[0]));
    if (p[1] < across) before = !before;
  }
  return before;
}

Result<void> check_span(const char* what, int samples, int parts, bool dovetail) {
  const int least = dovetail ? kLeastTabCells : kLeastCells;
  if (parts >= 1 && (samples - 1) / parts >= least) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} samples cannot be cut into {} {} of print tiles: each needs {} cells{}", samples, parts,
                          what, least, dovetail ? " to hold its tabs" : ""));
}

}  // namespace

Result<PrintTilePlan> PrintTilePlan::make(int cols, int rows, const PrintTileOptions& options) {
  SCARP_RETURN_IF_ERROR(check_span("columns", cols, options.columns, options.dovetail));
  SCARP_RETURN_IF_ERROR(check_span("rows", rows, options.rows, options.dovetail));
  const std::vector<int> along_cols = divide(cols, options.columns), along_rows = divide(rows, options.rows);
  const double width = (cols - 1.0) / options.columns, height = (rows - 1.0) / options.rows;
  // A tab and its gap must not meet neighbouring tabs and gaps: half the narrower side exceeds their total.
  const double narrowest = std::min(width * options.cell[0], height * options.cell[1]);
  const double widest = narrowest * (options.dovetail ? kNeck / 4 : 0.25);
  if (!(options.gap >= 0) || options.gap > widest) {
    return fail(ErrorKind::kUsage,
                fmt::format("a gap of {:.6g} between print tiles is too wide: they leave room for {:.6g}", options.gap,
                            widest));
  }
  PrintTilePlan plan;
  plan.options_ = options;
  const double depth = kDepth * narrowest;
  const auto cut = [&](int across, const std::vector<int>& tiles, Point2 cell) {
    const std::vector<Point2> line =
        draw_cut(across, tiles, std::max(1.0, std::round(depth / cell[1])), options.dovetail);
    return Cut{shift(line, -options.gap / 2, cell), shift(line, options.gap / 2, cell)};
  };
  for (int k = 1; k < options.columns; ++k) {
    Cut next = cut(along_cols[static_cast<std::size_t>(k)], along_rows, {options.cell[1], options.cell[0]});
    turn_over(next.low);
    turn_over(next.high);
    plan.column_cuts_.push_back(std::move(next));
  }
  for (int k = 1; k < options.rows; ++k)
    plan.row_cuts_.push_back(cut(along_rows[static_cast<std::size_t>(k)], along_cols, options.cell));
  return plan;
}

std::vector<Line> PrintTilePlan::lines(const std::array<double, 6>& affine) const {
  std::vector<Line> lines;
  const auto add = [&](const std::vector<Point2>& cut, const char* what, std::size_t number) {
    Line line;
    line.name = fmt::format("cut {} between {}", number + 1, what);
    for (const auto& [col, row] : cut) {
      line.points.push_back({affine[0] + affine[1] * col + affine[2] * row,
                             affine[3] + affine[4] * col + affine[5] * row, std::numeric_limits<double>::quiet_NaN()});
    }
    lines.push_back(std::move(line));
  };
  const auto add_all = [&](const std::vector<Cut>& cuts, const char* what) {
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      add(cuts[k].low, what, k);
      if (options_.gap > 0) add(cuts[k].high, what, k);
    }
  };
  add_all(column_cuts_, "columns of print tiles");
  add_all(row_cuts_, "rows of print tiles");
  return lines;
}

std::optional<int> PrintTilePlan::interval_at(const std::vector<Cut>& cuts, bool across_columns, Point2 at) const {
  const auto is_before_cut = [&](std::vector<Point2> line) {
    if (across_columns) turn_over(line);
    return is_before(line, across_columns ? Point2{at[1], at[0]} : at);
  };
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    if (is_before_cut(cuts[k].low)) return static_cast<int>(k);
    if (options_.gap > 0 && is_before_cut(cuts[k].high)) return std::nullopt;
  }
  return static_cast<int>(cuts.size());
}

std::optional<int> PrintTilePlan::tile_at(double col, double row) const {
  const std::optional<int> column = interval_at(column_cuts_, true, {col, row}),
                           down = interval_at(row_cuts_, false, {col, row});
  if (!column || !down) return std::nullopt;
  return *down * options_.columns + *column;
}

std::vector<Mesh> cut_print_tiles(const Mesh& terrain, const Frame& frame, const PrintTilePlan& plan) {
  std::vector<Mesh> tiles(static_cast<std::size_t>(plan.columns() * plan.rows()));
  for (Mesh& tile : tiles) {
    tile.origin = terrain.origin;
    tile.metadata = terrain.metadata;
  }
  const std::array<double, 6>& a = frame.affine;
  constexpr std::uint32_t kNoVertex = 0xffffffff;
  std::vector<std::vector<std::uint32_t>> ids(tiles.size());
  for (std::size_t t = 0; t < terrain.triangles.size(); t += 3) {
    double x = 0, y = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto corner = terrain.vertex(terrain.triangles[t + k]);
      x += (corner[0] - a[0]) / 3;
      y += (corner[1] - a[3]) / 3;
    }
    const double determinant = frame.determinant();
    const std::optional<int> at =
        plan.tile_at((a[5] * x - a[2] * y) / determinant, (a[1] * y - a[4] * x) / determinant);
    if (!at) continue;
    const auto k = static_cast<std::size_t>(*at);
    if (ids[k].empty()) ids[k].assign(terrain.vertex_count(), kNoVertex);
    for (std::size_t corner = t; corner < t + 3; ++corner) {
      const std::size_t v = terrain.triangles[corner];
      if (ids[k][v] == kNoVertex) {
        ids[k][v] = static_cast<std::uint32_t>(tiles[k].vertex_count());
        for (std::size_t i = 3 * v; i < 3 * v + 3; ++i) tiles[k].positions.push_back(terrain.positions[i]);
      }
      tiles[k].triangles.push_back(ids[k][v]);
    }
  }
  return tiles;
}

}  // namespace scarp::mesh
