// The results of `scarp measure`, and their report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/judge.h"
#include "scarp/height_field.h"
#include "scarp/mesh.h"
#include "session/inputs/channels.h"
#include "session/inputs/companions.h"
#include "session/inputs/cutline.h"
#include "session/options/channel_options.h"
#include "session/options/error_goal.h"
#include "session/options/given_options.h"
#include "session/text/json.h"

namespace scarp::cli {

struct Judged {
  OwnedHeightField field;
  ChannelPlan plan;
  Channels channels;
  Companions companions;
  Cut cut;
  Mesh mesh;
  judge::Judgement judgement;
  std::optional<ErrorGoal> goal;      ///< goal of --fail-above
  std::optional<double> fail_above;   ///< in z units
  std::optional<std::string> broken;  ///< reason why the mesh fails; nothing if it passes or without a bound
  int band = 1;
  bool is_y_up = false;  ///< --up requests it
  std::vector<std::string> warnings;
  double seconds_read = 0, seconds_measure = 0, seconds_total = 0;

  /// The field with its channels.
  HeightField view() const {
    HeightField view = field.view();
    channels.attach_to(view);
    return view;
  }
  /// The largest error of samples with a bound: that of heights, or the norm for an image.
  judge::LargestError bounded() const { return plan.image ? judgement.combined->bounded : judgement.bounded; }
  bool has_verdict() const { return fail_above || companions.has_tolerance(); }
};

/// Checks the bounds and sets `broken`.
void decide(Judged& judged);

/// The JSON of --json.
Json make_report(const Judged& judged, const std::string& mesh_path, const GivenOptions& cutline,
                 const std::string& command_line);
/// The table on standard output.
std::string make_table(const Judged& judged, const std::string& raster_path, const std::string& mesh_path);

}  // namespace scarp::cli
