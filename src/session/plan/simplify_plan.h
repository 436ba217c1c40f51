// The request of `scarp simplify`: its options, parsed and checked before any file is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/simplify.h"
#include "session/options/channel_options.h"
#include "session/options/error_goal.h"
#include "session/options/given_options.h"
#include "session/options/image_options.h"
#include "session/options/level_options.h"
#include "session/options/line_options.h"
#include "session/options/output_kind.h"
#include "session/options/region_options.h"
#include "session/options/solid_options.h"
#include "session/plan/outputs.h"

namespace scarp::cli {

enum class NodataPolicy { kHole, kFill, kBackground };

struct SimplifyPlan {
  GivenOptions given{kSimplify};
  std::string input, output;
  std::vector<PlannedOutput> outputs;
  OutputFormat format;
  ReadOptions read;
  std::optional<ErrorGoal> error_goal;
  SimplifyOptions simplify;  ///< without max_error, which may depend on the relief, and without contents of files
  Strategy strategy;
  bool by_paper = false;        ///< runs simplify_by_paper() with the strategy
  std::string strategy_option;  ///< the option that selects it
  ChannelPlan channels;
  ImagePlan images;
  NodataPolicy policy = NodataPolicy::kHole;
  double fill_distance = 0;
  float background = 0;
  std::optional<double> base;
  std::optional<PrintOptions> solid;
  std::optional<Levels> levels;
  bool levels_in_one = false;
  std::optional<std::string> preview, render, error_raster, html, report;
  std::string page_template;  ///< template of the page, if `html` requests one
  bool compress = false;
  bool overwrite = false;
  bool is_y_up = false;                      ///< see choose_y_up()
  bool doubles = false;                      ///< a PLY has double positions
  std::optional<std::uint64_t> memory;       ///< bytes that the process may use
  std::optional<std::string> needs_samples;  ///< an option that needs all samples in memory
  std::vector<std::string> warnings;
  std::string canonical_command;  ///< see GivenOptions::canonical()

  /// True if each level has its own file; else OUTPUT holds all.
  bool has_file_per_level() const { return levels && !levels_in_one; }
  bool has_file_per_tile() const { return solid && solid->is_split() && format.mesh != MeshFormat::k3mf; }
};

/// `files_read`: files that no output may replace.
Result<SimplifyPlan> plan_simplify(const GivenOptions& given, const std::vector<std::string>& files_read);

}  // namespace scarp::cli
