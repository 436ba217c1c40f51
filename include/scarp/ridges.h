// Ridges and valleys: the lines along which a surface bends most, found in the raster.
//
// A mesh of few triangles cuts the crest off a ridge and fills the bed of a valley, each by no more than its max error,
// but everywhere: water then runs where the triangles want it. Lines along crests and beds, as edges of the mesh, keep
// them.
//
// What is a ridge is asked of profiles (profile recognition: Chang, Song & Hsu, Computers & Geosciences 24:1, 1998; the
// highest and lowest samples of profiles: Peucker & Douglas, Computer Graphics and Image Processing 4:4, 1975). Of the
// four profiles through a sample (along its row, its column, both diagonals) two at least must fall by the height that
// was asked for, on either side, before they rise above the sample. Noise that is lower is no ridge, nor is the flank
// of a cone, which bends along one profile only. What hangs together of such samples, with half the height where it
// continues what has all of it, is linked by the tree whose ways keep as high as they can (a maximum spanning tree),
// and its long branches are the ridges. Valleys are the ridges of the raster turned upside down, sample by sample.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/lines.h"
#include "scarp/progress.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

struct RidgeOptions {
  /// By how much a ridge must stand out of the land on both sides of it, at most 16 samples away. In z units, above 0
  /// and finite. Of little use below the max error.
  double height = 0;
  /// Of the mesh to come, at least 0 and finite: lines follow the raster to within half of it, as soft lines do.
  double max_error = 0;
  std::array<double, 6> affine{0, 1, 0, 0, 0, 1};  ///< from samples to the coordinates of lines: map_affine()
  std::span<const Line> avoid = {};                ///< lines near which nothing is looked for
  bool are_kept = false;                           ///< the mesh holds all lines in the end, whatever the effort
  int threads = 0;                                 ///< 0: all cores; never changes the result
  ProgressCallback progress = {};                  ///< of the pass "ridges"
  /// For a field with a source: bytes that the process may take, and those that are taken, as in SimplifyOptions.
  /// Ridges that do not fit are refused with kUsage, before memory runs out. DEFAULT: no limit.
  std::uint64_t memory_limit = 0, memory_taken = 0;
};

struct Ridges {
  /// Soft lines for SimplifyOptions::breaklines, vertices on samples. Their kind is kRidge or kKeptRidge.
  std::vector<Line> ridges, valleys;
  std::uint64_t vertices = 0;  ///< of the lines; where several meet, once for each
};

/// Finds the ridges and valleys of a raster, in an order that depends on nothing but it. Each line runs within a sample
/// of the highest or lowest samples that it stands for, with as few vertices as that and the bound allow; where one
/// joins another both have a vertex. Lines of fewer than 8 samples are left out. With all samples negated ridges and
/// valleys are exchanged, and nothing else changes. Voids end profiles: what is seen of them counts.
///
/// Fails with kUsage for options out of range, with kCancelled, and as the field's source does, which is read four
/// times from the top down: the lines are those of the same samples in memory. REQUIRES: the affine map can be
/// inverted. Memory: 6 bytes a sample, and some 50 for each sample near one that lies high, or low; of a source, those
/// 50 alone. Cost: O(samples) and O(n log n) for the n samples near lines; some 0.1 to 0.3 s a million samples of land,
/// up to 1 s of noise.
Result<Ridges> detect_ridges(const HeightField& field, const RidgeOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
