// Topology of triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "measure/cut_region.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"

namespace scarp::judge {

/// For each vertex, the first vertex at exactly the same position. Connects the triangles of files without shared
/// vertices (STL).
std::vector<std::uint32_t> weld_vertices(const Mesh& mesh);

/// An edge with one triangle, in the direction of that triangle, with welded vertex ids.
struct OpenEdge {
  std::uint32_t from = 0, to = 0, triangle = 0;
};

struct EdgeReport {
  std::vector<OpenEdge> open;  ///< ordered by smaller, then larger vertex id
  std::uint64_t misoriented = 0, non_manifold = 0, loops = 0;
};

/// `welded`: from weld_vertices(); empty: all vertices are distinct. Triangles with two corners at one position have no
/// edges. In a mesh without open edges, an edge where two solids touch may have four triangles, two in each direction.
/// Cost: O(triangles).
EdgeReport check_edges(const Mesh& mesh, std::span<const std::uint32_t> welded);

/// How the triangles of a mesh are connected.
struct Connections {
  std::vector<std::uint32_t> welded;  ///< input of check_edges()
  EdgeReport edges;
  /// No two triangles overlap, and only vertices of open edges lie on an open edge, seen from above. False: unknown.
  bool is_single_layer = false;

  std::uint32_t vertex(std::uint32_t v) const { return welded.empty() ? v : welded[v]; }
};

/// `looks_up`: all triangles face up. Cost: O(triangles).
Connections connect(const Mesh& mesh, bool looks_up);

/// True if the border of a surface, with its triangles on the left of each open edge, winds around no point more than
/// once, up to the rounding of positions. False also if this cannot be decided quickly.
bool winds_once(const Mesh& mesh, std::span<const OpenEdge> open);

/// Vertices in the interior of an open edge, seen from above, within 1e-9 of the edge's length plus the uncertainty of
/// positions (float32, or double). Cost: O(vertices) for edges of ordinary shape.
std::uint64_t count_t_junctions(const Mesh& mesh, const Connections& connections);

/// Counts open edges beyond which the domain of `field` continues, within `region` (null: everywhere); see
/// Measurement::gaps. Cost: O(open edges · samples next to each · log), plus O(triangles) in unclear cases. Fails if
/// the field's source fails.
Result<std::uint64_t> count_gaps(const HeightField& field, const Mesh& mesh, const Connections& connections,
                                 double tolerance, const CutRegion* region);

/// Counts pairs among the triangles `ids` whose interiors, seen from above, overlap by more than rounding; at most
/// kMostOverlaps. `go_on` is called at intervals on this thread; false ends the search. Cost: O(triangles · log) for
/// meshes without overlaps and without vertices of huge degree.
constexpr std::uint64_t kMostOverlaps = 1000000;
std::uint64_t count_overlaps(const Mesh& mesh, std::span<const std::uint32_t> ids, int threads,
                             FunctionRef<bool(double fraction)> go_on);

/// Rounding of a position seen from above: four times half a unit in the last place of the largest coordinate, in
/// float32 if all positions are float32 values.
double position_noise(const Mesh& mesh);

/// Sets down_facing and degenerate.
void count_faults(const Mesh& mesh, int threads, Measurement& result);
/// Sets the angles of the `judged` triangles, seen along z.
void measure_angles(const Mesh& mesh, std::span<const std::uint32_t> judged, int threads, Measurement& result);

}  // namespace scarp::judge
