// ZIP, as far as documents in archives need it (PKWARE's APPNOTE 6.3): on writing, one way of doing things, all sizes
// known beforehand; on reading, the directory at the end is what counts, since writers that stream leave the sizes in
// front of an entry empty. Sizes of 64 bits are read, for some write them whatever the size, and not written.

#include "io/mesh/zip.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>

#include "io/mesh/file_bytes.h"
#include "io/mesh/mesh_file_text.h"

namespace scarp {
namespace {

constexpr std::uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEndRecord = 0x06054b50, kEnd64 = 0x06064b50,
                        kLocator64 = 0x07064b50;
constexpr std::size_t kLocalSize = 30, kCentralSize = 46, kEndSize = 22, kEnd64Size = 56, kLocatorSize = 20;
constexpr std::uint16_t kStored = 0, kDeflated = 8, kVersion = 20, kFirstDate = 0x21;  // 1980-01-01
constexpr std::uint32_t kIn64 = 0xffffffff;

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

/// Raw deflate.
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

/// False if the bytes are not `size` bytes, deflated.
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

std::uint32_t checksum_of(std::span<const std::uint8_t> bytes) {
  uLong sum = crc32(0, nullptr, 0);
  for (std::size_t begin = 0; begin < bytes.size(); begin += kMostAtOnce)
    sum = crc32(sum, bytes.data() + begin, static_cast<uInt>(std::min(kMostAtOnce, bytes.size() - begin)));
  return static_cast<std::uint32_t>(sum);
}

tl::unexpected<Error> broken(std::string why) { return fail(ErrorKind::kInput, std::move(why)); }

}  // namespace

Result<std::vector<std::uint8_t>> encode_zip(std::span<const ZipEntry> entries) {
  std::vector<std::uint8_t> archive, directory;
  for (const ZipEntry& entry : entries) {
    const std::vector<std::uint8_t> packed = deflated(entry.bytes);
    constexpr std::size_t kMost = kIn64 - 1;
    if (std::max({entry.bytes.size(), packed.size(), archive.size() + packed.size() + 4096}) > kMost)
      return fail(ErrorKind::kOutput, "a ZIP archive holds at most 4 GB, and this would be more");
    const auto start = static_cast<std::uint32_t>(archive.size());
    const auto append_common = [&](std::vector<std::uint8_t>& bytes) {
      append_number(bytes, kVersion);
      append_number(bytes, std::uint16_t{0});  // flags
      append_number(bytes, kDeflated);
      append_number(bytes, std::uint16_t{0});  // time
      append_number(bytes, kFirstDate);
      append_number(bytes, checksum_of(entry.bytes));
      append_number(bytes, static_cast<std::uint32_t>(packed.size()));
      append_number(bytes, static_cast<std::uint32_t>(entry.bytes.size()));
      append_number(bytes, static_cast<std::uint16_t>(entry.name.size()));
      append_number(bytes, std::uint16_t{0});  // extra field
    };
    append_number(archive, kLocal);
    append_common(archive);
    append_text(archive, entry.name);
    archive.insert(archive.end(), packed.begin(), packed.end());
    append_number(directory, kCentral);
    append_number(directory, kVersion);
    append_common(directory);
    append_number(directory, std::uint16_t{0});  // comment
    append_number(directory, std::uint16_t{0});  // volume
    append_number(directory, std::uint16_t{0});  // internal attributes
    append_number(directory, std::uint32_t{0});  // external attributes
    append_number(directory, start);
    append_text(directory, entry.name);
  }
  const auto start = static_cast<std::uint32_t>(archive.size());
  archive.insert(archive.end(), directory.begin(), directory.end());
  append_number(archive, kEndRecord);
  append_number(archive, std::uint32_t{0});  // volumes
  append_number(archive, static_cast<std::uint16_t>(entries.size()));
  append_number(archive, static_cast<std::uint16_t>(entries.size()));
  append_number(archive, static_cast<std::uint32_t>(directory.size()));
  append_number(archive, start);
  append_number(archive, std::uint16_t{0});  // comment
  return archive;
}

Result<ZipReader> ZipReader::open(std::span<const std::uint8_t> bytes) {
  const std::size_t size = bytes.size();
  constexpr std::size_t kLongestComment = 65535;
  for (std::size_t back = kEndSize; back <= std::min(size, kEndSize + kLongestComment); ++back) {
    const std::uint8_t* end = &bytes[size - back];
    if (load_number<std::uint32_t>(end) != kEndRecord) continue;
    std::uint64_t count = load_number<std::uint16_t>(end + 10), at = load_number<std::uint32_t>(end + 16);
    if (back + kLocatorSize <= size && load_number<std::uint32_t>(end - kLocatorSize) == kLocator64) {
      const std::uint64_t record = load_number<std::uint64_t>(end - kLocatorSize + 8);
      if (record > size || size - record < kEnd64Size || load_number<std::uint32_t>(&bytes[record]) != kEnd64)
        return broken("the archive's end does not say where its directory is");
      count = load_number<std::uint64_t>(&bytes[record + 32]);
      at = load_number<std::uint64_t>(&bytes[record + 48]);
    }
    ZipReader reader(bytes);
    if (auto read = reader.read_directory(at, count); !read) return tl::unexpected(std::move(read.error()));
    return reader;
  }
  return broken("it is an archive without a directory: it was cut off");
}

Result<void> ZipReader::read_directory(std::uint64_t at, std::uint64_t count) {
  const std::uint64_t size = bytes_.size();
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at > size || size - at < kCentralSize || load_number<std::uint32_t>(&bytes_[at]) != kCentral)
      return broken("the archive's directory is damaged");
    const std::uint8_t* head = &bytes_[at];
    Entry entry;
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
      const auto id = load_number<std::uint16_t>(&bytes_[field]);
      const std::uint64_t next = field + 4 + load_number<std::uint16_t>(&bytes_[field + 2]);
      if (next > extra_end) break;
      std::uint64_t value = field + 4;
      for (std::uint64_t* number : {&entry.size, &entry.packed, &entry.offset}) {
        if (id != 1 || *number != kIn64 || value + 8 > next) continue;
        *number = load_number<std::uint64_t>(&bytes_[value]);
        value += 8;
      }
      field = next;
    }
    entries_.push_back(entry);
    at += kCentralSize + name + extra + comment;
  }
  return {};
}

