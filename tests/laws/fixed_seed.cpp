// Laws choose the same random cases in every run, so that one that fails does so again for whoever repeats it. A set
// RC_PARAMS has its way instead, all of it: "seed=7 max_success=1000"; without a seed RapidCheck takes a fresh one.
// Sanitizers look for faults of memory and arithmetic on the way, not for rare cases: a quarter of the cases each, of
// all sizes, does.
#include <stdlib.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCARP_LAW_PARAMS "seed=20260721 max_success=25"
#else
#define SCARP_LAW_PARAMS "seed=20260721"
#endif

namespace scarp {
namespace {

[[maybe_unused]] const int is_set = setenv("RC_PARAMS", SCARP_LAW_PARAMS, /*overwrite=*/0);

}  // namespace
}  // namespace scarp
