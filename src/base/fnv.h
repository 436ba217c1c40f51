// FNV-1a in 64 bits: a hash of bytes that is the same on every machine. Collisions are possible.
#pragma once

#include <cstdint>

namespace scarp {

class Fnv {
 public:
  /// Adds bytes, or numbers of up to 32 bits.
  template <class Values>
  void add(const Values& values) {
    for (const auto value : values) hash_ = (hash_ ^ value) * 0x100000001b3;
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace scarp
