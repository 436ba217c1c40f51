// Make a mesh from more points than memory holds. spool_points() of io.h sorts the points of LAS and LAZ files into
// blocks on disk.
//
// Example:
//     const std::string files[] = {"ground.las"};
//     SCARP_TRY(const auto& flight, scarp::spool_points(files, {}, scarp::DuplicatePolicy::kFirst, 1'000'000));
//     scarp::PointOptions options{.max_error = 0.5};
//     options.run.memory.limit = 2'000'000'000;
//     SCARP_TRY(const auto& terrain, scarp::simplify_points(*flight.blocks, options));
//     std::printf("%zu triangles for %llu points\n", terrain.made.simplified.mesh.triangle_count(),
//                 static_cast<unsigned long long>(terrain.made.points));
#pragma once

#include <cstddef>
#include <cstdint>

#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/points.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Points in blocks. A block's points are near each other in the plane. No two points of all blocks have equal x and y.
class PointBlocks {
 public:
  PointBlocks() = default;
  PointBlocks(const PointBlocks&) = delete;
  PointBlocks& operator=(const PointBlocks&) = delete;
  virtual ~PointBlocks() = default;

  /// Number of points in all blocks.
  virtual std::uint64_t size() const = 0;
  virtual std::size_t block_count() const = 0;
  /// The points of a block, finite, without lines; successive points are mostly neighbours. Every call returns the same
  /// points.
  virtual Result<PointSet> read(std::size_t block) const = 0;
};

struct SimplifiedBlocks {
  SimplifiedPoints made;  ///< `points` counts all; max_error_at is an index into `kept`
  PointSet kept;          ///< the points that the run used, and those with the largest errors
};

/// simplify_points() for points in blocks. The run uses every k-th point, at least every 16th, those at the hull, and
/// of each k neighbours the highest and the lowest above a first mesh. Then all points are judged, block by block.
/// Those that break the bound join the run, and refinement continues until none does. A run that ends at a budget is
/// repeated, at most four times, with points whose errors exceed its own. `options.run.memory` bounds the memory: k
/// grows with the number of points.
///
/// The mesh differs from that of simplify_points(), but has the same guarantees; without a bound, the reported errors
/// are those at all points. Fails like simplify_points(); with kUsage for high and max effort, tolerances,
/// boundary_length and placement; with kMemory if the limit has no space for the points that the bound needs; and with
/// the errors of read(). Cost: 5 to 10 reads of all blocks, and the run.
Result<SimplifiedBlocks> simplify_points(const PointBlocks& blocks, const PointOptions& options);

struct MeasuredBlocks {
  Measurement measured;  ///< max_error_at is an index into `worst`
  PointSet worst;        ///< the point with the largest error; empty if no point is covered
};

/// measure_points() for points in blocks. Fails with kUsage for options with tolerances, cutline, collect_above or
/// on_row, and with the errors of read(). Cost: two reads of all blocks.
Result<MeasuredBlocks> measure_points(const PointBlocks& blocks, const Mesh& mesh, const MeasureOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
