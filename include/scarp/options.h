// Set what the mesh must keep, and how much work may make it small: the options of simplify().
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     scarp::SimplifyOptions options;
//     options.goals.max_error = 20;                   // in the unit of the heights
//     options.quality.effort = scarp::Effort::kHigh;  // a third of the triangles, in some ten times the time
//     options.domain.outline_tolerance = 1;           // samples
//     options.output.normals = true;
//     for (const std::string& conflict : scarp::list_conflicts(dem, options)) std::printf("%s\n", conflict.c_str());
#pragma once

#include <string>
#include <vector>

#include "scarp/border.h"
#include "scarp/features.h"
#include "scarp/goals.h"
#include "scarp/height_field.h"
#include "scarp/quality.h"
#include "scarp/run.h"
#include "scarp/tolerances.h"

#pragma GCC visibility push(default)

namespace scarp {

/// The part of the raster that the mesh covers.
struct Domain {
  /// How far, in samples, the outline of the valid data may be simplified, at least 0. It only moves outwards, over
  /// nodata: no valid sample is cut off. Voids that hold no sample close where they are nowhere farther from their
  /// outline. DEFAULT: 0, the exact outline.
  double outline_tolerance = 0;
  /// The edge of the raster. DEFAULT: simplified with the surface.
  Border border = {};
};

/// The contents of the mesh.
struct Output {
  /// Round positions to float32, as GLB and STL hold them, so that what is proven is what is written. False: positions
  /// are double, as OBJ and PLY hold them, and vertices lie on their samples in every affine frame. DEFAULT: true.
  bool float32_positions = true;
  /// Positions that encode_glb() compresses without moving them, where rows run along x (elsewhere this changes
  /// nothing): x and y are double, whatever float32_positions is, and heights are rounded to multiples of a power of
  /// two, at most 1/128 of max_error and of a locked border's. The engine aims 1/256 below max_error for it, unless the
  /// samples are such multiples. Heights stay as they are without a max_error, or where tolerances, weights or channels
  /// bound errors. DEFAULT: false.
  bool lattice = false;
  bool normals = false;  ///< fill Mesh::normals from the full-resolution samples. DEFAULT: false.
  bool uvs = false;      ///< fill Mesh::uvs. DEFAULT: false.
};

/// The goals, and how to reach them. list_conflicts() names settings that do not go together.
struct SimplifyOptions {
  Goals goals = {};
  Tolerances tolerances = {};
  Features features = {};
  Quality quality = {};
  Domain domain = {};
  Output output = {};
  Run run = {};
};

/// The conflicts among the settings of a call of simplify(), each a sentence: "X cannot be combined with Y: reason". It
/// fails with kUsage and the first of them. Empty: none. docs/conflicts.md has the table.
std::vector<std::string> list_conflicts(const HeightField& field, const SimplifyOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
