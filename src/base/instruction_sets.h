// The choice between several compilations of the same vector code. There is a table of functions for each instruction
// set. The best table that the machine supports is chosen, or the one that the environment variable SCARP_KERNEL names
// (in upper or lower case; unknown names are ignored). WebAssembly has one instruction set and no environment
// variables. Its build omits the scalar twin, with which tests compare the vector code.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

namespace scarp {

inline bool is_same_kernel_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

/// REQUIRES: `available` is not empty, and its best table is first. Each table has a `name`.
template <class Kernels>
const Kernels& choose_kernels(std::span<const Kernels> available) {
#ifdef __EMSCRIPTEN__
  return available.front();
#endif
  if (const char* wanted = std::getenv("SCARP_KERNEL")) {
    for (const Kernels& kernels : available) {
      if (is_same_kernel_name(kernels.name, wanted)) return kernels;
    }
  }
  return available.front();
}

/// `vectors`, best first, then the scalar twin.
template <auto twin, class Kernels>
std::vector<Kernels> list_kernels(std::span<const Kernels> vectors) {
  std::vector<Kernels> kernels(vectors.begin(), vectors.end());
#ifndef __EMSCRIPTEN__
  kernels.push_back(twin());
#endif
  return kernels;
}

}  // namespace scarp
