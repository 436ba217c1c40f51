#include "io/raster/stm.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "io/raster/height_unit.h"
#include "io/raster/raster_finish.h"

namespace scarp::io {
namespace {

constexpr std::uint32_t kMissing = 65535;

struct StmHeader {
  std::uint32_t cols = 0, rows = 0;
  bool big_endian = false;
  std::size_t samples_at = 0;
};

/// Parses a number of at most 2^31 − 1, and one space.
bool take_number(std::span<const std::uint8_t> bytes, std::size_t& at, std::uint32_t& out) {
  std::uint64_t value = 0;
  const std::size_t start = at;
  for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at) {
    value = value * 10 + static_cast<std::uint64_t>(bytes[at] - '0');
    if (value > 0x7fffffff) return false;
  }
  if (at == start || at >= bytes.size() || bytes[at] != ' ') return false;
  ++at;
  out = static_cast<std::uint32_t>(value);
  return true;
}

Result<StmHeader> decode_stm_header(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (!is_stm(bytes)) return fail(ErrorKind::kInput, name + ": not an STM: it does not begin with 'STM '");
  StmHeader header;
  std::size_t at = 4;
  if (!take_number(bytes, at, header.cols) || !take_number(bytes, at, header.rows) || bytes.size() < at + 5) {
    return fail(ErrorKind::kInput, name + ": the STM header is not 'STM width height ' and four bytes of byte order");
  }
  const std::array<std::uint8_t, 4> order{bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]};
  constexpr std::array<std::uint8_t, 4> kLittle{1, 2, 3, 4}, kBig{4, 3, 2, 1};
  if ((order != kLittle && order != kBig) || bytes[at + 4] != '\n') {
    return fail(
        ErrorKind::kInput,
        fmt::format(
            "{}: the STM header's byte order is {:02x} {:02x} {:02x} {:02x} where 04 03 02 01 (high byte first) "
            "or 01 02 03 04 and a newline belong",
            name, order[0], order[1], order[2], order[3]));
  }
  header.big_endian = order == kBig;
  header.samples_at = at + 5;
  return header;
}

RasterInfo describe_stm(const std::string& name, double nodata) {
  RasterInfo info;
  info.path = name;
  info.format = "STM";
  info.sample_type = "UInt16";
  info.nodata = nodata;
  return info;
}

}  // namespace

bool is_stm(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && bytes[0] == 'S' && bytes[1] == 'T' && bytes[2] == 'M' && bytes[3] == ' ';
}

Result<OwnedHeightField> decode_stm(std::span<const std::uint8_t> bytes, const std::string& name,
                                    const ReadOptions& options) {
  SCARP_TRY(auto&& header, decode_stm_header(bytes, name));
  SCARP_TRY(auto&& frame,
            bare_grid_frame(name, "an STM", static_cast<int>(header.cols), static_cast<int>(header.rows), options));
  const std::uint64_t count = static_cast<std::uint64_t>(header.cols) * header.rows;
  const std::uint64_t there = bytes.size() - header.samples_at;
  if (there != count * 2) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: {} x {} samples need {} bytes after the header, and {} are there: the file is {}",
                            name, header.cols, header.rows, count * 2, there,
                            there < count * 2 ? "truncated" : "not what its header says"));
  }
  SCARP_RETURN_IF_ERROR(check_raster_size(name, header.cols, header.rows, options));

  const double nodata = options.nodata.value_or(kMissing);
  OwnedHeightField field;
  field.cols = static_cast<int>(header.cols);
  field.rows = static_cast<int>(header.rows);
  field.frame = std::move(frame);
  field.info = describe_stm(name, nodata);
  SCARP_RETURN_IF_ERROR(allocate_samples(name, field));
  const std::uint8_t* data = bytes.data() + header.samples_at;
  const std::size_t high = header.big_endian ? 0 : 1;
  for (std::uint64_t k = 0; k < count; ++k) {
    const int value = data[2 * k + high] << 8 | data[2 * k + 1 - high];
    field.samples[k] = value == nodata ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value);
  }
  SCARP_TRY(const auto& settled, settle_heights(options, field.frame, field.info));
  scale_values(settled, field);
  SCARP_RETURN_IF_ERROR(finish_raster(field, 0, options));
  return field;
}

}  // namespace scarp::io
