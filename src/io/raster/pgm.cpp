// PGM. Source: the pgm(5) page of Netpbm. As in Netpbm's reader, '#' starts a comment that extends to the end of the
// line and counts as a newline, and exactly one white space byte separates the header from the samples.
#include "io/raster/pgm.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "io/raster/height_unit.h"
#include "io/raster/raster_finish.h"

namespace scarp::io {
namespace {

constexpr int kEndOfText = -1;

bool is_space(int c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }
bool is_digit(int c) { return c >= '0' && c <= '9'; }

/// Bytes without their comments.
class Text {
 public:
  explicit Text(std::span<const std::uint8_t> bytes, std::size_t at) : bytes_(bytes), at_(at) {}

  int next() {
    if (at_ >= bytes_.size()) return kEndOfText;
    if (bytes_[at_] != '#') return bytes_[at_++];
    while (at_ < bytes_.size() && bytes_[at_] != '\n' && bytes_[at_] != '\r') ++at_;
    if (at_ < bytes_.size()) ++at_;
    return '\n';
  }

  /// Parses a number after white space, and consumes the byte after it. Nothing at the end, for other characters, and
  /// for numbers above 2^31 − 1.
  std::optional<std::uint32_t> number() {
    int c = next();
    while (is_space(c)) c = next();
    if (!is_digit(c)) return {};
    std::uint64_t value = 0;
    for (; is_digit(c); c = next()) {
      value = value * 10 + static_cast<std::uint64_t>(c - '0');
      if (value > 0x7fffffff) return {};
    }
    if (c != kEndOfText && !is_space(c)) return {};
    return static_cast<std::uint32_t>(value);
  }

  bool only_space_left() {
    int c = next();
    while (is_space(c)) c = next();
    return c == kEndOfText;
  }

  std::size_t position() const { return at_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_;
};

struct PgmHeader {
  bool plain = false;
  std::uint32_t cols = 0, rows = 0, maxval = 0;
  std::size_t samples_at = 0;
  std::uint64_t count() const { return static_cast<std::uint64_t>(cols) * rows; }
};

Result<PgmHeader> decode_pgm_header(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (!is_pgm(bytes)) return fail(ErrorKind::kInput, name + ": not a PGM: it does not begin with P2 or P5");
  PgmHeader header;
  header.plain = bytes[1] == '2';
  Text text(bytes, 2);
  for (std::uint32_t* field : {&header.cols, &header.rows, &header.maxval}) {
    const auto value = text.number();
    if (!value) return fail(ErrorKind::kInput, name + ": the PGM header has no valid width, height and maxval");
    *field = *value;
  }
  if (header.maxval < 1 || header.maxval > 65535) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: maxval is {}, but a PGM's lies between 1 and 65535", name, header.maxval));
  }
  header.samples_at = text.position();
  return header;
}

RasterInfo describe_pgm(const PgmHeader& header, const std::string& name) {
  RasterInfo info;
  info.path = name;
  info.format = "PGM";
  info.sample_type = header.maxval < 256 ? "Byte" : "UInt16";
  return info;
}

class PgmSamples {
 public:
  PgmSamples(const PgmHeader& header, const std::string& name, const ReadOptions& options, float* out)
      : header_(header), name_(name), nodata_(options.nodata), out_(out) {}

  Result<void> put(std::uint64_t index, std::uint32_t value) {
    if (value > header_.maxval) {
      return fail(ErrorKind::kInput, fmt::format("{}: sample ({}, {}) is {}, above the header's maxval {}", name_,
                                                 index % header_.cols, index / header_.cols, value, header_.maxval));
    }
    const bool is_nodata = nodata_ && *nodata_ == value;
    out_[index] = is_nodata ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value);
    return {};
  }

 private:
  const PgmHeader& header_;
  const std::string& name_;
  std::optional<double> nodata_;
  float* out_;
};

Result<void> decode_plain(std::span<const std::uint8_t> bytes, const PgmHeader& header, const std::string& name,
                          PgmSamples& samples) {
  Text text(bytes, header.samples_at);
  for (std::uint64_t k = 0; k < header.count(); ++k) {
    const auto value = text.number();
    if (!value) {
      return fail(ErrorKind::kInput,
                  fmt::format("{}: sample ({}, {}) is missing or not a number: the file is truncated "
                              "or damaged",
                              name, k % header.cols, k / header.cols));
    }
    SCARP_RETURN_IF_ERROR(samples.put(k, *value));
  }
  if (!text.only_space_left()) {
    return fail(ErrorKind::kInput, name +
                                       ": there is more after the last sample: the header's size is wrong, or the file "
                                       "holds several pictures");
  }
  return {};
}

Result<void> decode_raw(std::span<const std::uint8_t> bytes, const PgmHeader& header, const std::string& name,
                        PgmSamples& samples) {
  const bool wide = header.maxval > 255;
  const std::uint8_t* data = bytes.data() + header.samples_at;
  for (std::uint64_t k = 0; k < header.count(); ++k) {
    const std::uint32_t value = wide ? static_cast<std::uint32_t>(data[2 * k] << 8 | data[2 * k + 1]) : data[k];
    SCARP_RETURN_IF_ERROR(samples.put(k, value));
  }
  const std::uint64_t end = header.samples_at + header.count() * (wide ? 2 : 1);
  for (std::uint64_t k = end; k < bytes.size(); ++k) {
    if (!is_space(bytes[k])) {
      return fail(ErrorKind::kInput,
                  fmt::format("{}: {} bytes follow the last sample: the header's size or maxval is wrong, "
                              "or the file holds several pictures",
                              name, bytes.size() - end));
    }
  }
  return {};
}

}  // namespace

bool is_pgm(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 3 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5') &&
         (is_space(bytes[2]) || bytes[2] == '#');
}

Result<OwnedHeightField> decode_pgm(std::span<const std::uint8_t> bytes, const std::string& name,
                                    const ReadOptions& options) {
  SCARP_TRY(auto&& header, decode_pgm_header(bytes, name));
  SCARP_TRY(auto&& frame,
            bare_grid_frame(name, "a PGM", static_cast<int>(header.cols), static_cast<int>(header.rows), options));

  // The file must be large enough for its header's size. A plain sample needs a digit and a space.
  const std::uint64_t there = bytes.size() - header.samples_at;
  const std::uint64_t needed =
      header.plain ? header.count() * 2 - (header.count() > 0 ? 1 : 0) : header.count() * (header.maxval > 255 ? 2 : 1);
  if (there < needed) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: truncated: {} x {} samples need at least {} bytes after the header, and {} are there",
                            name, header.cols, header.rows, needed, there));
  }
  SCARP_RETURN_IF_ERROR(check_raster_size(name, header.cols, header.rows, options));

  OwnedHeightField field;
  field.cols = static_cast<int>(header.cols);
  field.rows = static_cast<int>(header.rows);
  field.frame = std::move(frame);
  field.info = describe_pgm(header, name);
  field.info.nodata = options.nodata;
  SCARP_RETURN_IF_ERROR(allocate_samples(name, field));
  PgmSamples samples(header, name, options, field.samples.data());
  SCARP_RETURN_IF_ERROR(header.plain ? decode_plain(bytes, header, name, samples)
                                     : decode_raw(bytes, header, name, samples));
  SCARP_TRY(const auto& settled, settle_heights(options, field.frame, field.info));
  scale_values(settled, field);
  SCARP_RETURN_IF_ERROR(finish_raster(field, 0, options));
  return field;
}

}  // namespace scarp::io
