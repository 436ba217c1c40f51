// Use the triangles that simplify() makes as arrays: order them for a GPU, turn them y up, close them into a solid.
//
// Example:
//     scarp::Mesh mesh;
//     mesh.positions = {0, 0, 1, 10, 0, 2, 0, 10, 3};  // x, y, z of three vertices, from mesh.origin
//     mesh.triangles = {0, 1, 2};                      // counter-clockwise from above
//     SCARP_TRY(const scarp::Mesh& solid, scarp::build_solid(mesh, 0));
//     std::printf("%zu triangles, closed: %d\n", solid.triangle_count(), scarp::measure_solid(solid).is_solid());
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// A triangle mesh. Vertex v lies at origin + (positions[3v], positions[3v+1], positions[3v+2]); x east, y north, z up.
///
/// Meshes made by simplify() have an origin with z = 0, so z is the sample itself, but for frames in space, where "up"
/// is away from the earth. Their x and y are exactly float32 values unless the options ask for double. Meshes read from
/// files keep the file's precision, so that measuring them rounds nothing.
struct Mesh {
  std::array<double, 3> origin{0, 0, 0};
  std::vector<double> positions;         ///< 3 per vertex: x, y, z offsets from origin
  std::vector<std::uint32_t> triangles;  ///< 3 vertex ids per triangle, counter-clockwise seen from +z
  std::vector<float> normals;            ///< empty, or 3 per vertex, unit length, z > 0
  std::vector<float>
      uvs;  ///< empty, or 2 per vertex: position in the raster's image, (0, 0) top left, (1, 1) bottom right
  std::vector<std::uint8_t> colors;  ///< empty, or red, green, blue per vertex, sRGB as in an image
  int channel_count = 0;             ///< further values per vertex
  std::vector<float> channels;       ///< channel_count per vertex, as they are in HeightField::channels
  /// Description of the mesh, for file headers: "generator", "command", "frame", "crs", … Written to every format that
  /// has a field for it, and read back.
  std::map<std::string, std::string> metadata;

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
  /// Absolute position of a vertex, in double.
  std::array<double, 3> vertex(std::size_t v) const {
    return {origin[0] + positions[3 * v], origin[1] + positions[3 * v + 1], origin[2] + positions[3 * v + 2]};
  }
};

/// Sorts triangles by place and for the vertex cache, and vertices by first use (meshoptimizer). Same triangles, same
/// corners, same winding; deterministic, and the same for any number of threads (0: one for each core). Unused vertices
/// are dropped. Without meshoptimizer triangles stay where they are. Cost: O(triangles).
void optimize_order(Mesh& mesh, int threads = 1);

/// Turns the mesh y up: (x, y, z) becomes (x, z, −y), normals too, and metadata["up"] is "y". undo_y_up() turns a mesh
/// that is_y_up() back; its metadata["up"] is then "z". Both are exact. All functions but these and the writers expect
/// meshes that are z up.
void turn_y_up(Mesh& mesh);
void undo_y_up(Mesh& mesh);
bool is_y_up(const Mesh& mesh);

/// Closes an open terrain mesh into a solid: a flat base at z = `base` (absolute) and vertical walls along every border
/// edge, outward-oriented, so that each edge has exactly two triangles. Border vertices between their neighbours on a
/// line along x or y have no vertex below them: a part with n border vertices, of which c have one, and h holes gets
/// n + c triangles for its walls and c + 2h − 2 for its base. Vertices where two parts of the domain meet in a single
/// point are duplicated, one for each part. The solid is then closed by its indices; formats with positions only (STL)
/// show four walls along that vertical edge (build_solid() separates them).
/// Normals are dropped; uvs, colours and channels of a new vertex are those of the vertex above it.
/// REQUIRES: every edge has one or two triangles, all counter-clockwise from above; base below every vertex.
/// Returns false (mesh unchanged) if the base is not below every vertex, in float32 offsets too. Cost: O(n log n).
bool add_base(Mesh& mesh, double base);

// From a terrain to a printable solid: closed, and placed in millimetres.

