// From a terrain to solids that can be printed: closed, in millimetres, whole or in sheets that fit together.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/frame.h"
#include "scarp/lines.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Where a solid stands: position = (place in the frame of the raster − origin) · scale. Scales are above 0.
struct Placement {
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> scale{1, 1, 1};
};

/// Puts the mesh in its place: origin becomes 0, positions are rounded to float32, metadata["placement"] tells the
/// numbers. Normals are dropped. Every writer with a place for metadata, and STL, hands them on.
void place_mesh(Mesh& mesh, const Placement& placement);

/// The reverse, by metadata["placement"]: positions are in the raster's frame again, as the rounded ones stand for it.
/// False, and the mesh unchanged, if it was not placed.
bool undo_placement(Mesh& mesh);

/// Closes a terrain into a solid as add_base() does, for readers that know places only and take positions as float32:
/// positions are rounded to float32 offsets, and where parts of the terrain meet in a single point all but the first
/// step back from it by a few units in the last place. Attributes and normals are dropped.
/// Fails with kUsage if the base is not below the lowest vertex (names its height), with kPromise if the result is no
/// closed 2-manifold: rounding has laid vertices on each other, and the mesh is too fine for its size.
/// REQUIRES: as add_base(). Cost: O(n log n).
Result<Mesh> build_solid(Mesh terrain, double base);

/// What a reader finds that rounds positions to float32 and takes vertices at one place for one, as those of STL do.
struct SolidFacts {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate = 0;    ///< triangles without area
  std::uint64_t faulty_edges = 0;  ///< edges without exactly two triangles that run along them in opposite directions
  std::uint64_t pinched_vertices = 0;  ///< vertices with more than one fan of triangles
  std::uint64_t parts = 0;             ///< that no edge connects
  std::uint64_t inside_out = 0;        ///< parts whose volume is not positive
  double volume = 0;
  std::array<double, 3> low{}, high{};  ///< of all vertices, the mesh's origin included

  /// Closed, each edge and each vertex as on a surface, facing outward.
  bool is_solid() const {
    return triangles > 0 && degenerate == 0 && faulty_edges == 0 && pinched_vertices == 0 && inside_out == 0;
  }
  /// "2 degenerate triangles, 4 faulty edges"; empty if it is a solid.
  std::string list_faults() const;
};
/// Exact but for volume and size. Cost: O(n log n).
SolidFacts measure_solid(const Mesh& mesh);

/// How a terrain is cut into sheets.
struct SheetOptions {
  int columns = 1, rows = 1;  ///< of sheets, at least 1
  bool dovetail = false;      ///< a trapezoid tab in the middle of each edge that two sheets share. DEFAULT: none.
  double gap = 0;             ///< between neighbours, in the unit of `cell`, at least 0
  std::array<double, 2> cell{1, 1};  ///< width and height of a cell of the raster
};

/// Cuts along rows and columns of samples, from which tabs stand out.
class SheetPlan {
 public:
  /// Fails with kUsage where a sheet would be too narrow for two cells, its tabs or its gap: names the number of
  /// samples.
  static Result<SheetPlan> make(int cols, int rows, const SheetOptions& options);

  /// The cuts as soft lines for SimplifyOptions::breaklines, one after the other along which sheets end; `affine` as
  /// LineConstraints::affine.
  std::vector<Line> lines(const std::array<double, 6>& affine) const;
  /// The sheet of a place between the samples, row by row from the top left; nothing in a gap.
  std::optional<int> sheet_at(double col, double row) const;
  int columns() const { return options_.columns; }
  int rows() const { return options_.rows; }

 private:
  using Point2 = std::array<double, 2>;  // column, row
  struct Cut {
    std::vector<Point2> low, high;  // where the sheet before ends, and where the one behind begins; equal without a gap
  };
  std::optional<int> interval_at(const std::vector<Cut>& cuts, bool across_columns, Point2 at) const;

  SheetOptions options_;
  std::vector<Cut> column_cuts_, row_cuts_;
};

/// The triangles of each sheet, by their centres, as meshes with vertices of their own, which have the same positions
/// in both neighbours of a cut. Sheets without triangles are empty. Attributes are dropped.
/// REQUIRES: the frame is affine, and it is the mesh's. Cost: O(n).
std::vector<Mesh> cut_sheets(const Mesh& terrain, const Frame& frame, const SheetPlan& plan);

}  // namespace scarp

#pragma GCC visibility pop
