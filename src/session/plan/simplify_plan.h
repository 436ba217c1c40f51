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
  SimplifyOptions simplify;  ///< without max_error, which may depend on the relief, and what files hold
  Strategy strategy;
  bool by_paper = false;        ///< by simplify_by_paper(), with the strategy
  std::string strategy_option;  ///< option that asks for it
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
  std::string page_template;  ///< template of the page, where `html` asks for one
  bool compress = false;
  bool overwrite = false;
  bool is_y_up = false;                      ///< see choose_y_up()
  bool doubles = false;                      ///< doubles as positions of a PLY
  std::optional<std::uint64_t> memory;       ///< bytes that the process may use
  std::optional<std::string> needs_samples;  ///< an option that needs all samples in memory
  std::vector<std::string> warnings;
  std::string canonical_command;  ///< see GivenOptions::canonical()

  /// True if each level has a file of its own; else OUTPUT holds them all.
  bool has_file_per_level() const { return levels && !levels_in_one; }
  bool has_file_per_tile() const { return solid && solid->is_split() && format.mesh != MeshFormat::k3mf; }
};

/// `files_read`: those that no output may replace.
Result<SimplifyPlan> plan_simplify(const GivenOptions& given, const std::vector<std::string>& files_read);

}  // namespace scarp::cli
