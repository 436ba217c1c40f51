// ZIP as used for document archives (PKWARE's APPNOTE 6.3). The writer knows all sizes beforehand. The reader uses the
// sizes in the directory at the end, since streaming writers omit those in front of entries. It always accepts 64-bit
// sizes, since some programs write them for any size. The writer uses 64-bit sizes only if an archive is too large or
// has too many entries.

#include "io/zip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

#include "io/mesh/file_bytes.h"
#include "io/mesh/mesh_file_text.h"

namespace scarp::io {
namespace {

constexpr std::uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEndRecord = 0x06054b50, kEnd64 = 0x06064b50,
                        kLocator64 = 0x07064b50;
constexpr std::size_t kCentralSize = 46, kEndSize = 22, kEnd64Size = 56, kLocatorSize = 20;
constexpr std::uint16_t kVersion = 20, kVersion64 = 45, kFirstDate = 0x21;  // 1980-01-01
constexpr std::uint32_t kIn64 = 0xffffffff;
constexpr std::uint16_t kCountIn64 = 0xffff, kField64 = 1;

template <class T>
void append_number(std::vector<std::uint8_t>& bytes, T value) {
  bytes.resize(bytes.size() + sizeof(T));
  std::uint8_t* at = bytes.data() + bytes.size() - sizeof(T);
  store_number(at, value);
}

void append_text(std::vector<std::uint8_t>& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// zlib counts in 32 bits.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;

/// Deflates without a header.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
  z_stream stream = {};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  struct Closer {
    z_stream& stream;
    ~Closer() { deflateEnd(&stream); }
  } const closer{stream};
  std::vector<std::uint8_t> packed(bytes.size() / 4 + 1024);
  std::size_t taken = 0, made = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    const std::size_t in = std::min(bytes.size() - taken, kMostAtOnce);
    if (packed.size() - made < 1024) packed.resize(2 * packed.size());
    const std::size_t out = std::min(packed.size() - made, kMostAtOnce);
    stream.next_in = const_cast<Bytef*>(bytes.data() + taken);
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = packed.data() + made;
    stream.avail_out = static_cast<uInt>(out);
    state = deflate(&stream, taken + in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += out - stream.avail_out;
  }
  packed.resize(made);
  return packed;
}

/// False unless the bytes inflate to the right size.
bool inflate_into(std::span<const std::uint8_t> packed, std::vector<std::uint8_t>& bytes) {
  z_stream stream = {};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  struct Closer {
    z_stream& stream;
    ~Closer() { inflateEnd(&stream); }
  } const closer{stream};
  std::size_t taken = 0, made = 0;
  std::uint8_t none = 0;
  for (;;) {
    const std::size_t in = std::min(packed.size() - taken, kMostAtOnce),
                      out = std::min(bytes.size() - made, kMostAtOnce);
    stream.next_in = const_cast<Bytef*>(packed.data() + taken);
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = out > 0 ? bytes.data() + made : &none;
    stream.avail_out = static_cast<uInt>(out);
    const int state = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    made += out - stream.avail_out;
    if (state == Z_STREAM_END) return made == bytes.size();
    const bool moves = in > stream.avail_in || out > stream.avail_out;
    if (state != Z_OK || !moves) return false;
  }
}

tl::unexpected<Error> broken(std::string why) { return fail(ErrorKind::kInput, std::move(why)); }

/// Appends the fields common to an entry's header and its record.
void append_common(std::vector<std::uint8_t>& bytes, const ZipRecord& record, bool in_64) {
  append_number(bytes, in_64 ? kVersion64 : kVersion);
  append_number(bytes, record.flags);
  append_number(bytes, record.method);
  append_number(bytes, std::uint16_t{0});  // time
  append_number(bytes, kFirstDate);
  append_number(bytes, record.checksum);
  append_number(bytes, static_cast<std::uint32_t>(record.packed));
  append_number(bytes, static_cast<std::uint32_t>(record.size));
  append_number(bytes, static_cast<std::uint16_t>(record.name.size()));
}

}  // namespace

std::uint32_t zip_checksum(std::span<const std::uint8_t> bytes) {
  uLong sum = crc32(0, nullptr, 0);
  for (std::size_t begin = 0; begin < bytes.size(); begin += kMostAtOnce)
    sum = crc32(sum, bytes.data() + begin, static_cast<uInt>(std::min(kMostAtOnce, bytes.size() - begin)));
  return static_cast<std::uint32_t>(sum);
}

void append_zip_header(std::vector<std::uint8_t>& bytes, const ZipRecord& record) {
  append_number(bytes, kLocal);
  append_common(bytes, record, false);
  append_number(bytes, std::uint16_t{0});  // extra field
  append_text(bytes, record.name);
}

void append_zip_record(std::vector<std::uint8_t>& bytes, const ZipRecord& record) {
  const bool in_64 = record.offset >= kIn64;
  append_number(bytes, kCentral);
  append_number(bytes, in_64 ? kVersion64 : kVersion);
  append_common(bytes, record, in_64);
  append_number(bytes, static_cast<std::uint16_t>(in_64 ? 12 : 0));  // extra field
  append_number(bytes, std::uint16_t{0});                            // comment
  append_number(bytes, std::uint16_t{0});                            // volume
  append_number(bytes, std::uint16_t{0});                            // internal attributes
  append_number(bytes, std::uint32_t{0});                            // external attributes
  append_number(bytes, in_64 ? kIn64 : static_cast<std::uint32_t>(record.offset));
  append_text(bytes, record.name);
  if (!in_64) return;
  append_number(bytes, kField64);
  append_number(bytes, std::uint16_t{8});
  append_number(bytes, record.offset);
}

void append_zip_end(std::vector<std::uint8_t>& bytes, std::uint64_t count, std::uint64_t start, std::uint64_t size) {
  const bool in_64 = count >= kCountIn64 || start >= kIn64 || size >= kIn64;
  if (in_64) {
    append_number(bytes, kEnd64);
    append_number(bytes, std::uint64_t{kEnd64Size - 12});
    append_number(bytes, kVersion64);
    append_number(bytes, kVersion64);
    append_number(bytes, std::uint32_t{0});  // volume
    append_number(bytes, std::uint32_t{0});  // volume of the directory
    append_number(bytes, count);
    append_number(bytes, count);
    append_number(bytes, size);
    append_number(bytes, start);
    append_number(bytes, kLocator64);
    append_number(bytes, std::uint32_t{0});  // volume
    append_number(bytes, start + size);
    append_number(bytes, std::uint32_t{1});  // volumes
  }
  const auto short_count = in_64 ? kCountIn64 : static_cast<std::uint16_t>(count);
  append_number(bytes, kEndRecord);
  append_number(bytes, std::uint32_t{0});  // volumes
  append_number(bytes, short_count);
  append_number(bytes, short_count);
  append_number(bytes, in_64 ? kIn64 : static_cast<std::uint32_t>(size));
  append_number(bytes, in_64 ? kIn64 : static_cast<std::uint32_t>(start));
  append_number(bytes, std::uint16_t{0});  // comment
}

Result<std::vector<std::uint8_t>> encode_zip(std::span<const ZipEntry> entries) {
  std::vector<std::uint8_t> archive, directory;
  for (const ZipEntry& entry : entries) {
    const std::vector<std::uint8_t> packed = deflated(entry.bytes);
    constexpr std::size_t kMost = kIn64 - 1;
    if (std::max({entry.bytes.size(), packed.size(), archive.size() + packed.size() + 4096}) > kMost)
      return fail(ErrorKind::kOutput, "a ZIP archive holds at most 4 GB, and this would be more");
    ZipRecord record;
    record.name = entry.name;
    record.offset = archive.size();
    record.packed = packed.size();
    record.size = entry.bytes.size();
    record.checksum = zip_checksum(entry.bytes);
    record.method = kZipDeflated;
    append_zip_header(archive, record);
    archive.insert(archive.end(), packed.begin(), packed.end());
    append_zip_record(directory, record);
  }
  const std::size_t start = archive.size();
  archive.insert(archive.end(), directory.begin(), directory.end());
  append_zip_end(archive, entries.size(), start, directory.size());
  return archive;
}

Result<ZipDirectory> find_zip_directory(std::span<const std::uint8_t> tail, std::uint64_t size) {
  constexpr std::size_t kLongestComment = 65535;
  const std::uint64_t first = size - tail.size();  // offset of the tail in the archive
  for (std::size_t back = kEndSize; back <= std::min(tail.size(), kEndSize + kLongestComment); ++back) {
    const std::uint8_t* end = &tail[tail.size() - back];
    if (load_number<std::uint32_t>(end) != kEndRecord) continue;
    ZipDirectory directory{load_number<std::uint16_t>(end + 10), load_number<std::uint32_t>(end + 16)};
    if (back + kLocatorSize <= tail.size() && load_number<std::uint32_t>(end - kLocatorSize) == kLocator64) {
      const std::uint64_t record = load_number<std::uint64_t>(end - kLocatorSize + 8);
      if (record < first || record > size || size - record < kEnd64Size ||
          load_number<std::uint32_t>(&tail[record - first]) != kEnd64)
        return broken("the archive's end does not say where its directory is");
      directory.count = load_number<std::uint64_t>(&tail[record - first + 32]);
      directory.start = load_number<std::uint64_t>(&tail[record - first + 48]);
    }
    if (directory.start > size) return broken("the archive's directory is damaged");
    return directory;
  }
  return broken("it is an archive without a directory: it was cut off");
}

Result<std::vector<ZipRecord>> read_zip_directory(std::span<const std::uint8_t> bytes, std::uint64_t count) {
  const std::uint64_t size = bytes.size();
  std::vector<ZipRecord> records;
  std::uint64_t at = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at > size || size - at < kCentralSize || load_number<std::uint32_t>(&bytes[at]) != kCentral)
      return broken("the archive's directory is damaged");
    const std::uint8_t* head = &bytes[at];
    ZipRecord entry;
    entry.flags = load_number<std::uint16_t>(head + 8);
    entry.method = load_number<std::uint16_t>(head + 10);
    entry.checksum = load_number<std::uint32_t>(head + 16);
    entry.packed = load_number<std::uint32_t>(head + 20);
    entry.size = load_number<std::uint32_t>(head + 24);
    entry.offset = load_number<std::uint32_t>(head + 42);
    const std::uint64_t name = load_number<std::uint16_t>(head + 28), extra = load_number<std::uint16_t>(head + 30),
                        comment = load_number<std::uint16_t>(head + 32);
    if (size - at - kCentralSize < name + extra + comment) return broken("the archive's directory is damaged");
    entry.name = {reinterpret_cast<const char*>(head) + kCentralSize, static_cast<std::size_t>(name)};
    const std::uint64_t extra_end = at + kCentralSize + name + extra;
    for (std::uint64_t field = at + kCentralSize + name; field + 4 <= extra_end;) {
      const auto id = load_number<std::uint16_t>(&bytes[field]);
      const std::uint64_t next = field + 4 + load_number<std::uint16_t>(&bytes[field + 2]);
      if (next > extra_end) break;
      std::uint64_t value = field + 4;
      for (std::uint64_t* number : {&entry.size, &entry.packed, &entry.offset}) {
        if (id != kField64 || *number != kIn64 || value + 8 > next) continue;
        *number = load_number<std::uint64_t>(&bytes[value]);
        value += 8;
      }
      field = next;
    }
    records.push_back(entry);
    at += kCentralSize + name + extra + comment;
  }
  return records;
}

