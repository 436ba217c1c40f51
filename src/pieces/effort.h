// What an effort is possible for, and what it asks of fitting.
#pragma once

#include <cstdint>
#include <optional>

#include "fit/fit.h"
#include "metric/criterion.h"
#include "scarp/result.h"
#include "scarp/simplify.h"

namespace scarp {

bool has_budget(const SimplifyOptions& options);
bool has_lines(const SimplifyOptions& options);
bool lays_first(const SimplifyOptions& options);  ///< faults, ridges or valleys

/// Whether vertices will be let free.
bool vertices_are_free(const HeightField& field, const SimplifyOptions& options);

/// Whether removal comes after refinement for shapes, which it keeps: that leaves far fewer triangles.
bool removes_last(const HeightField& field, const SimplifyOptions& options);

/// Whether places so many steps from sample to sample are held exactly by the mesh.
bool places_are_exact(const HeightField& field, const SimplifyOptions& options, std::int32_t steps);

/// How many places vertices may take between two samples, and one of these.
std::int32_t place_steps(const HeightField& field, const SimplifyOptions& options);

/// The share of every bound that is asked of the engine. Vertices between samples leave a little to the rounding of
/// positions: no sample can be inserted among them to mend what that breaks.
double aim_of(const HeightField& field, const SimplifyOptions& options);

/// Whether errors are norms over heights and channels.
bool has_norm(const HeightField& field);

/// The norm that fitting keeps; nothing where heights alone, as they are, decide. The criterion stays alive.
std::optional<FitNorm> fit_norm(const SimplifyOptions& options, const Raster& raster, const Criterion& criterion);

/// But for the norm, bounds of samples, threads and progress. `threshold`: what the mesh that is fitted keeps.
FitOptions fit_options(const HeightField& field, const SimplifyOptions& options, double threshold);

}  // namespace scarp
