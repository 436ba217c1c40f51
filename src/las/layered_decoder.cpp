// Points of formats 6 to 10: the LASzip specification's POINT14, versions 3 and 4. A chunk contains its first point,
// its number of points, the sizes of the layers, and the layers: a stream for each field. Only the first four layers
// are read, for positions, returns, classes and flags. In a layer without bytes, the field never changes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "las/bytes.h"
#include "las/chunk_decoder.h"
#include "las/integer_decoder.h"
#include "las/point.h"
#include "las/point_contexts.h"
#include "las/range_decoder.h"

namespace scarp::las {
namespace {

constexpr unsigned kEvenBits = 0xFFFFFFFEU;

/// Statistics and the last point of one of the scanner's channels.
struct Channel {
  bool is_begun = false;
  std::int32_t x = 0, y = 0, z = 0;
  std::uint8_t r = 0, n = 0, number = 0;
  std::uint8_t flags = 0;  ///< bits 0 to 3: classification flags, 4: scan direction, 5: edge of the flight line
  bool has_new_time = false;

  std::array<SymbolModel<128>, 8> changes;
  SymbolModel<3> channel;
  ModelSet<16, 16> counts, returns;
  SymbolModel<13> returns_at_same_time;
  ModelSet<256, 64> classes;
  ModelSet<64, 64> flag_models;
  IntegerDecoder<32, 2> dx;
  IntegerDecoder<32, 22> dy;
  IntegerDecoder<32, 20> heights;
  std::array<RunningMedian, 12> x_medians, y_medians;
  std::array<std::int32_t, 8> last_heights{};

  void copy_point(const Channel& other) {
    x = other.x;
    y = other.y;
    z = other.z;
    r = other.r;
    n = other.n;
    number = other.number;
    flags = other.flags;
  }

  /// Call it after setting the fields of the last point.
  void begin() {
    is_begun = true;
    has_new_time = false;
    for (auto& model : changes) model.begin(128);
    channel.begin(3);
    counts.forget();
    returns.forget();
    returns_at_same_time.begin(13);
    classes.forget();
    flag_models.forget();
    dx.forget();
    dy.forget();
    heights.forget();
    x_medians = {};
    y_medians = {};
    last_heights.fill(z);
  }

  LasPoint point() const { return extended_point(x, y, z, static_cast<unsigned>(n) << 4 | r, flags & 15U, number); }
};

/// The streams that are read. A stream without bytes is absent.
struct Layers {
  RangeDecoder places;
  std::optional<RangeDecoder> heights, classes, flags;

  bool are_exhausted() const {
    const auto is_exhausted = [](const std::optional<RangeDecoder>& layer) { return layer && layer->is_exhausted(); };
    return places.is_exhausted() || is_exhausted(heights) || is_exhausted(classes) || is_exhausted(flags);
  }
};

class LayeredDecoder final : public ChunkDecoder {
 public:
  explicit LayeredDecoder(const LazRecord& record) : first_bytes_(record.point_bytes()) {
    layer_count_ = 0;
    for (const LazItem& item : record.items) {
      layer_count_ += item.type == LazItemType::kPoint14    ? 9
                      : item.type == LazItemType::kRgbNir14 ? 2
                      : item.type == LazItemType::kByte14   ? item.bytes
                                                            : 1;
    }
  }

  bool decode(std::span<const std::uint8_t> bytes, std::uint64_t count, EmitPoints emit) override {
    if (bytes.size() < first_bytes_) return false;
    begin(bytes.data());
    std::array<LasPoint, 1024> points;
    points[0] = decode_record(bytes.data(), true);
    std::size_t size = 1;
    std::optional<Layers> layers;
    if (count > 1) {
      layers = find_layers(bytes);
      if (!layers) return false;
    }
    for (std::uint64_t k = 1; k < count; ++k) {
      if (size == points.size()) {
        emit(points);
        size = 0;
      }
      points[size++] = decode_point(*layers);
      if (layers->are_exhausted()) return false;
    }
    emit(std::span(points).first(size));
    return true;
  }

 private:
  void begin(const std::uint8_t* first) {
    for (Channel& channel : channels_) channel.is_begun = false;
    const unsigned returns = first[14], flags = first[15];
    now_ = flags >> 4 & 3;
    Channel& channel = channels_[now_];
    channel.x = load<std::int32_t>(first);
    channel.y = load<std::int32_t>(first + 4);
    channel.z = load<std::int32_t>(first + 8);
    channel.r = returns & 15;
    channel.n = returns >> 4 & 15;
    channel.number = first[16];
    channel.flags = static_cast<std::uint8_t>((flags & 15) | (flags >> 2 & 0x30));
    channel.begin();
  }

