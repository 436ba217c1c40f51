// The packed EGM96 grid: data/egm96.bin, which the build converts to a source file.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scarp::globe {

extern const std::uint64_t kPackedEgm96[];
extern const std::size_t kPackedEgm96Words;

}  // namespace scarp::globe
