// The report on a pass.
#pragma once

#include <cstdint>
#include <string_view>

#include "metric/error_metric.h"
#include "scarp/simplify.h"

namespace scarp::run {

/// Bytes of a vertex and its two triangles in a finished mesh, in addition to the mesh of the run.
inline constexpr std::uint64_t kMeshBytesPerVertex = 48;

inline Pass pass_of(std::string_view name, double seconds, const Work& work = {}) {
  return {name, seconds, work.samples_scanned, work.triangles_scanned, work.passes};
}

/// Adds the work of a pass, or of all passes of a run, to `sum`.
inline void add_work(const Pass& pass, Pass& sum) {
  sum.samples_scanned += pass.samples_scanned;
  sum.triangles_scanned += pass.triangles_scanned;
  sum.insertions += pass.insertions;
  sum.removals += pass.removals;
}
inline void add_work(const Simplified& run, Pass& sum) {
  for (const Pass& pass : run.passes) add_work(pass, sum);
}

}  // namespace scarp::run
