#include "las/header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "las/point.h"

namespace scarp::las {
namespace {

constexpr std::uint64_t kLegacyBytes = 227, kBytesOf14 = 375;
constexpr std::size_t kRecordHead = 54, kExtendedRecordHead = 60;  // heads of variable-length records

class HeaderReader {
 public:
  explicit HeaderReader(const Source& source) : source_(source), name_(source.name) {}

  Result<Header> read() {
    SCARP_RETURN_IF_ERROR(read_fixed());
    SCARP_RETURN_IF_ERROR(check_numbers());
    SCARP_RETURN_IF_ERROR(read_records());
    SCARP_RETURN_IF_ERROR(read_extended_records());
    read_geo_keys(header_.crs);
    if (laz_.empty() && is_compressed_)
      return refuse(name_, "its points are compressed, and the record that describes how is missing");
    constexpr std::uint16_t kNone = 0;
    const bool is_plain = laz_.empty() || (laz_.size() >= 2 && compressor() == kNone);
    if (!is_plain) {
      SCARP_TRY(header_.laz, parse_laz_record(laz_, header_.point_format, header_.record_bytes, name_));
    }
    SCARP_RETURN_IF_ERROR(check_room());
    return std::move(header_);
  }

 private:
  template <class T>
  T at(std::size_t offset) const {
    return load<T>(bytes_.data() + offset);
  }

  std::uint16_t compressor() const { return load<std::uint16_t>(laz_.data()); }

  Result<void> read_fixed() {
    if (source_.size < 4 || !read_into(0, std::min(source_.size, kBytesOf14)) ||
        std::string_view(reinterpret_cast<const char*>(bytes_.data()), 4) != "LASF")
      return refuse(name_, "is no LAS file: it does not begin with LASF");
    if (source_.size < kLegacyBytes)
      return refuse(name_, fmt::format("ends within its header, after {} bytes: the file is cut off", source_.size));
    header_bytes_ = at<std::uint16_t>(94);
    header_.minor_version = at<std::uint8_t>(25);
    if (at<std::uint8_t>(24) != 1 || header_.minor_version > 4)
      return refuse(name_, fmt::format("is of LAS version {}.{}, and Scarp reads 1.0 to 1.4", at<std::uint8_t>(24),
                                       header_.minor_version));
    const std::uint64_t least = header_.minor_version >= 4 ? kBytesOf14 : kLegacyBytes;
    if (header_bytes_ < least)
      return refuse(name_, fmt::format("has a header of {} bytes, and version 1.{} needs {}", header_bytes_,
                                       header_.minor_version, least));
    header_.points_offset = at<std::uint32_t>(96);
    if (header_.points_offset < header_bytes_)
      return refuse(name_, fmt::format("its points begin at byte {}, within its header", header_.points_offset));
    if (header_.points_offset > source_.size || source_.size < least)
      return refuse(name_, fmt::format("ends at byte {}, and its points begin at byte {}: the file is cut off",
                                       source_.size, header_.points_offset));
    return {};
  }

  Result<void> check_numbers() {
    const unsigned format = at<std::uint8_t>(104);
    is_compressed_ = (format & 0xC0) != 0;  // either bit, depending on the compressor's version
    header_.point_format = format & 0x3F;
    header_.record_bytes = at<std::uint16_t>(105);
    if (header_.point_format >= kFormats)
      return refuse(
          name_, fmt::format("has points of format {}, and Scarp reads 0 to {}", header_.point_format, kFormats - 1));
    if (header_.record_bytes < kRecordBytes[header_.point_format])
      return refuse(name_, fmt::format("has records of {} bytes, and points of format {} need {}", header_.record_bytes,
                                       header_.point_format, kRecordBytes[header_.point_format]));
    header_.points = at<std::uint32_t>(107);
    if (header_.minor_version >= 4 && at<std::uint64_t>(247) != 0) header_.points = at<std::uint64_t>(247);
    for (std::size_t k = 0; k < 3; ++k) {
      header_.scale[k] = at<double>(131 + 8 * k);
      header_.offset[k] = at<double>(155 + 8 * k);
      header_.most[k] = at<double>(179 + 16 * k);
      header_.least[k] = at<double>(187 + 16 * k);
      const double reach = std::abs(header_.scale[k]) * 0x1p31 + std::abs(header_.offset[k]);
      if (header_.scale[k] == 0 || !std::isfinite(reach))
        return refuse(name_, fmt::format("its {} cannot be known: the scale is {} and the offset {}", "xyz"[k],
                                         header_.scale[k], header_.offset[k]));
    }
    return {};
  }

