// ZIP archives in memory: what 3MF is made of.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/result.h"

namespace scarp {

struct ZipEntry {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// The entries in their order, deflated, without times: equal entries make equal archives, with one version of zlib.
/// Fails with kOutput beyond 4 GB.
Result<std::vector<std::uint8_t>> encode_zip(std::span<const ZipEntry> entries);

/// The names in an archive and their contents, taken out one by one. Borrows the bytes.
class ZipReader {
 public:
  /// Fails with kInput for what is no archive, or one of several volumes.
  static Result<ZipReader> open(std::span<const std::uint8_t> bytes);
  /// The name that equals `name` but for the case of ASCII letters; empty if there is none.
  std::string find(std::string_view name) const;
  /// Fails with kInput for a name that is not there, an entry that is encrypted, packed otherwise than by deflate,
  /// damaged, or far larger than what it is packed in can hold.
  Result<std::vector<std::uint8_t>> extract(std::string_view name) const;

 private:
  struct Entry {
    std::string_view name;
    std::uint64_t offset = 0, packed = 0, size = 0;
    std::uint32_t checksum = 0;
    std::uint16_t method = 0, flags = 0;
  };
  explicit ZipReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  Result<void> read_directory(std::uint64_t at, std::uint64_t count);

  std::span<const std::uint8_t> bytes_;
  std::vector<Entry> entries_;
};

}  // namespace scarp
