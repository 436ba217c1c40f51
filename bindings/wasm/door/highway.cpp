// Highway's list of what the processor can do is compiled for one machine; WebAssembly has one target, known when it is
// compiled.
#include <hwy/targets.h>

namespace hwy {
std::int64_t SupportedTargets() { return HWY_STATIC_TARGET; }
}  // namespace hwy
