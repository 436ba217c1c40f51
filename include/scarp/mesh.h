// Use meshes as arrays of triangles: order them for a GPU, turn them y up, close them into a solid.
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
/// Meshes of simplify() have an origin with z = 0, so that z is the height of the sample. Their x and y are float32
/// values unless the options request double. In frames in space, "up" means away from the earth. Meshes read from files
/// keep the file's precision, so that measurements are not rounded.
struct Mesh {
  std::array<double, 3> origin{0, 0, 0};
  std::vector<double> positions;         ///< 3 per vertex: x, y, z offsets from origin
  std::vector<std::uint32_t> triangles;  ///< 3 vertex ids per triangle, counter-clockwise seen from +z
  std::vector<float> normals;            ///< empty, or 3 per vertex, unit length, z > 0
  std::vector<float>
      uvs;  ///< empty, or 2 per vertex: position in the raster's image, (0, 0) top left, (1, 1) bottom right
  std::vector<std::uint8_t> colors;  ///< empty, or red, green, blue per vertex, sRGB as in an image
  int channel_count = 0;             ///< additional values per vertex
  std::vector<float> channels;       ///< channel_count per vertex, in the order of HeightField::channels
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

/// Sorts triangles by position and for the vertex cache, and vertices by first use (meshoptimizer). Triangles keep
/// their corners and winding. Deterministic for any number of threads (0: one for each core). Unused vertices are
/// removed. Without meshoptimizer the order of triangles does not change. Cost: O(triangles).
void optimize_order(Mesh& mesh, int threads = 1);

/// Rotates the mesh so that y is up: (x, y, z) becomes (x, z, −y), also for normals, and metadata["up"] becomes "y".
/// undo_y_up() reverses this if is_y_up(); metadata["up"] is then "z". Both functions are exact. All other functions
/// except writers expect meshes with z up.
void turn_y_up(Mesh& mesh);
void undo_y_up(Mesh& mesh);
bool is_y_up(const Mesh& mesh);

/// Closes an open terrain mesh into a solid with a flat base at z = `base` (absolute) and vertical walls along all
/// border edges. Triangles face outward, and each edge has exactly two triangles. Vertices between the ends of a
/// straight border along x or y get no vertex below them. A part with n border vertices, c vertices below them, and h
/// holes gets n + c triangles for its walls and c + 2h − 2 for its base. Where two parts of the domain meet in a single
/// point, the vertex is duplicated, so that each part has its own. The solid is then closed by its indices. In formats
/// that store only positions (STL), four walls meet at that vertical edge; build_solid() separates them. Normals are
/// removed; a new vertex has the uvs, colours and channels of the vertex above it. REQUIRES: every edge has one or two
/// triangles; all triangles are counter-clockwise from above. Returns false, without change, unless the base is below
/// every vertex, also as float32 offsets. Cost: O(n log n).
bool add_base(Mesh& mesh, double base);

// From a terrain to a printable solid: closed, and placed in millimetres.

/// Placement of a solid: position = (position in the frame of the raster − origin) · scale. Scales are above 0.
struct Placement {
  std::array<double, 3> origin{0, 0, 0};
  std::array<double, 3> scale{1, 1, 1};
};

/// Places the mesh: the origin becomes 0, and positions are rounded to float32. metadata["placement"] contains the
/// placement; STL and every format with metadata store it. Normals are removed.
void place_mesh(Mesh& mesh, const Placement& placement);

/// Maps the rounded positions back to the raster's frame, by metadata["placement"]. Returns false, without change, for
/// a mesh that was not placed.
bool undo_placement(Mesh& mesh);

/// Closes a terrain into a solid as add_base() does, for readers that identify vertices by float32 positions. Positions
/// are rounded to float32 offsets. Where parts of the terrain meet in a single point, all parts except the first are
/// moved away from it by a few units in the last place. Attributes and normals are removed. Fails with kUsage if the
/// base is not below the lowest vertex (the message names the vertex's height), and with kPromise if the mesh is too
/// fine for its size: rounding merges vertices, so that the result is not a closed 2-manifold. REQUIRES: as add_base().
/// Cost: O(n log n).
Result<Mesh> build_solid(Mesh terrain, double base);

/// Properties of a solid as seen by readers that round positions to float32 and merge equal positions, as STL readers
/// do.
struct SolidFacts {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate = 0;        ///< triangles without area
  std::uint64_t faulty_edges = 0;      ///< edges that do not have exactly two triangles in opposite directions
  std::uint64_t pinched_vertices = 0;  ///< vertices with more than one fan of triangles
  std::uint64_t parts = 0;             ///< parts not connected by edges
  std::uint64_t inside_out = 0;        ///< parts whose volume is not positive
  double volume = 0;
  std::array<double, 3> low{}, high{};  ///< box of all vertices, in absolute coordinates

  /// True if the mesh is a closed 2-manifold that faces outward.
  bool is_solid() const {
    return triangles > 0 && degenerate == 0 && faulty_edges == 0 && pinched_vertices == 0 && inside_out == 0;
  }
  /// Such as "2 degenerate triangles, 4 faulty edges"; empty for a solid.
  std::string list_faults() const;
};
/// Measures a solid; exact except for volume and box. Cost: O(n log n).
SolidFacts measure_solid(const Mesh& mesh);

// Contour lines of a mesh.

/// A line at one height on a mesh. Each point lies on an edge of the mesh, and neighbouring points lie on the same
/// triangle, so the line follows the surface. The ground rises on its left.
struct Contour {
  double height = 0;                          ///< a multiple of the interval
  bool is_closed = false;                     ///< the last point connects to the first, which is not repeated
  std::vector<std::array<double, 2>> points;  ///< absolute x and y; at least two (closed: three), neighbours differ
};

/// The contours at all multiples of `interval`, in the unit of heights, between the lowest and the highest vertex of a
/// mesh with z up. The mesh follows the raster to within its max error, so a contour lies where the raster is within
/// `height` ± max error.
///
/// The point on an edge from its lower end a to its upper end b is a + (b − a) · (height − z of a) / (z of b − z of a)
/// in double. It is the same for both triangles of the edge. A vertex exactly at the height counts as above the height;
/// its point is the vertex itself. So a plateau at the height has a line along its border where the ground around it is
/// lower. A hollow whose bottom is at the height has no line; a ridge at the height has one line around it. A single
/// vertex or edge at the height with lower ground around it is omitted. No line branches, and lines touch only at
/// vertices. Each line is closed, or ends on the border of the mesh or at an edge without exactly two triangles in
/// opposite directions.
///
/// Lines are ordered by height, then by the first triangle that they cross. An open line begins at the end from which
/// the ground rises on its left, a closed one in its first triangle. Deterministic. Fails with kUsage if the interval
/// is not finite and above 0, or so small that there are more than 1,000,000 heights. REQUIRES: indices in range,
/// finite positions, fewer than 2^32 / 3 triangles. Cost: O(n log n + length of the lines). Memory: 20 bytes a triangle
/// and 16 a segment.
Result<std::vector<Contour>> find_contours(const Mesh& mesh, double interval);

}  // namespace scarp

#pragma GCC visibility pop
