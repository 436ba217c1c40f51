// What a run of `scarp simplify` on a raster came to.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scarp/features.h"
#include "scarp/glb.h"
#include "scarp/height_field.h"
#include "scarp/judge.h"
#include "session/inputs/channels.h"
#include "session/inputs/companions.h"
#include "session/inputs/cutline.h"
#include "session/inputs/zones.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// A level of detail beside the finest.
struct Level {
  std::optional<double> asked;
  Simplified simplified;
};

/// Everything that the files, the report and the summary tell.
struct Outcome : SimplifyRun {
  OwnedHeightField field;
  RasterInfo as_read;  ///< before nodata was filled
  Channels channels;
  Companions companions;
  Features features;
  Cut cut;
  ZonePlan zone_plan;
  MeshZones zones;  ///< found in the mesh
  Picture drape;    ///< empty where no image is draped
  std::uint64_t filled = 0;
  std::vector<Level> coarser;
  std::optional<LargestError> bounded;  ///< where samples are ignored: of the others; images: norms
  std::optional<double> bounded_goal;   ///< where a script ignores them: of what the goal bounds
  std::optional<double> psnr;           ///< of the rendering, in dB; +infinity if it is the image

  /// The field with its channels.
  HeightField view() const {
    HeightField view = field.view();
    channels.attach_to(view);
    return view;
  }
};

/// What the goal bounds, and how large it came out; where a script ignores samples, of the others.
struct GoalError {
  double value = 0;         ///< compared with the bound, without the rounding of samples
  const char* name = "";    ///< "max error", "weighted max error", …
  bool is_rounded = false;  ///< to float32, by which it may exceed the bound
};
GoalError find_goal_error(const Outcome& outcome);

}  // namespace scarp::cli
