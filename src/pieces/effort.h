// Checks and choices of efforts, and the options of fitting that follow from them.
#pragma once

#include <cstdint>
#include <optional>

#include "fit/fit.h"
#include "metric/criterion.h"
#include "scarp/options.h"
#include "scarp/result.h"

namespace scarp {

bool has_budget(const SimplifyOptions& options);
bool has_lines(const SimplifyOptions& options);
bool inserts_first(const SimplifyOptions& options);  ///< walls, ridges or valleys

/// True if vertices will be free.
bool vertices_are_free(const HeightField& field, const SimplifyOptions& options);

/// True if removal comes after refinement for shapes, which it keeps: the result has far fewer triangles.
bool removes_last(const HeightField& field, const SimplifyOptions& options);

/// True if x and y are rounded to float32.
bool rounds_offsets(const HeightField& field, const SimplifyOptions& options);
/// The power of two whose multiples heights become; 0: they stay as they are.
double height_step(const HeightField& field, const SimplifyOptions& options);

/// True if the mesh holds all lattice points exactly, at so many steps between two samples.
bool lattice_is_exact(const HeightField& field, const SimplifyOptions& options, std::int32_t steps);

/// The lattice steps from one sample to the next that vertices may use.
std::int32_t choose_lattice_steps(const HeightField& field, const SimplifyOptions& options);

/// The share of every bound at which the engine aims. It reserves a little for the rounding of heights, and with
/// vertices between samples for that of positions, because no sample can be inserted among them to repair the damage.
double aim_of(const HeightField& field, const SimplifyOptions& options);

/// True if errors are norms over heights and channels.
bool has_norm(const HeightField& field);

/// The norm that fitting keeps; nothing if unweighted heights alone decide. The criterion stays alive.
std::optional<FitNorm> fit_norm(const SimplifyOptions& options, const Raster& raster, const Criterion& criterion);

/// All but the norm, per-sample tolerances, threads and progress. `threshold`: the bound that the given mesh satisfies.
FitOptions fit_options(const HeightField& field, const SimplifyOptions& options, double threshold);

}  // namespace scarp
