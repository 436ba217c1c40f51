// The packed grid of EGM96: data/egm96.bin, which the build makes a source of.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scarp {

extern const std::uint64_t kPackedEgm96[];
extern const std::size_t kPackedEgm96Words;

}  // namespace scarp
