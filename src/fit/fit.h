// The door of fitting: a mesh that keeps a bound is made smaller, and keeps it.
//
// The mesh is cut into patches (cut.h), each is worked on alone (removal.h), then squares shifted by half take what the
// borders of the first held back. Patches depend on the mesh only, so the result is the same on any number of threads.
#pragma once

#include <cstdint>

#include "fit/cut.h"
#include "grid/raster.h"
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
};

/// A patch of so many triangles and what belongs to it fits the caches of one core; its borders cost less than one
/// vertex in a thousand.
inline constexpr std::int64_t kPatchTriangles = 8192;

struct FitCounts {
  std::uint64_t removed = 0;   ///< vertices
  std::uint64_t searches = 0;  ///< rings that were looked at
  std::uint64_t repaired = 0;  ///< of the removed vertices, those that went with repair
  std::uint64_t tried = 0;     ///< removals with repair that were begun
};

struct Fitted {
  Triangulation tin;
  FitCounts counts;
  /// Steps of kLatticeSteps, and heights, if vertices were let free; else they are samples. Heights may leave the
  /// range of the samples by about the threshold.
  VertexPlaces places;
};

/// A triangulation of some of the vertices with the same domain and constraints, whose triangles keep the threshold at
/// every sample of the domain, in exact arithmetic. Vertices of the outline stay, but for those on the sides of the
/// rectangle. Where heights or extents are beyond kMaxScanHeight, kMaxFitSteps, triangles stay as they are.
/// REQUIRES: the triangles inside keep the threshold and hold valid corners; threshold >= 0 and finite.
Fitted fit(const Raster& raster, Triangulation tin, const FitOptions& options);

}  // namespace scarp
