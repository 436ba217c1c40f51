// Ridges and valleys: the lines along which a surface bends most, found in the raster.
//
// A mesh of few triangles cuts the crest off a ridge and fills the bed of a valley, each by no more than its max error,
// but everywhere. Water then follows the triangles instead of the land. Lines along crests and beds, as edges of the
// mesh, keep them.
//
// Profiles decide what is a ridge (profile recognition: Chang, Song & Hsu, Computers & Geosciences 24:1, 1998; the
// highest and lowest samples of profiles: Peucker & Douglas, Computer Graphics and Image Processing 4:4, 1975). There
// are four profiles through a sample: along its row, its column and both diagonals. At least two of them must fall by
// the given height, on either side, before they rise above the sample. Lower noise is no ridge, nor is the flank of a
// cone, which bends along one profile only. Half the height is enough for samples that continue a ridge of full height.
// A maximum spanning tree links connected samples along the highest paths; its long branches are the ridges. Valleys
// are the ridges of the raster turned upside down, sample by sample.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/result.h"
#include "scarp/run.h"

#pragma GCC visibility push(default)

namespace scarp {

struct RidgeOptions {
  /// The least height of a ridge above the land on both sides of it, at most 16 samples away. In z units, above 0 and
  /// finite. It is of little use below the max error.
  double height = 0;
  /// Max error of the mesh to come, at least 0 and finite. Lines follow the raster to within half of it, as soft lines
  /// do.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< no ridge is searched for near these lines
  bool are_kept = false;                           ///< the final mesh holds all lines, whatever the effort
  /// For a field with a source: bytes that the process may use, and bytes in use, as in SimplifyOptions.
  /// Ridges that do not fit are refused with kMemory, before memory runs out. DEFAULT: no limit.
  Run run = {};
};

struct Ridges {
  /// Soft lines for Features::breaklines, vertices on samples. Their kind is kRidge or kKeptRidge.
  std::vector<Line> ridges, valleys;
  std::uint64_t vertices = 0;  ///< number of vertices of the lines; where several meet, once for each
};

/// Finds the ridges and valleys of a raster, in an order that depends on the raster only. Each line runs within a
/// sample of the highest or lowest samples that it represents, with as few vertices as that and the bound allow. Where
/// one line joins another, both have a vertex. Lines of fewer than 8 samples are omitted. Negating all samples
/// exchanges ridges and valleys, and changes nothing else. Nodata ends a profile; the part before it counts.
///
/// Fails with kUsage for options out of range, with kCancelled, and as the field's source does. A source is read four
/// times from the top down, and gives the same lines as the same samples in memory. REQUIRES: the affine map can be
/// inverted. Memory: 6 bytes a sample, and some 50 for each sample near a high or low one; of a source, those 50 alone.
/// Cost: O(samples) and O(n log n) for the n samples near lines; some 0.1 to 0.3 s a million samples of land, up to 1 s
/// of noise.
Result<Ridges> detect_ridges(const HeightField& field, const RidgeOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
