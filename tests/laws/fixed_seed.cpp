// Laws use the same random cases in every run, so that failures are reproducible. RC_PARAMS, if set, overrides all of
// this: "seed=7 max_success=1000"; without a seed RapidCheck uses a fresh one. SCARP_LAW_CASES: the number of cases of
// each law (100; in sanitized builds 8). SCARP_LAW_SIZE: RapidCheck's largest size of a case (100).
#include <stdlib.h>

#include <string>

#include "laws/sanitized.h"

namespace scarp::testing {
namespace {

std::string params() {
  std::string params = "seed=20260721";
  if (const char* size = getenv("SCARP_LAW_SIZE")) params += std::string(" max_size=") + size;
  if (const char* cases = getenv("SCARP_LAW_CASES")) return params + " max_success=" + cases;
  return kIsSanitized ? params + " max_success=8" : params;
}

[[maybe_unused]] const int is_set = setenv("RC_PARAMS", params().c_str(), /*overwrite=*/0);

}  // namespace
}  // namespace scarp::testing