/// Placement of a solid: position = (position in the frame of the raster − origin) · scale. Scales are above 0.
struct Placement {
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> scale{1, 1, 1};
};

/// Places the mesh: origin becomes 0, positions are rounded to float32, metadata["placement"] holds the numbers.
/// Normals are dropped. STL, and every format with metadata, stores the numbers.
void place_mesh(Mesh& mesh, const Placement& placement);

/// The inverse, by metadata["placement"]: maps the rounded positions back to the raster's frame. Returns false, and
/// does not change the mesh, if it was not placed.
bool undo_placement(Mesh& mesh);

/// Closes a terrain into a solid as add_base() does, for readers that identify vertices by float32 positions. Positions
/// are rounded to float32 offsets. Where parts of the terrain meet in a single point, all but the first move back from
/// it by a few units in the last place. Attributes and normals are dropped.
/// Fails with kUsage if the base is not below the lowest vertex (names its height), with kPromise if the result is no
/// closed 2-manifold: rounding has merged vertices, and the mesh is too fine for its size.
/// REQUIRES: as add_base(). Cost: O(n log n).
Result<Mesh> build_solid(Mesh terrain, double base);

/// Facts for a reader that rounds positions to float32 and merges vertices at the same position, as STL readers do.
struct SolidFacts {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate = 0;    ///< triangles without area
  std::uint64_t faulty_edges = 0;  ///< edges without exactly two triangles that run along them in opposite directions
  std::uint64_t pinched_vertices = 0;  ///< vertices with more than one fan of triangles
  std::uint64_t parts = 0;             ///< parts not connected by edges
  std::uint64_t inside_out = 0;        ///< parts whose volume is not positive
  double volume = 0;
  std::array<double, 3> low{}, high{};  ///< box of all vertices, the mesh's origin included

  /// Closed, each edge and each vertex as on a surface, facing outward.
  bool is_solid() const {
    return triangles > 0 && degenerate == 0 && faulty_edges == 0 && pinched_vertices == 0 && inside_out == 0;
  }
  /// "2 degenerate triangles, 4 faulty edges"; empty if it is a solid.
  std::string list_faults() const;
};
/// Exact but for volume and size. Cost: O(n log n).
SolidFacts measure_solid(const Mesh& mesh);

// Contour lines of a mesh.

/// A line at one height on a mesh. Each point lies on an edge of the mesh, and neighbours on edges of one triangle, so
/// the line follows the surface. The ground rises on its left.
struct Contour {
  double height = 0;                          ///< a multiple of the interval
  bool is_closed = false;                     ///< the last point joins the first, which is not repeated
  std::vector<std::array<double, 2>> points;  ///< absolute x and y; two at least, three of a closed line, no two
                                              ///< neighbours equal
};

/// The contours at all multiples of `interval` between the lowest and the highest vertex of a mesh that is z up, in the
/// unit of its heights. Within the max error of the mesh its heights are those of the raster, so a contour lies in the
/// raster's band of heights `height` ± max error.
///
/// A point on the edge from a to b, a the lower end, is a + (b − a) · (height − z of a) / (z of b − z of a) in double;
/// both triangles of the edge have the same. A vertex exactly at the height counts as above it, and its point is the
/// vertex itself: a plateau at the height has a line along its border where the ground around it is lower, a hollow at
/// the height has none, a ridge at the height has one line around it. A single vertex or edge at the height with lower
/// ground around it is omitted. So no line branches, lines touch at vertices at most, and each is closed or ends on the
/// border of the mesh, or at an edge that does not have exactly two triangles in opposite directions.
///
/// The order is by height, then by the first triangle that a line crosses; a line that is not closed begins where the
/// ground rises on its left, a closed one in its first triangle. Deterministic. Fails with kUsage if the interval is
/// not above 0 and finite, or so small that there are more than 1,000,000 heights. REQUIRES: indices in range, finite
/// positions, fewer than 2^32 / 3 triangles. Cost: O(n log n + length of the lines), 20 bytes a triangle and 16 a
/// segment while it runs.
Result<std::vector<Contour>> find_contours(const Mesh& mesh, double interval);

}  // namespace scarp

#pragma GCC visibility pop
