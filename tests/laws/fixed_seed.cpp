// Laws choose the same random cases in every run, so that one that fails does so again for whoever repeats it. A set
// RC_PARAMS has its way instead, all of it: "seed=7 max_success=1000"; without a seed RapidCheck takes a fresh one.
// SCARP_LAW_CASES: so many cases of each law instead of 100, of all sizes up to a third (`make check`). Sanitized
// builds try a quarter of the cases, of all sizes.
#include <stdlib.h>

#include <string>

#include "laws/sanitized.h"

namespace scarp::testing {
namespace {

std::string params() {
  const std::string seed = "seed=20260721";
  if (const char* cases = getenv("SCARP_LAW_CASES")) return seed + " max_size=35 max_success=" + cases;
  return kIsSanitized ? seed + " max_success=25" : seed;
}

[[maybe_unused]] const int is_set = setenv("RC_PARAMS", params().c_str(), /*overwrite=*/0);

}  // namespace
}  // namespace scarp::testing
