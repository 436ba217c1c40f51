// Breaklines and cutlines of a height field, prepared for the engine.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lines/constraints.h"
#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"

namespace scarp::lines {

struct FieldLines {
  ConstraintGraph graph;
  /// The raster's samples. Nodata and samples well beyond a cutline are NaN. Samples on hard lines have the line's
  /// height. EMPTY: the field's samples apply.
  std::vector<float> samples;
  /// Replaces `samples`, without the cut, if the field has a source and samples are edited.
  std::shared_ptr<const SampleSource> source;
  std::vector<SampleEdit> edits;  ///< the changed samples on hard lines
  FarthestLine farthest;
  std::uint64_t inserted = 0;  ///< breaklines with a part in the raster, except lines inserted first
  std::uint64_t valid = 0;     ///< valid samples before the cut; 0: unknown

  /// `field` with these samples, which the result borrows.
  HeightField apply(const HeightField& field) const;
};

/// Soft lines and the rings of the cutline get additional vertices where the raster differs from a straight segment by
/// more than `tolerance`. The graph contains the parts of breaklines within the cutline. Fails if place_breaklines() or
/// the field's source fails, and with kInput if the cutline is known to contain no surface. `shared_rows`: for a field
/// with a source, the rows of samples that strips share and at which lines are cut. Samples near lines are read first.
/// REQUIRES: the field is no larger than the lattice; tolerance >= 0; lines and cutline in the same coordinates.
Result<FieldLines> prepare_lines(const HeightField& field, const LineConstraints& lines, const Cutline& cutline,
                                 double tolerance, int threads, std::span<const std::int32_t> shared_rows = {});

/// Memory of lines and rings in addition to the mesh, mostly during preparation: 300 bytes per vertex, and 100 per
/// sample along lines. Both lines of a wall share their samples.
std::uint64_t line_bytes(const HeightField& field, std::span<const Line> lines, const std::array<double, 6>& affine);
inline std::uint64_t line_bytes(const HeightField& field, const LineConstraints& lines) {
  return line_bytes(field, lines.lines, lines.affine);
}

/// Bytes of FieldLines::samples, which is used if lines may edit samples in memory or a cutline masks them.
std::uint64_t copied_bytes(const HeightField& field, const LineConstraints& lines, const Cutline& cutline);

}  // namespace scarp::lines