std::uint64_t zip_header_length(std::span<const std::uint8_t> header) {
  if (header.size() < kZipHeaderSize || load_number<std::uint32_t>(header.data()) != kLocal) return 0;
  return kZipHeaderSize + load_number<std::uint16_t>(&header[26]) + load_number<std::uint16_t>(&header[28]);
}

Result<std::vector<std::uint8_t>> unpack_zip_entry(const ZipRecord& record, std::span<const std::uint8_t> packed) {
  const auto damaged = [&] { return broken(fmt::format("{} in the archive is damaged", in_quotes(record.name))); };
  if ((record.flags & 1) != 0) return broken(fmt::format("{} in the archive is encrypted", in_quotes(record.name)));
  constexpr std::uint64_t kMostRatio = 1032;  // limit of deflate
  if (record.method == kZipStored ? record.size != record.packed : record.size / kMostRatio > record.packed)
    return damaged();
  std::vector<std::uint8_t> bytes(record.size);
  if (record.method == kZipStored) {
    std::copy(packed.begin(), packed.end(), bytes.begin());
  } else if (record.method != kZipDeflated) {
    return broken(fmt::format("{} in the archive is packed by method {}, which Scarp does not know",
                              in_quotes(record.name), record.method));
  } else if (!inflate_into(packed, bytes)) {
    return damaged();
  }
  if (zip_checksum(bytes) != record.checksum) return damaged();
  return bytes;
}

