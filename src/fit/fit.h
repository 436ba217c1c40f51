// The door of fitting: a mesh that keeps a bound is made smaller, and keeps it.
//
// The mesh is cut into patches (cut.h), each is worked on alone (removal.h), then squares shifted by half take what the
// borders of the first held back. Rounds of removal with repair (schedule.h) follow where they are wanted, on squares
// shifted in turn. Patches depend on the mesh only, so the result is the same on any number of threads.
#pragma once

#include <cstdint>
#include <functional>

#include "fit/cut.h"
#include "grid/raster.h"
#include "scarp/result.h"
#include "tin/triangulation.h"

namespace scarp {

struct FitOptions {
  double threshold = 0;
  int threads = 0;
  /// Whether vertices on the sides of the rectangle may go. They must stay where those sides are no straight lines in
  /// the mesh's frame.
  bool sides_are_free = true;
  /// After removal: rounds over all vertices of removal with repair (schedule.h). Vertices are then other samples than
  /// before.
  int repair_rounds = 0;
  int repair_depth = 4;  ///< rounds of repair for one vertex
  /// Repair may put vertices between samples, on the lattice of fitting, and at heights of their own.
  bool vertices_are_free = false;
  std::int32_t patch_side = 0;  ///< in samples; 0: squares of kPatchTriangles, one for small meshes
  /// Told the share that is done and the vertices that are left, on the calling thread; false stops with kCancelled.
  std::function<bool(double share, std::uint64_t vertices)> progress = {};
};

/// A patch of so many triangles and what belongs to it fits the caches of one core; its borders cost less than one
/// vertex in a thousand.
inline constexpr std::int64_t kPatchTriangles = 8192;

/// What a run takes at most for a vertex of the mesh that it is given, that mesh included: with one thread these two,
/// with each more the second.
inline constexpr std::uint64_t kFitBytesPerVertex = 200;
inline constexpr std::uint64_t kFitBytesPerVertexAndThread = 6;

struct FitCounts {
  std::uint64_t removed = 0;   ///< vertices
  std::uint64_t searches = 0;  ///< rings that were looked at
  std::uint64_t repaired = 0;  ///< of the removed vertices, those that went with repair
  std::uint64_t tried = 0;     ///< removals with repair that were begun
};

struct Fitted {
  Triangulation tin;  ///< its points in places.steps
  FitCounts counts;
  /// Steps of kLatticeSteps, and heights, if vertices were let free; else they are samples. Heights may leave the
  /// range of the samples by about the threshold.
  VertexPlaces places;
};

/// A triangulation of some of the vertices with the same domain and constraints, whose triangles keep the threshold at
/// every sample of the domain, in exact arithmetic. Vertices of the outline stay, but for those on the sides of the
/// rectangle; repair lets the others move, on a side along it. Where heights or extents are beyond kMaxScanHeight,
/// kMaxFitSteps, triangles stay as they are. Thresholds beyond 2⁻⁶⁰ … 2⁶⁰ are not repaired, sides beyond
/// kMaxCoordinate / kLatticeSteps samples on samples only.
/// Fails with kCancelled only. REQUIRES: the triangles inside keep the threshold and hold valid corners; threshold >= 0
/// and finite.
Result<Fitted> fit(const Raster& raster, Triangulation tin, const FitOptions& options);

}  // namespace scarp
