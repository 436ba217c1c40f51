// The division of a terrain into print tiles that fit together.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp::mesh {

/// How to divide a terrain into print tiles.
struct PrintTileOptions {
  int columns = 1, rows = 1;         ///< number of print tiles, at least 1
  bool dovetail = false;             ///< a trapezoid tab in the middle of each edge between two tiles. DEFAULT: none.
  double gap = 0;                    ///< between neighbouring tiles, in the unit of `cell`, at least 0
  std::array<double, 2> cell{1, 1};  ///< width and height of a cell of the raster
};

/// The cuts along rows and columns of samples, with protruding tabs.
class PrintTilePlan {
 public:
  /// Fails with kUsage if a tile would be too narrow for two cells, its tabs or its gap; the error contains the number
  /// of samples.
  static Result<PrintTilePlan> make(int cols, int rows, const PrintTileOptions& options);

  /// The cuts as soft lines for Features::breaklines, one for each line at which tiles end; `affine` as
  /// LineConstraints::affine.
  std::vector<Line> lines(const std::array<double, 6>& affine) const;
  /// The number of the tile at a position in the grid, by rows from the top left; none in a gap.
  std::optional<int> tile_at(double col, double row) const;
  int columns() const { return options_.columns; }
  int rows() const { return options_.rows; }

 private:
  using Point2 = std::array<double, 2>;  // column, row
  struct Cut {
    std::vector<Point2> low, high;  // end of the previous tile and start of the next, equal without a gap
  };
  std::optional<int> interval_at(const std::vector<Cut>& cuts, bool across_columns, Point2 at) const;

  PrintTileOptions options_;
  std::vector<Cut> column_cuts_, row_cuts_;
};

/// The triangles of each tile, assigned by their centres, as meshes with separate vertices. Vertices along a cut have
/// the same positions on both sides. Tiles without triangles are empty. Attributes are dropped.
/// REQUIRES: `frame` is the mesh's frame and affine. Cost: O(n).
std::vector<Mesh> cut_print_tiles(const Mesh& terrain, const Frame& frame, const PrintTilePlan& plan);

}  // namespace scarp::mesh

#pragma GCC visibility pop
