// Files that GDAL writes to memory.
#pragma once

#include <cpl_vsi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace scarp::gdal {

/// A file in memory, with a name that no other has, gone with it.
class MemoryFile {
 public:
  /// `extension`: "tif", …
  explicit MemoryFile(const char* extension);
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const char* name() const { return name_.c_str(); }
  /// A copy of what was written; empty if nothing was.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::string name_;
};

}  // namespace scarp::gdal
