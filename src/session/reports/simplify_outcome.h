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
#include "session/inputs/memory.h"
#include "session/options/cutline_options.h"
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

/// What the process may take, and has taken beside the mesh; of no limit: zeros.
MemoryShare memory_of(const SimplifyPlan& plan, const Outcome& outcome);

/// Compression, and the images that a GLB file holds.
Result<GlbOptions> glb_options(const SimplifyPlan& plan, const Outcome& outcome);
/// Closes the mesh into a solid where that was asked for, and writes into it who made it and where it lies.
Result<void> complete_mesh(const SimplifyPlan& plan, Outcome& outcome);

/// Every file but the report, OUTPUT first. Closes the mesh into a solid where that was asked for. The field's samples
/// are given back before OUTPUT is encoded, unless it is made from them.
Result<std::vector<ReadyFile>> encode_files(const SimplifyPlan& plan, const ProgressCallback& progress,
                                            Outcome& outcome);

}  // namespace scarp::cli