  /// Nothing if the layers exceed the chunk.
  std::optional<Layers> find_layers(std::span<const std::uint8_t> bytes) const {
    const std::uint64_t sizes_at = first_bytes_ + 4;
    std::uint64_t at = sizes_at + 4 * layer_count_;
    if (at > bytes.size()) return std::nullopt;
    std::array<std::optional<RangeDecoder>, 4> read;
    for (std::size_t k = 0; k < read.size(); ++k) {
      const auto size = load<std::uint32_t>(bytes.data() + sizes_at + 4 * k);
      if (size > bytes.size() - at) return std::nullopt;
      if (size > 0) read[k] = RangeDecoder(bytes.subspan(at, size));
      at += size;
    }
    if (!read[0]) return std::nullopt;
    return Layers{*read[0], read[1], read[2], read[3]};
  }

  /// A new channel begins with the last point of the previous one.
  Channel& switch_channel(RangeDecoder& places) {
    const Channel& last = channels_[now_];
    now_ = (now_ + places.decode(channels_[now_].channel) + 1) & 3;
    Channel& next = channels_[now_];
    if (!next.is_begun) {
      next.copy_point(last);
      next.begin();
    }
    return next;
  }

  static unsigned decode_return(Channel& channel, unsigned change, bool has_new_time, RangeDecoder& places) {
    const unsigned last = channel.r;
    if (change == 0) return last;
    if (change == 1) return (last + 1) & 15;
    if (change == 2) return (last + 15) & 15;
    if (has_new_time) return places.decode(channel.returns[last]);
    return (last + 2 + places.decode(channel.returns_at_same_time)) & 15;
  }

  LasPoint decode_point(Layers& layers) {
    RangeDecoder& places = layers.places;
    const Channel& last = channels_[now_];
    const unsigned context = (last.r == 1 ? 1U : 0U) + (last.r >= last.n ? 2U : 0U) + (last.has_new_time ? 4U : 0U);
    const unsigned changes = places.decode(channels_[now_].changes[context]);
    Channel& channel = (changes & 64) != 0 ? switch_channel(places) : channels_[now_];
    const bool has_new_time = (changes & 16) != 0;
    if ((changes & 4) != 0) channel.n = static_cast<std::uint8_t>(places.decode(channel.counts[channel.n]));
    channel.r = static_cast<std::uint8_t>(decode_return(channel, changes & 3, has_new_time, places));
    channel.has_new_time = has_new_time;
    decode_place(channel, layers);

    const bool is_single = channel.r == 1 && channel.r >= channel.n;
    if (layers.classes) {
      auto& model = channel.classes[(channel.number & 31U) * 2 + (is_single ? 1 : 0)];
      channel.number = static_cast<std::uint8_t>(layers.classes->decode(model));
    }
    if (layers.flags)
      channel.flags = static_cast<std::uint8_t>(layers.flags->decode(channel.flag_models[channel.flags]));
    return channel.point();
  }

  static void decode_place(Channel& channel, Layers& layers) {
    const auto move = [](std::int32_t& place, std::int32_t way) {
      place = static_cast<std::int32_t>(static_cast<std::uint32_t>(place) + static_cast<std::uint32_t>(way));
    };
    const unsigned n = channel.n, r = channel.r, is_single = n == 1 ? 1 : 0;
    const unsigned context = 2U * kExtendedReturnContexts[n][r] + (channel.has_new_time ? 1 : 0);
    const std::int32_t x = channel.dx.decode(layers.places, channel.x_medians[context].get(), is_single);
    move(channel.x, x);
    channel.x_medians[context].add(x);
    const std::int32_t y = channel.dy.decode(layers.places, channel.y_medians[context].get(),
                                             is_single + (std::min(channel.dx.k(), 20U) & kEvenBits));
    move(channel.y, y);
    channel.y_medians[context].add(y);
    if (!layers.heights) return;
    const unsigned bits = std::min((channel.dx.k() + channel.dy.k()) / 2, 18U) & kEvenBits;
    std::int32_t& height = channel.last_heights[return_level(n, r)];
    channel.z = height = channel.heights.decode(*layers.heights, height, is_single + bits);
  }

  std::size_t first_bytes_, layer_count_;
  std::array<Channel, 4> channels_;
  unsigned now_ = 0;
};

}  // namespace

std::unique_ptr<ChunkDecoder> make_layered_decoder(const LazRecord& record) {
  return std::make_unique<LayeredDecoder>(record);
}

}  // namespace scarp::las
