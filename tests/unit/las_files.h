// Writes LAS and LAZ files of known points for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "las/point.h"
#include "las/point_contexts.h"
#include "unit/range_encoder.h"

namespace scarp::testing {

using Bytes = std::vector<std::uint8_t>;

template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
  if (bytes.size() < at + sizeof value) bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// A point with the fields of all formats; `channel` and the following fields are only in formats 6 to 10.
struct FilePoint {
  las::LasPoint point;
  std::uint8_t channel = 0;
  bool has_new_time = false;

  std::uint8_t returns(bool is_extended) const {
    return static_cast<std::uint8_t>(point.return_number | point.return_count << (is_extended ? 4 : 3));
  }
  std::uint8_t flags() const {
    return static_cast<std::uint8_t>((point.is_withheld ? 4 : 0) | (point.is_overlap ? 8 : 0));
  }
  std::uint8_t class_byte() const { return static_cast<std::uint8_t>(point.number | (point.is_withheld ? 128 : 0)); }
};

struct VariableRecord {
  std::string user;
  std::uint16_t id = 0;
  Bytes bytes;
};

struct LasFile {
  std::uint8_t minor_version = 2, format = 0;
  std::uint16_t extra_bytes = 0;
  std::array<double, 3> scale{0.01, 0.01, 0.01}, offset{0, 0, 0};
  std::vector<VariableRecord> records;
  std::vector<FilePoint> points;

  std::uint16_t record_bytes() const { return static_cast<std::uint16_t>(las::kRecordBytes[format] + extra_bytes); }
  bool is_extended() const { return las::is_extended(format); }

  Bytes record(const FilePoint& of) const {
    Bytes bytes(record_bytes());
    put(bytes, 0, of.point.x);
    put(bytes, 4, of.point.y);
    put(bytes, 8, of.point.z);
    bytes[14] = of.returns(is_extended());
    bytes[15] = is_extended() ? static_cast<std::uint8_t>(of.flags() | of.channel << 4) : of.class_byte();
    if (is_extended()) bytes[16] = of.point.number;
    return bytes;
  }

  /// The header and the records after it. `compressed`: sets the bit of LAZ.
  Bytes head(bool compressed = false) const {
    Bytes bytes(minor_version == 4 ? 375 : minor_version == 3 ? 235 : 227);
    std::memcpy(bytes.data(), "LASF", 4);
    bytes[24] = 1;
    bytes[25] = minor_version;
    put(bytes, 94, static_cast<std::uint16_t>(bytes.size()));
    put(bytes, 100, static_cast<std::uint32_t>(records.size()));
    bytes[104] = static_cast<std::uint8_t>(format | (compressed ? 128 : 0));
    put(bytes, 105, record_bytes());
    if (minor_version < 4) put(bytes, 107, static_cast<std::uint32_t>(points.size()));
    if (minor_version == 4) put(bytes, 247, static_cast<std::uint64_t>(points.size()));
    for (std::size_t k = 0; k < 3; ++k) {
      put(bytes, 131 + 8 * k, scale[k]);
      put(bytes, 155 + 8 * k, offset[k]);
    }
    for (const VariableRecord& record : records) {
      const std::size_t at = bytes.size();
      bytes.resize(at + 54);
      std::memcpy(bytes.data() + at + 2, record.user.data(), record.user.size());
      put(bytes, at + 18, record.id);
      put(bytes, at + 20, static_cast<std::uint16_t>(record.bytes.size()));
      bytes.insert(bytes.end(), record.bytes.begin(), record.bytes.end());
    }
    put(bytes, 96, static_cast<std::uint32_t>(bytes.size()));
    return bytes;
  }

  Bytes las() const {
    Bytes bytes = head();
    for (const FilePoint& of : points) {
      const Bytes one = record(of);
      bytes.insert(bytes.end(), one.begin(), one.end());
    }
    return bytes;
  }
};

/// The statistics of one chunk of formats 0 to 5: POINT10 and BYTE; the other fields as if they never changed.
class PointwiseChunk {
 public:
  explicit PointwiseChunk(const LasFile& file) : file_(file) {}

