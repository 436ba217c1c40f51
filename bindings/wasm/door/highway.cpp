// Highway's detection of processor features is compiled for a single machine: WebAssembly has one target, known at
// compile time.
#include <hwy/targets.h>

namespace hwy {
std::int64_t SupportedTargets() { return HWY_STATIC_TARGET; }
}  // namespace hwy
