// Whether this is a sanitized build, many times slower: such a build looks for faults of memory and
// arithmetic on the way, not for rare cases, and does with fewer cases and samples than Release.
#pragma once

namespace scarp::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace scarp::testing
