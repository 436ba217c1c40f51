// Files that GDAL writes to memory.
#pragma once

#include <cpl_vsi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace scarp::gdal {

/// A file in memory under a unique name, deleted with this object.
class MemoryFile {
 public:
  /// `extension`: "tif", …
  explicit MemoryFile(const char* extension);
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const char* name() const { return name_.c_str(); }
  /// A copy of its contents; empty if nothing was written.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::string name_;
};

}  // namespace scarp::gdal
