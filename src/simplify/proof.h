// The mesh as it will be written, judged against everything that was promised.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metric/criterion.h"
#include "pieces/recipe.h"
#include "scarp/measure.h"
#include "scarp/simplify.h"

namespace scarp {

struct Proof {
  bool kept = true;
  std::string broken;               ///< the promise that is not kept, as the beginning of a sentence
  std::vector<Offender> offenders;  ///< samples whose insertion may mend it
};

/// The extent of a proof: heights alone, or the topology too.
enum class Look { kHeights, kAll };

/// Fills the measurements of `result` from its mesh; searches for breaches where the error goal ended the run. `exact`:
/// vertices lie exactly on their samples, so that a breach within the judge's own rounding is none, and the topology,
/// which holds by construction, is omitted whatever `look` is. Fails as measure() does.
Result<Proof> prove(const Recipe& recipe, const Criterion& criterion, bool exact, Look look, Simplified& result);

/// Memory of prove() whatever the mesh.
std::uint64_t proof_bytes(const Recipe& recipe);

}  // namespace scarp