Result<ZipReader> ZipReader::open(std::span<const std::uint8_t> bytes) {
  const auto tail = bytes.last(std::min<std::size_t>(bytes.size(), kLongestZipEnd));
  SCARP_TRY(const auto& directory, find_zip_directory(tail, bytes.size()));
  SCARP_TRY(auto&& records, read_zip_directory(bytes.subspan(directory.start), directory.count));
  return ZipReader(bytes, std::move(records));
}

std::string ZipReader::find(std::string_view name) const {
  for (const ZipRecord& record : records_) {
    if (lowered(std::string(record.name)) == lowered(std::string(name))) return std::string(record.name);
  }
  return {};
}

Result<std::vector<std::uint8_t>> ZipReader::extract(std::string_view name) const {
  const auto record =
      std::find_if(records_.begin(), records_.end(), [&](const ZipRecord& one) { return one.name == name; });
  if (record == records_.end()) return broken(fmt::format("the archive holds no {}", in_quotes(name)));
  const std::uint64_t size = bytes_.size();
  const std::uint64_t header = record->offset < size ? zip_header_length(bytes_.subspan(record->offset)) : 0;
  if (header == 0 || size - record->offset < header || size - record->offset - header < record->packed)
    return broken(fmt::format("{} in the archive is damaged", in_quotes(name)));
  return unpack_zip_entry(*record, bytes_.subspan(record->offset + header, record->packed));
}

}  // namespace scarp::io
