// A hook that the library calls after allocations, for a program that requests huge pages.
#pragma once

#include <cstddef>

#pragma GCC visibility push(default)

namespace scarp {

/// Called with each block that an Array gets from malloc(). DEFAULT: null, no calls. A program must set it before it
/// creates any array.
inline void (*after_allocation)(void* block, std::size_t size) = nullptr;

}  // namespace scarp

#pragma GCC visibility pop
