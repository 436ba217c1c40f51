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

/// The data of all files, the report and the summary.
struct Outcome : SimplifyRun {
  OwnedHeightField field;
  RasterInfo as_read;  ///< before nodata was filled
  Channels channels;
  Companions companions;
  Features features;
  Cut cut;
  ZonePlan zone_plan;
  MeshZones zones;  ///< zones found in the mesh
  Picture drape;    ///< empty without a draped image
  std::uint64_t filled = 0;
  std::optional<judge::LargestError> bounded;  ///< largest error of samples that are not ignored; images: norms
  std::optional<double> bounded_goal;          ///< largest error that the goal bounds, if samples are ignored
  std::optional<double> psnr;                  ///< PSNR of the rendering in dB; +infinity if it equals the image

  /// The field with its channels.
  HeightField view() const {
    HeightField view = field.view();
    channels.attach_to(view);
    return view;
  }
};

/// The reached error that the goal bounds, without samples that a script ignores.
struct GoalError {
  double value = 0;         ///< without the rounding of samples, for comparison with the bound
  const char* name = "";    ///< "max error", "weighted max error", …
  bool is_rounded = false;  ///< positions are rounded to float32, and the error may exceed the bound by the rounding
};
GoalError find_goal_error(const Outcome& outcome);

}  // namespace scarp::cli
