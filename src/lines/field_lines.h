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

namespace scarp {

struct FieldLines {
  ConstraintGraph graph;
  /// The raster's, NaN where nodata and well beyond a cutline, with those on hard lines at the height of the line.
  /// EMPTY: as the field has them.
  std::vector<float> samples;
  /// Instead, where the field has one and samples are edited; nothing of it is cut.
  std::shared_ptr<const SampleSource> source;
  std::vector<SampleEdit> edits;  ///< edits of these samples
  FarthestLine farthest;
  std::uint64_t inserted = 0;  ///< breaklines with some part in the raster, except those inserted first
  std::uint64_t valid = 0;     ///< samples, before the cut; 0: not known

  /// `field` with these samples, which stay here.
  HeightField apply(const HeightField& field) const;
};

/// Soft lines, and the rings of the cutline, get additional vertices where the raster differs from a straight segment
/// by more than `tolerance`. The graph contains the parts of breaklines within the cutline. Fails as
/// place_breaklines(), as the field's source, and with kInput if it is known that no surface lies in the cutline.
/// `shared_rows`: for a field with a source, the rows of samples that strips share, where lines are cut; the samples
/// near lines are read before. REQUIRES: the field is no larger than the lattice; tolerance >= 0; lines and cutline in
/// the same coordinates.
Result<FieldLines> prepare_lines(const HeightField& field, const LineConstraints& lines, const Cutline& cutline,
                                 double tolerance, int threads, std::span<const std::int32_t> shared_rows = {});

/// Memory of lines and rings in addition to the mesh, most of it while they are prepared: 300 bytes a vertex, and 100
/// for each sample that they run along, which both lines of a wall share.
std::uint64_t line_bytes(const HeightField& field, std::span<const Line> lines, const std::array<double, 6>& affine);
inline std::uint64_t line_bytes(const HeightField& field, const LineConstraints& lines) {
  return line_bytes(field, lines.lines, lines.affine);
}

/// Bytes of the samples in memory, where lines may edit them or a cutline makes some nodata: FieldLines::samples.
std::uint64_t copied_bytes(const HeightField& field, const LineConstraints& lines, const Cutline& cutline);

}  // namespace scarp
