// Judges the mesh, as it will be written, against all of its bounds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metric/criterion.h"
#include "pieces/recipe.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp::run {

struct Proof {
  bool kept = true;
  std::string broken;               ///< the broken promise, as the beginning of a sentence
  std::vector<Offender> offenders;  ///< samples whose insertion may mend the fault
};

/// The extent of a proof: only heights, or also the topology.
enum class Look { kHeights, kAll };

/// Fills the measurements of `result` from its mesh, and searches for breaches if the error goal ended the run.
/// `exact`: vertices are exactly on their samples. Then a breach within the judge's own rounding does not count, and
/// the topology, which is valid by construction, is omitted for any `look`. Fails like measure().
Result<Proof> prove(const pieces::Recipe& recipe, const metric::Criterion& criterion, bool exact, Look look,
                    Simplified& result);

/// Memory of prove(), the same for all meshes.
std::uint64_t proof_bytes(const pieces::Recipe& recipe);

}  // namespace scarp::run
