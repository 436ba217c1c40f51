// Judging a mesh at scattered points.
#pragma once

#include "grid/snapped_points.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"
#include "scarp/result.h"

namespace scarp::judge {

/// The part of measure_points() that follows after duplicates have been resolved.
Result<Measurement> judge_points(const PointSet& points, const grid::SnappedPoints& snapped, const Mesh& mesh,
                                 const MeasureOptions& options);

}  // namespace scarp::judge