  Bytes encode(std::size_t first, std::size_t end) {
    Bytes bytes = file_.record(file_.points[first]);
    last_ = file_.points[first];
    for (std::size_t k = first + 1; k < end; ++k) {
      add(file_.points[k]);
      add_others();
    }
    const Bytes stream = encoder_.finish();
    bytes.insert(bytes.end(), stream.begin(), stream.end());
    return bytes;
  }

 private:
  using Model = RangeEncoder::Model;
  Model& model(int kind, std::uint32_t context, std::uint32_t symbols) {
    return models_.try_emplace({kind, context}, symbols).first->second;
  }

  void add(const FilePoint& now) {
    const std::uint32_t returns = now.returns(false), last_returns = last_.returns(false);
    const std::uint32_t changes =
        (returns != last_returns ? 32U : 0U) | (now.class_byte() != last_.class_byte() ? 8U : 0U);
    encoder_.encode(model(0, 0, 64), changes);
    if ((changes & 32) != 0) encoder_.encode(model(1, last_returns, 256), returns);
    if ((changes & 8) != 0) encoder_.encode(model(2, last_.class_byte(), 256), now.class_byte());
    const std::uint32_t r = returns & 7, n = returns >> 3, single = n == 1 ? 1 : 0;
    const std::size_t context = las::kLegacyReturnContexts[n][r];
    const std::int32_t x = now.point.x - last_.point.x, y = now.point.y - last_.point.y;
    x_.encode(encoder_, x_medians_[context].get(), x, single);
    x_medians_[context].add(x);
    y_.encode(encoder_, y_medians_[context].get(), y, single + (std::min(x_.k, 20U) & ~1U));
    y_medians_[context].add(y);
    std::int32_t& height = heights_[las::return_level(n, r)];
    z_.encode(encoder_, height, now.point.z, single + (std::min((x_.k + y_.k) / 2, 18U) & ~1U));
    height = now.point.z;
    last_ = now;
  }

  void add_others() {
    const bool has_time = file_.format == 1 || file_.format >= 3;
    if (has_time) encoder_.encode(model(3, 0, 6), 0);
    if (file_.format == 2 || file_.format == 3 || file_.format == 5) encoder_.encode(model(4, 0, 128), 0);
    if (file_.format >= 4) {
      encoder_.encode(model(5, 0, 256), 0);
      encoder_.encode(model(6, 0, 4), 0);
      for (IntegerEncoder* part : {&size_, &return_point_}) part->encode(encoder_, 0, 0, 0);
      for (std::uint32_t axis = 0; axis < 3; ++axis) direction_.encode(encoder_, 0, 0, axis);
    }
    for (std::uint32_t k = 0; k < file_.extra_bytes; ++k) encoder_.encode(model(7, k, 256), 0);
  }

  const LasFile& file_;
  RangeEncoder encoder_;
  FilePoint last_;
  std::map<std::pair<int, std::uint32_t>, Model> models_;
  IntegerEncoder x_{32}, y_{32}, z_{32}, size_{32}, return_point_{32}, direction_{32};
  std::array<las::RunningMedian, 16> x_medians_, y_medians_;
  std::array<std::int32_t, 8> heights_{};
};

/// The same for formats 6 to 10: the layers of places, heights, classes and flags.
class LayeredChunk {
 public:
  explicit LayeredChunk(const LasFile& file) : file_(file) {}

  Bytes encode(std::size_t first, std::size_t end) {
    Bytes bytes = file_.record(file_.points[first]);
    now_ = file_.points[first].channel;
    begin(now_, file_.points[first]);
    for (std::size_t k = first + 1; k < end; ++k) add(file_.points[k]);
    put(bytes, bytes.size(), static_cast<std::uint32_t>(end - first));
    const std::size_t others = (file_.format == 7                         ? 1
                                : file_.format == 8 || file_.format == 10 ? 2
                                                                          : 0) +
                               (file_.format >= 9 ? 1 : 0) + file_.extra_bytes;
    std::array<Bytes, 4> layers;
    for (std::size_t k = 0; k < 4; ++k) layers[k] = encoders_[k].finish();
    for (const Bytes& layer : layers) put(bytes, bytes.size(), static_cast<std::uint32_t>(layer.size()));
    bytes.resize(bytes.size() + 4 * (5 + others));
    for (const Bytes& layer : layers) bytes.insert(bytes.end(), layer.begin(), layer.end());
    return bytes;
  }

