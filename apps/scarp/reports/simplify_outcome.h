// The result of a run of `scarp simplify` on a raster.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "commands/simplify_run.h"
#include "inputs/channels.h"
#include "inputs/companions.h"
#include "options/cutline_options.h"
#include "options/memory.h"
#include "scarp/features.h"
#include "scarp/glb.h"
#include "scarp/height_field.h"
#include "scarp/judge.h"

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

/// The limit of the process, and the bytes that it uses in addition to the mesh; of no limit: zeros.
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