std::string ZipReader::find(std::string_view name) const {
  for (const Entry& entry : entries_) {
    if (lowered(std::string(entry.name)) == lowered(std::string(name))) return std::string(entry.name);
  }
  return {};
}

Result<std::vector<std::uint8_t>> ZipReader::extract(std::string_view name) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
  if (found == entries_.end()) return broken(fmt::format("the archive holds no {}", in_quotes(name)));
  const Entry& entry = *found;
  const auto damaged = [&] { return broken(fmt::format("{} in the archive is damaged", in_quotes(name))); };
  const std::uint64_t size = bytes_.size();
  if (entry.offset > size || size - entry.offset < kLocalSize ||
      load_number<std::uint32_t>(&bytes_[entry.offset]) != kLocal)
    return damaged();
  const std::uint64_t start = entry.offset + kLocalSize + load_number<std::uint16_t>(&bytes_[entry.offset + 26]) +
                              load_number<std::uint16_t>(&bytes_[entry.offset + 28]);
  if (start > size || size - start < entry.packed) return damaged();
  if ((entry.flags & 1) != 0) return broken(fmt::format("{} in the archive is encrypted", in_quotes(name)));
  const std::span<const std::uint8_t> packed = bytes_.subspan(start, entry.packed);
  constexpr std::uint64_t kMostRatio = 1032;  // of deflate
  if (entry.method == kStored ? entry.size != entry.packed : entry.size / kMostRatio > entry.packed) return damaged();
  std::vector<std::uint8_t> bytes(entry.size);
  if (entry.method == kStored) {
    std::copy(packed.begin(), packed.end(), bytes.begin());
  } else if (entry.method != kDeflated) {
    return broken(fmt::format("{} in the archive is packed by method {}, which Scarp does not know", in_quotes(name),
                              entry.method));
  } else if (!inflate_into(packed, bytes)) {
    return damaged();
  }
  if (checksum_of(bytes) != entry.checksum) return damaged();
  return bytes;
}

}  // namespace scarp
