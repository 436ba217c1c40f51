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

}  // namespace scarp

#pragma GCC visibility pop