 private:
  using Model = RangeEncoder::Model;
  struct Channel {
    bool is_begun = false;
    FilePoint last;
    bool had_new_time = false;
    std::map<std::pair<int, std::uint32_t>, Model> models;
    IntegerEncoder x{32}, y{32}, z{32};
    std::array<las::RunningMedian, 12> x_medians, y_medians;
    std::array<std::int32_t, 8> heights{};

    Model& model(int kind, std::uint32_t context, std::uint32_t symbols) {
      return models.try_emplace({kind, context}, symbols).first->second;
    }
  };

  void begin(std::size_t k, const FilePoint& last) {
    channels_[k] = Channel();
    channels_[k].is_begun = true;
    channels_[k].last = last;
    channels_[k].heights.fill(last.point.z);
  }

  void add(const FilePoint& now) {
    RangeEncoder& places = encoders_[0];
    Channel& before = channels_[now_];
    const las::LasPoint& old = before.last.point;
    const bool changes_channel = now.channel != now_;
    if (!channels_[now.channel].is_begun) begin(now.channel, before.last);
    Channel& channel = channels_[now.channel];
    las::LasPoint& last = channel.last.point;
    const std::uint32_t n = now.point.return_count, r = now.point.return_number, last_r = last.return_number;
    const std::uint32_t step = r == last_r ? 0 : r == ((last_r + 1) & 15) ? 1 : r == ((last_r + 15) & 15) ? 2 : 3;
    const std::uint32_t changes =
        (changes_channel ? 64U : 0U) | (now.has_new_time ? 16U : 0U) | (n != last.return_count ? 4U : 0U) | step;
    const std::uint32_t context = (old.return_number == 1 ? 1U : 0U) +
                                  (old.return_number >= old.return_count ? 2U : 0U) + (before.had_new_time ? 4U : 0U);
    places.encode(before.model(0, context, 128), changes);
    if (changes_channel)
      places.encode(before.model(1, 0, 3), (now.channel + 3U - static_cast<std::uint32_t>(now_)) & 3);
    now_ = now.channel;
    if (n != last.return_count) places.encode(channel.model(2, last.return_count, 16), n);
    if (step == 3 && now.has_new_time) places.encode(channel.model(3, last_r, 16), r);
    if (step == 3 && !now.has_new_time) places.encode(channel.model(4, 0, 13), (r + 14 - last_r) & 15);
    add_place(channel, now);
    const bool is_single = r == 1 && r >= n;
    encoders_[2].encode(channel.model(5, (last.number & 31U) * 2 + (is_single ? 1 : 0), 256), now.point.number);
    encoders_[3].encode(channel.model(6, channel.last.flags(), 64), now.flags());
    channel.last = now;
    channel.had_new_time = now.has_new_time;
  }

  void add_place(Channel& channel, const FilePoint& now) {
    const std::uint32_t n = now.point.return_count, r = now.point.return_number, single = n == 1 ? 1 : 0;
    const std::size_t context = 2U * las::kExtendedReturnContexts[n][r] + (now.has_new_time ? 1 : 0);
    const std::int32_t x = now.point.x - channel.last.point.x, y = now.point.y - channel.last.point.y;
    channel.x.encode(encoders_[0], channel.x_medians[context].get(), x, single);
    channel.x_medians[context].add(x);
    channel.y.encode(encoders_[0], channel.y_medians[context].get(), y, single + (std::min(channel.x.k, 20U) & ~1U));
    channel.y_medians[context].add(y);
    std::int32_t& height = channel.heights[las::return_level(n, r)];
    channel.z.encode(encoders_[1], height, now.point.z,
                     single + (std::min((channel.x.k + channel.y.k) / 2, 18U) & ~1U));
    height = now.point.z;
  }

