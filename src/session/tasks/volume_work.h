// scarp measure --volume without its terminal: reads two surfaces and measures the volumes between them.
#pragma once

#include "scarp/result.h"
#include "session/options/given_options.h"
#include "session/reports/volume_report.h"
#include "session/tasks/runner.h"

namespace scarp::cli {

/// Reads the surfaces, brings them into one frame, and measures. kInput for surfaces without common area.
Result<void> compare_surfaces(const GivenOptions& given, const Runner& runner, ComparedSurfaces& compared);

}  // namespace scarp::cli