  Result<void> read_records() {
    const std::uint64_t count = at<std::uint32_t>(100);
    std::uint64_t offset = header_bytes_;
    for (std::uint64_t k = 0; k < count; ++k) {
      if (offset + kRecordHead > header_.points_offset || !read_into(offset, kRecordHead))
        return refuse(
            name_,
            fmt::format("announces {} records of variable length, and has room for {} before its points", count, k));
      const auto id = at<std::uint16_t>(18);
      const std::uint64_t size = at<std::uint16_t>(20);
      const std::string user = text_of(std::span(bytes_).subspan(2, 16));
      offset += kRecordHead;
      if (size > header_.points_offset - offset)
        return refuse(name_,
                      fmt::format("its record {} of variable length has {} bytes, and {} are left before its points", k,
                                  size, header_.points_offset - offset));
      SCARP_RETURN_IF_ERROR(keep(user, id, offset, size));
      offset += size;
    }
    return {};
  }

  /// Reads the WKT stored after the points (LAS 1.4 only). A file without WKT is accepted.
  Result<void> read_extended_records() {
    if (header_.minor_version < 4 || !header_.crs.wkt.empty()) return {};
    if (!read_into(0, kBytesOf14)) return {};
    std::uint64_t offset = at<std::uint64_t>(235);
    const std::uint32_t count = at<std::uint32_t>(243);
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!source_.holds(offset, kExtendedRecordHead) || !read_into(offset, kExtendedRecordHead)) return {};
      const auto id = at<std::uint16_t>(18);
      const auto size = at<std::uint64_t>(20);
      const std::string user = text_of(std::span(bytes_).subspan(2, 16));
      offset += kExtendedRecordHead;
      if (!source_.holds(offset, size)) return {};
      constexpr std::uint64_t kMost = 1 << 20;
      if (id == kWkt && size <= kMost) {
        SCARP_RETURN_IF_ERROR(keep(user, id, offset, size));
      }
      offset += size;
    }
    return {};
  }

  Result<void> keep(const std::string& user, std::uint16_t id, std::uint64_t offset, std::uint64_t size) {
    constexpr std::uint16_t kDirectory = 34735, kDoubles = 34736, kTexts = 34737, kLaz = 22204;
    CrsFacts& crs = header_.crs;
    const bool is_of_place = user == "LASF_Projection";
    std::vector<std::uint8_t>* const place = is_of_place && id == kDirectory          ? &crs.directory
                                             : is_of_place && id == kDoubles          ? &crs.doubles
                                             : is_of_place && id == kTexts            ? &crs.texts
                                             : user == "laszip encoded" && id == kLaz ? &laz_
                                                                                      : nullptr;
    const bool is_wkt = is_of_place && id == kWkt;
    if (place == nullptr && !is_wkt) return {};
    if (!read_into(offset, size)) return refuse(name_, "cannot be read");
    if (is_wkt) {
      crs.wkt = text_of(bytes_);
    } else {
      *place = bytes_;
    }
    return {};
  }

  Result<void> check_room() {
    if (header_.laz) return {};
    const std::uint64_t room = (source_.size - header_.points_offset) / header_.record_bytes;
    if (header_.points > room)
      return refuse(name_,
                    fmt::format("announces {} points, and has room for {}: the file is cut off", header_.points, room));
    return {};
  }

  bool read_into(std::uint64_t offset, std::uint64_t count) {
    if (!source_.holds(offset, count)) return false;
    bytes_.assign(count, 0);
    return source_.read(offset, bytes_);
  }

  static constexpr std::uint16_t kWkt = 2112;
  const Source& source_;
  const std::string& name_;
  Header header_;
  std::vector<std::uint8_t> laz_;  ///< the record about compression
  std::vector<std::uint8_t> bytes_;
  std::uint64_t header_bytes_ = 0;
  bool is_compressed_ = false;
};

}  // namespace

Result<Header> read_header(const Source& source) { return HeaderReader(source).read(); }

}  // namespace scarp::las
