#include "io/gdal/memory_file.h"

#include <fmt/format.h>

#include <atomic>

namespace scarp::gdal {

MemoryFile::MemoryFile(const char* extension) {
  static std::atomic<unsigned> serial{0};
  name_ = fmt::format("/vsimem/scarp-{}.{}", serial++, extension);
}

std::vector<std::uint8_t> MemoryFile::bytes() const {
  vsi_l_offset size = 0;
  const GByte* data = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
  return data != nullptr ? std::vector<std::uint8_t>(data, data + size) : std::vector<std::uint8_t>();
}

}  // namespace scarp::gdal
