#include "las/laz_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "las/bytes.h"
#include "las/integer_decoder.h"
#include "las/point.h"
#include "las/range_decoder.h"

namespace scarp::las {
namespace {

/// Compression versions of an item, and its size; 0: any.
struct ItemRow {
  LazItemType type;
  bool is_layered;
  std::uint16_t bytes, first_version, last_version;
};

constexpr ItemRow kItems[] = {
    {LazItemType::kByte, false, 0, 1, 2},          {LazItemType::kPoint10, false, 20, 1, 2},
    {LazItemType::kGpsTime11, false, 8, 1, 2},     {LazItemType::kRgb12, false, 6, 1, 2},
    {LazItemType::kWavePacket13, false, 29, 1, 2}, {LazItemType::kPoint14, true, 30, 3, 4},
    {LazItemType::kRgb14, true, 6, 3, 4},          {LazItemType::kRgbNir14, true, 8, 3, 4},
    {LazItemType::kWavePacket14, true, 29, 3, 4},  {LazItemType::kByte14, true, 0, 3, 4},
};

const ItemRow* find_row(LazItemType type) {
  const auto* const row =
      std::find_if(std::begin(kItems), std::end(kItems), [&](const ItemRow& of) { return of.type == type; });
  return row != std::end(kItems) ? row : nullptr;
}

/// The reason why the item cannot be read; empty if it can.
std::string find_fault(const LazItem& item, bool is_layered) {
  const ItemRow* const row = find_row(item.type);
  if (row == nullptr)
    return fmt::format("its points have a compressed item of type {}, which is unknown",
                       static_cast<unsigned>(item.type));
  if (item.version < row->first_version || item.version > row->last_version)
    return fmt::format(
        "its points have an item of type {} compressed by version {}, and Scarp knows versions {} and {}",
        static_cast<unsigned>(item.type), item.version, row->first_version, row->last_version);
  if (row->is_layered != is_layered || item.bytes == 0 || (row->bytes != 0 && item.bytes != row->bytes))
    return fmt::format("its record about compression contradicts itself: an item of type {} with {} bytes",
                       static_cast<unsigned>(item.type), item.bytes);
  return "";
}

constexpr std::size_t kFixedBytes = 34, kItemBytes = 6;

/// Reads sizes of chunks from the table's stream.
class TableReader {
 public:
  TableReader(const LazRecord& record, std::span<const std::uint8_t> bytes) : record_(record), decoder_(bytes) {}

  LazChunk next() {
    if (record_.has_varying_chunks()) points_ = numbers_.decode(decoder_, points_, 0);
    bytes_ = numbers_.decode(decoder_, bytes_, 1);
    return {0, static_cast<std::uint32_t>(bytes_),
            record_.has_varying_chunks() ? static_cast<std::uint32_t>(points_) : record_.chunk_points};
  }
  bool is_exhausted() const { return decoder_.is_exhausted(); }

