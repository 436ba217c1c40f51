// Replaces JavaScript, which prints numbers in the npm package's messages.
#include <cstdint>
#include <cstdio>

extern "C" std::int32_t scarp_number(double value, std::int32_t, std::int32_t, std::int32_t, char* out) {
  return std::snprintf(out, 400, "%.9g", value);
}