  const LasFile& file_;
  std::array<RangeEncoder, 4> encoders_;
  std::array<Channel, 4> channels_;
  std::size_t now_ = 0;
};

/// LAZ with chunks that end before the points `ends`; the last chunk ends with the points. `is_varying`: the table has
/// the number of points of each chunk; else all chunks have as many as the first.
inline Bytes make_laz(LasFile file, const std::vector<std::size_t>& ends, bool is_varying) {
  const std::uint16_t version = file.is_extended() ? 3 : 2;
  VariableRecord record{"laszip encoded", 22204, Bytes(34)};
  put(record.bytes, 0, static_cast<std::uint16_t>(file.is_extended() ? 3 : 2));
  put(record.bytes, 12, is_varying ? 0xFFFFFFFFU : static_cast<std::uint32_t>(ends.empty() ? 50000 : ends.front()));
  std::uint16_t items = 0;
  const auto add_item = [&](std::uint16_t type, std::uint16_t bytes) {
    put(record.bytes, 32, ++items);
    for (const std::uint16_t value : {type, bytes, version}) put(record.bytes, record.bytes.size(), value);
  };
  const unsigned format = file.format;
  add_item(file.is_extended() ? 10 : 6, file.is_extended() ? 30 : 20);
  if (format == 1 || (format >= 3 && format <= 5)) add_item(7, 8);
  if (format == 2 || format == 3 || format == 5) add_item(8, 6);
  if (format == 7) add_item(11, 6);
  if (format == 8 || format == 10) add_item(12, 8);
  if (format == 4 || format == 5) add_item(9, 29);
  if (format >= 9) add_item(13, 29);
  if (file.extra_bytes > 0) add_item(file.is_extended() ? 14 : 0, file.extra_bytes);
  file.records.push_back(record);

  Bytes bytes = file.head(true);
  const std::size_t place = bytes.size();
  bytes.resize(place + 8);
  RangeEncoder table;
  IntegerEncoder numbers(32);
  std::size_t first = 0, chunks = 0;
  std::int32_t last_points = 0, last_bytes = 0;
  std::vector<std::size_t> all = ends;
  if (all.empty() || all.back() < file.points.size()) all.push_back(file.points.size());
  for (const std::size_t end : all) {
    if (end == first) continue;
    const Bytes chunk =
        file.is_extended() ? LayeredChunk(file).encode(first, end) : PointwiseChunk(file).encode(first, end);
    const auto points = static_cast<std::int32_t>(end - first), size = static_cast<std::int32_t>(chunk.size());
    if (is_varying) numbers.encode(table, last_points, points, 0);
    numbers.encode(table, last_bytes, size, 1);
    last_points = points;
    last_bytes = size;
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    first = end;
    ++chunks;
  }
  put(bytes, place, static_cast<std::uint64_t>(bytes.size()));
  put(bytes, bytes.size(), std::uint32_t{0});
  put(bytes, bytes.size(), static_cast<std::uint32_t>(chunks));
  const Bytes stream = table.finish();
  bytes.insert(bytes.end(), stream.begin(), stream.end());
  return bytes;
}

/// Keys of GeoTIFF: pairs of a key and its value.
inline VariableRecord geo_keys(const std::vector<std::pair<std::uint16_t, std::uint16_t>>& keys) {
  VariableRecord record{"LASF_Projection", 34735, {}};
  const auto add = [&](std::uint16_t value) { put(record.bytes, record.bytes.size(), value); };
  for (const std::size_t value : {std::size_t{1}, std::size_t{1}, std::size_t{0}, keys.size()})
    add(static_cast<std::uint16_t>(value));
  for (const auto& [key, value] : keys) {
    for (const std::uint16_t word : {key, std::uint16_t{0}, std::uint16_t{1}, value}) add(word);
  }
  return record;
}

}  // namespace scarp::testing