 private:
  const LazRecord& record_;
  RangeDecoder decoder_;
  IntegerDecoder<32, 2> numbers_;
  std::int32_t points_ = 0, bytes_ = 0;
};

std::optional<std::vector<std::uint8_t>> read_bytes(const Source& source, std::uint64_t offset, std::uint64_t count) {
  if (!source.holds(offset, count)) return std::nullopt;
  std::vector<std::uint8_t> bytes(count);
  if (!source.read(offset, bytes)) return std::nullopt;
  return bytes;
}

/// Finds the table. Writers that cannot seek store its offset at the end of the file.
std::optional<std::uint64_t> find_table(const Source& source, std::uint64_t offset) {
  for (const std::uint64_t place : {offset, source.size - 8}) {
    const auto bytes = read_bytes(source, place, 8);
    if (!bytes) return std::nullopt;
    const auto table = load<std::uint64_t>(bytes->data());
    if (table >= offset + 8 && source.holds(table, 8)) return table;
    if (static_cast<std::int64_t>(table) > 0) return std::nullopt;
  }
  return std::nullopt;
}

/// Fails if the chunks do not fill the bytes up to the table, or do not have the header's number of points.
Result<std::vector<LazChunk>> lay_out(TableReader& reader, std::uint64_t count, std::uint64_t begin, std::uint64_t end,
                                      std::uint64_t least, std::uint64_t points, const std::string& name) {
  const auto damaged = [&](const std::string& how) {
    return refuse(name, fmt::format("its table of chunks {}: the file is damaged", how));
  };
  std::vector<LazChunk> chunks;
  std::uint64_t offset = begin, found = 0;
  for (std::uint64_t k = 0; k < count && found < points; ++k) {
    LazChunk chunk = reader.next();
    if (reader.is_exhausted()) return damaged(fmt::format("ends before its {} chunks do", count));
    if (chunk.points == 0 && chunk.bytes == 0) continue;
    if (chunk.bytes < least || chunk.bytes > end - offset || chunk.points == 0)
      return damaged(fmt::format("has {} bytes for {} points in chunk {}, and {} bytes are left", chunk.bytes,
                                 chunk.points, k, end - offset));
    chunk.offset = offset;
    chunk.points = std::min(chunk.points, points - found);
    offset += chunk.bytes;
    found += chunk.points;
    chunks.push_back(chunk);
  }
  if (found < points) return damaged(fmt::format("has {} points, and the header announces {}", found, points));
  return chunks;
}

}  // namespace

std::uint64_t LazRecord::point_bytes() const {
  std::uint64_t bytes = 0;
  for (const LazItem& item : items) bytes += item.bytes;
  return bytes;
}

Result<LazRecord> parse_laz_record(std::span<const std::uint8_t> bytes, unsigned point_format,
                                   std::uint16_t record_bytes, const std::string& name) {
  if (bytes.size() < kFixedBytes)
    return refuse(
        name, fmt::format("its record about compression has {} bytes, and {} are needed", bytes.size(), kFixedBytes));
  const auto compressor = load<std::uint16_t>(bytes.data()), coder = load<std::uint16_t>(bytes.data() + 2);
  if (compressor < 1 || compressor > 3 || coder != 0)
    return refuse(name, fmt::format("its points are compressed by compressor {} and coder {}, which are unknown",
                                    compressor, coder));
  LazRecord record;
  record.is_layered = compressor == 3;
  record.has_chunks = compressor != 1;
  record.chunk_points = load<std::uint32_t>(bytes.data() + 12);
  if (record.has_chunks && record.chunk_points == 0)
    return refuse(name, "its record about compression has chunks of 0 points");
  const auto count = load<std::uint16_t>(bytes.data() + 32);
  if (bytes.size() < kFixedBytes + count * kItemBytes)
    return refuse(name,
                  fmt::format("its record about compression has {} bytes, too few for {} items", bytes.size(), count));
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint8_t* const at = bytes.data() + kFixedBytes + k * kItemBytes;
    record.items.push_back(
        {static_cast<LazItemType>(load<std::uint16_t>(at)), load<std::uint16_t>(at + 2), load<std::uint16_t>(at + 4)});
    if (const std::string fault = find_fault(record.items.back(), record.is_layered); !fault.empty())
      return refuse(name, fault);
  }
  const LazItemType first = record.is_layered ? LazItemType::kPoint14 : LazItemType::kPoint10;
  const auto is_place = [](const LazItem& item) {
    return item.type == LazItemType::kPoint10 || item.type == LazItemType::kPoint14;
  };
  const bool has_one_place = std::count_if(record.items.begin(), record.items.end(), is_place) == 1;
  if (!has_one_place || record.items.front().type != first || is_extended(point_format) != record.is_layered)
    return refuse(name, fmt::format("its record about compression does not fit point format {}", point_format));
  if (record.point_bytes() != record_bytes)
    return refuse(name, fmt::format("its compressed points have {} bytes, and its header announces {}",
                                    record.point_bytes(), record_bytes));
  return record;
}

Result<std::vector<LazChunk>> read_chunk_table(const Source& source, const LazRecord& record, std::uint64_t offset,
                                               std::uint64_t points) {
  const std::string& name = source.name;
  if (points == 0) return std::vector<LazChunk>();
  if (!record.has_chunks && source.size - offset < record.point_bytes())
    return refuse(name, "ends within its first point: the file is cut off");
  if (!record.has_chunks) return std::vector<LazChunk>{{offset, source.size - offset, points}};
  if (!source.holds(offset, 8)) return refuse(name, "ends before its points begin: the file is cut off");
  const auto table = find_table(source, offset);
  if (!table) return refuse(name, "its table of chunks lies beyond its end: the file is cut off");
  const auto head = read_bytes(source, *table, 8);
  if (!head) return refuse(name, "its table of chunks cannot be read");
  const std::uint64_t count = load<std::uint32_t>(head->data() + 4);
  if (load<std::uint32_t>(head->data()) != 0) return refuse(name, "its table of chunks is of an unknown version");
  // A chunk's first point is uncompressed, which limits the number of chunks. An entry has at most 16 bytes.
  const std::uint64_t most = (*table - offset - 8) / record.point_bytes();
  if (count > most)
    return refuse(name,
                  fmt::format("its table of chunks announces {} chunks, and there is room for {}: the file is damaged",
                              count, most));
  const std::uint64_t bytes = std::min(source.size - *table - 8, 16 * count + 16);
  const auto entries = read_bytes(source, *table + 8, bytes);
  if (!entries) return refuse(name, "its table of chunks cannot be read");
  TableReader reader(record, *entries);
  return lay_out(reader, count, offset + 8, *table, record.point_bytes(), points, name);
}

}  // namespace scarp::las
