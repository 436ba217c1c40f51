// What `scarp simplify` was asked to do: its options, parsed and checked before any file is read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "scarp/simplify.h"

namespace scarp::cli {

enum class NodataPolicy { kHole, kFill, kBackground };

/// The options as they were given.
struct SimplifyArguments {
  RasterArguments raster;
  std::string output;
  Given max_error, max_triangles, max_points;
  Given nodata_policy, fill_distance, background, outline_tolerance;
  Given format, base, preview, report, threads;
  bool normals = false, overwrite = false, quiet = false, json_progress = false;
};

struct SimplifyPlan {
  std::string input, output;
  MeshFormat format = MeshFormat::kGlb;
  ReadOptions read;
  std::optional<ErrorGoal> error_goal;
  SimplifyOptions simplify;  ///< without max_error, which may depend on the relief
  NodataPolicy policy = NodataPolicy::kHole;
  double fill_distance = 100;
  float background = 0;
  std::optional<double> base;
  std::optional<std::string> preview, report;
  bool overwrite = false;
  std::vector<std::string> warnings;
  /// The command for the mesh's metadata: options in a fixed order and with their long names, folders left out, and
  /// without what cannot change the mesh (threads, quietness, other outputs, the output's name).
  std::string canonical_command;
};

Result<SimplifyPlan> plan_simplify(const SimplifyArguments& given);

/// "glb", "obj", "ply" or "stl".
const char* format_name(MeshFormat format);

}  // namespace scarp::cli
