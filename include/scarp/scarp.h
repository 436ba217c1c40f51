// Includes all public headers: for programs that read, simplify, measure and write. docs/guide/library.md describes the
// headers and the promise of stability.
//
// Example:
//     SCARP_TRY(const auto& dem, scarp::read_height_field("dem.tif"));
//     SCARP_TRY(const auto& made, scarp::simplify(dem, {.max_error = 20}));
//     SCARP_TRY(const auto& measured, scarp::measure(dem, made.mesh));
//     std::printf("max error %g, sound: %d\n", measured.max_error, measured.is_sound());
//     SCARP_RETURN_IF_ERROR(scarp::write_mesh(made.mesh, "hills.obj"));
#pragma once

#include "scarp/features.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/lines.h"
#include "scarp/live.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/options.h"
#include "scarp/paper.h"
#include "scarp/picture.h"
#include "scarp/point_blocks.h"
#include "scarp/points.h"
#include "scarp/print.h"
#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp/simplify.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "scarp/tile_set.h"
#include "scarp/tolerances.h"
#include "scarp/version.h"
