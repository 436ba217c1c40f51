// The result of a run of `scarp simplify` on a raster.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "measure/judge.h"
#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "session/inputs/channels.h"
#include "session/inputs/companions.h"
#include "session/inputs/cutline.h"
#include "session/inputs/zones.h"
#include "session/reports/simplify_run.h"

namespace scarp::cli {

/// A level of detail other than the finest.
struct Level {
  std::optional<double> asked;
  Simplified simplified;
};

/// Everything that the files, the report and the summary contain.
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
  std::optional<LargestError> bounded;  ///< largest error of samples that are not ignored; images: norms
  std::optional<double> bounded_goal;   ///< with ignored samples: largest error that the goal bounds
  std::optional<double> psnr;           ///< PSNR of the rendering, in dB; +infinity if it is the image

  /// The field with its channels.
  HeightField view() const {
    HeightField view = field.view();
    channels.attach_to(view);
    return view;
  }
};

/// The error that the goal bounds, as reached; where a script ignores samples, that of the others.
struct GoalError {
  double value = 0;         ///< compared with the bound, without the rounding of samples
  const char* name = "";    ///< "max error", "weighted max error", …
  bool is_rounded = false;  ///< to float32, by which it may exceed the bound
};
GoalError find_goal_error(const Outcome& outcome);

}  // namespace scarp::cli
