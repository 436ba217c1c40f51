// A sanitized build is many times slower. It searches for memory and arithmetic faults, not for rare cases, so fewer
// cases and samples suffice.
#pragma once

#if defined(__has_feature)
#define SCARP_HAS_SANITIZER (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCARP_HAS_SANITIZER 1
#else
#define SCARP_HAS_SANITIZER 0
#endif

namespace scarp::testing {

#if SCARP_HAS_SANITIZER
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

/// A number of rows, columns or cases, divided by `share` in sanitized builds.
constexpr int fewer(int count, int share = 2) { return kIsSanitized ? count / share : count; }

}  // namespace scarp::testing
