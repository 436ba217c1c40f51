// ZIP archives: 3MF in memory, and tiles in files of any size.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/result.h"

namespace scarp::io {

struct ZipEntry {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// Deflates the entries in order, without times. With one version of zlib, equal entries give equal archives. Fails
/// with kOutput beyond 4 GB.
Result<std::vector<std::uint8_t>> encode_zip(std::span<const ZipEntry> entries);

inline constexpr std::uint16_t kZipStored = 0, kZipDeflated = 8;

struct ZipRecord {
  std::string_view name;
  std::uint64_t offset = 0, packed = 0, size = 0;  ///< offset of the entry's header; compressed and original size in
                                                   ///< bytes
  std::uint32_t checksum = 0;
  std::uint16_t method = kZipStored, flags = 0;
};

std::uint32_t zip_checksum(std::span<const std::uint8_t> bytes);

/// Appends the header that precedes an entry's bytes. REQUIRES: packed and size below 2^32 - 1.
void append_zip_header(std::vector<std::uint8_t>& bytes, const ZipRecord& record);
/// Appends a record of the directory, which follows all entries. Offsets have 64 bits if necessary.
void append_zip_record(std::vector<std::uint8_t>& bytes, const ZipRecord& record);
/// Appends the end that follows a directory of `count` records, which starts at `start` and has `size` bytes.
void append_zip_end(std::vector<std::uint8_t>& bytes, std::uint64_t count, std::uint64_t start, std::uint64_t size);

struct ZipDirectory {
  std::uint64_t count = 0, start = 0;
};
/// Largest size of the end of an archive, after its directory, with 64-bit numbers and a comment.
inline constexpr std::uint64_t kLongestZipEnd = 22 + 65535 + 20 + 56;
/// `tail`: the last kLongestZipEnd bytes of an archive of `size` bytes, or all. Fails with kInput if it is no archive.
Result<ZipDirectory> find_zip_directory(std::span<const std::uint8_t> tail, std::uint64_t size);
/// `bytes`: from the directory's start on; the records' names point into them. Fails with kInput.
Result<std::vector<ZipRecord>> read_zip_directory(std::span<const std::uint8_t> bytes, std::uint64_t count);

inline constexpr std::size_t kZipHeaderSize = 30;
/// Distance from an entry's header to its contents; 0 if invalid. `header`: its first kZipHeaderSize bytes.
std::uint64_t zip_header_length(std::span<const std::uint8_t> header);
/// `packed`: as many bytes as the record declares. Fails with kInput for an entry that is encrypted, neither deflated
/// nor stored, damaged, or impossibly large for its compressed size.
Result<std::vector<std::uint8_t>> unpack_zip_entry(const ZipRecord& record, std::span<const std::uint8_t> packed);

/// Reads entries of an archive individually, by name. Borrows the bytes.
class ZipReader {
 public:
  /// Fails with kInput if it is no archive, or has several volumes.
  static Result<ZipReader> open(std::span<const std::uint8_t> bytes);
  /// The entry name that equals `name` if the case of ASCII letters is ignored; empty if none.
  std::string find(std::string_view name) const;
  /// Fails with kInput for a missing name, and as unpack_zip_entry() does.
  Result<std::vector<std::uint8_t>> extract(std::string_view name) const;

 private:
  ZipReader(std::span<const std::uint8_t> bytes, std::vector<ZipRecord> records)
      : bytes_(bytes), records_(std::move(records)) {}

  std::span<const std::uint8_t> bytes_;
  std::vector<ZipRecord> records_;
};

}  // namespace scarp::io
