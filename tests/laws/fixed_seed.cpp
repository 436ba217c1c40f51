// Laws choose the same random cases in every run, so that one that fails does so again for whoever repeats it. A set
// RC_PARAMS has its way instead, all of it: "seed=7 max_success=1000"; without a seed RapidCheck takes a fresh one.
// Sanitized builds try a quarter of the cases, of all sizes.
#include <stdlib.h>

#include "laws/sanitized.h"

namespace scarp::testing {
namespace {

[[maybe_unused]] const int is_set =
    setenv("RC_PARAMS", kIsSanitized ? "seed=20260721 max_success=25" : "seed=20260721", /*overwrite=*/0);

}  // namespace
}  // namespace scarp::testing
