// Points of formats 0 to 5: the LASzip specification's POINT10, GPSTIME11, RGB12, WAVEPACKET13 and BYTE, in versions 1
// and 2. All items of a point share a stream, so unneeded items are decoded, too, but only to advance in the stream:
// times, colours and intensities are not computed.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "las/bytes.h"
#include "las/chunk_decoder.h"
#include "las/integer_decoder.h"
#include "las/point.h"
#include "las/point_contexts.h"
#include "las/range_decoder.h"

namespace scarp::las {
namespace {

constexpr unsigned kLeadingBits = 0xFFFFFFFEU;  // contexts of differences do not distinguish bit counts 2k and 2k + 1

/// An item of a point after the item with its position.
class Item {
 public:
  virtual ~Item() = default;
  virtual void begin() = 0;
  virtual void skip(RangeDecoder& decoder) = 0;
};

/// The item with positions, classes and returns.
class PositionItem {
 public:
  virtual ~PositionItem() = default;
  /// The first point is not compressed.
  virtual void begin(const std::uint8_t* first) = 0;
  virtual LasPoint decode(RangeDecoder& decoder) = 0;
};

/// Values of the last point that determine contexts for the next point.
struct LastPoint {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint8_t returns = 0, class_byte = 0, user_data = 0;

  explicit LastPoint(const std::uint8_t* record)
      : x(load<std::int32_t>(record)),
        y(load<std::int32_t>(record + 4)),
        z(load<std::int32_t>(record + 8)),
        returns(record[14]),
        class_byte(record[15]),
        user_data(record[17]) {}
  LastPoint() = default;

  LasPoint point() const { return legacy_point(x, y, z, returns, class_byte); }
  /// Coordinates wrap around.
  static void move(std::int32_t& place, std::int32_t way) {
    place = static_cast<std::int32_t>(static_cast<std::uint32_t>(place) + static_cast<std::uint32_t>(way));
  }
};

class Point10V2 final : public PositionItem {
 public:
  void begin(const std::uint8_t* first) override {
    last_ = LastPoint(first);
    changes_.begin(64);
    for (auto& model : angles_) model.begin(256);
    returns_.forget();
    classes_.forget();
    user_data_.forget();
    x_.forget();
    y_.forget();
    z_.forget();
    intensity_.forget();
    source_.forget();
    x_medians_ = {};
    y_medians_ = {};
    heights_ = {};
  }

  LasPoint decode(RangeDecoder& decoder) override {
    const unsigned changes = decoder.decode(changes_);
    if ((changes & 32) != 0) last_.returns = static_cast<std::uint8_t>(decoder.decode(returns_[last_.returns]));
    const unsigned r = last_.returns & 7, n = last_.returns >> 3 & 7;
    const unsigned context = kLegacyReturnContexts[n][r];
    if ((changes & 16) != 0) intensity_.decode(decoder, 0, std::min(context, 3U));
    if ((changes & 8) != 0) last_.class_byte = static_cast<std::uint8_t>(decoder.decode(classes_[last_.class_byte]));
    if ((changes & 4) != 0) decoder.decode(angles_[last_.returns >> 6 & 1]);
    if ((changes & 2) != 0) last_.user_data = static_cast<std::uint8_t>(decoder.decode(user_data_[last_.user_data]));
    if ((changes & 1) != 0) source_.decode(decoder, 0, 0);

    const unsigned is_single = n == 1 ? 1 : 0;
    const std::int32_t x = x_.decode(decoder, x_medians_[context].get(), is_single);
    LastPoint::move(last_.x, x);
    x_medians_[context].add(x);
    const std::int32_t y =
        y_.decode(decoder, y_medians_[context].get(), is_single + (std::min(x_.k(), 20U) & kLeadingBits));
    LastPoint::move(last_.y, y);
    y_medians_[context].add(y);
    const unsigned bits = std::min((x_.k() + y_.k()) / 2, 18U) & kLeadingBits;
    std::int32_t& height = heights_[return_level(n, r)];
    last_.z = height = z_.decode(decoder, height, is_single + bits);
    return last_.point();
  }

 private:
  LastPoint last_;
  SymbolModel<64> changes_;
  std::array<SymbolModel<256>, 2> angles_;
  ModelSet<256, 256> returns_, classes_, user_data_;
  IntegerDecoder<32, 2> x_;
  IntegerDecoder<32, 22> y_;
  IntegerDecoder<32, 20> z_;
  IntegerDecoder<16, 4> intensity_;
  IntegerDecoder<16, 1> source_;
  std::array<RunningMedian, 16> x_medians_, y_medians_;
  std::array<std::int32_t, 8> heights_{};
};

/// The median of the last three values.
class LastThree {
 public:
  std::int32_t median() const {
    const auto [a, b, c] = values_;
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
  void add(std::int32_t value) {
    values_[next_] = value;
    next_ = (next_ + 1) % 3;
  }

 private:
  std::array<std::int32_t, 3> values_{};
  std::size_t next_ = 0;
};

class Point10V1 final : public PositionItem {
 public:
  void begin(const std::uint8_t* first) override {
    last_ = LastPoint(first);
    changes_.begin(64);
    returns_.forget();
    classes_.forget();
    user_data_.forget();
    x_.forget();
    y_.forget();
    z_.forget();
    intensity_.forget();
    angle_.forget();
    source_.forget();
    x_ways_ = {};
    y_ways_ = {};
  }

  LasPoint decode(RangeDecoder& decoder) override {
    const std::int32_t x = x_.decode(decoder, x_ways_.median(), 0);
    LastPoint::move(last_.x, x);
    const std::int32_t y = y_.decode(decoder, y_ways_.median(), std::min(x_.k(), 19U));
    LastPoint::move(last_.y, y);
    const unsigned bits = (x_.k() + y_.k()) / 2;
    last_.z = z_.decode(decoder, last_.z, std::min(bits, 19U));
    x_ways_.add(x);
    y_ways_.add(y);

    const unsigned changes = decoder.decode(changes_);
    if ((changes & 32) != 0) intensity_.decode(decoder, 0, 0);
    if ((changes & 16) != 0) last_.returns = static_cast<std::uint8_t>(decoder.decode(returns_[last_.returns]));
    if ((changes & 8) != 0) last_.class_byte = static_cast<std::uint8_t>(decoder.decode(classes_[last_.class_byte]));
    if ((changes & 4) != 0) angle_.decode(decoder, 0, bits < 3 ? 1 : 0);
    if ((changes & 2) != 0) last_.user_data = static_cast<std::uint8_t>(decoder.decode(user_data_[last_.user_data]));
    if ((changes & 1) != 0) source_.decode(decoder, 0, 0);
    return last_.point();
  }

 private:
  LastPoint last_;
  SymbolModel<64> changes_;
  ModelSet<256, 256> returns_, classes_, user_data_;
  IntegerDecoder<32, 1> x_;
  IntegerDecoder<32, 20> y_, z_;
  IntegerDecoder<16, 1> intensity_, source_;
  IntegerDecoder<8, 2> angle_;
  LastThree x_ways_, y_ways_;
};

/// The unit of time differences. After four differences that are not encodable multiples, the last one becomes the
/// unit.
struct TimeUnit {
  std::int32_t difference = 0;
  int extremes = 0;

  void note_extreme(std::int32_t now) {
    if (++extremes <= 3) return;
    difference = now;
    extremes = 0;
  }
  std::int32_t times(int factor) const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(difference) * static_cast<std::uint32_t>(factor));
  }
};

class GpsTime11V1 final : public Item {
 public:
  void begin() override {
    unit_ = {};
    first_.begin(3);
    factors_.begin(512);
    time_.forget();
  }

  void skip(RangeDecoder& decoder) override {
    if (unit_.difference == 0) {
      const unsigned kind = decoder.decode(first_);
      if (kind == 1) unit_.difference = time_.decode(decoder, 0, 0);
      if (kind == 2) skip_double(decoder);
      return;
    }
    constexpr unsigned kMostFactor = 509, kDouble = 510;
    const unsigned factor = decoder.decode(factors_);
    if (factor == kDouble) skip_double(decoder);
    if (factor > kMostFactor) return;
    if (factor == 1) {
      unit_ = {time_.decode(decoder, unit_.difference, 1), 0};
    } else if (factor == 0) {
      unit_.note_extreme(time_.decode(decoder, unit_.difference / 4, 2));
    } else {
      const std::int32_t difference = time_.decode(decoder, unit_.times(static_cast<int>(factor)),
                                                   factor < 10   ? 3
                                                   : factor < 50 ? 4
                                                                 : 5);
      if (factor == kMostFactor) unit_.note_extreme(difference);
    }
  }

 private:
  static void skip_double(RangeDecoder& decoder) {
    for (int k = 0; k < 4; ++k) decoder.decode_bits(16);
  }

  TimeUnit unit_;
  SymbolModel<3> first_;
  SymbolModel<512> factors_;
  IntegerDecoder<32, 6> time_;
};

/// Four sequences of times, each with its unit, for alternating points of flight lines.
class GpsTime11V2 final : public Item {
 public:
  void begin() override {
    units_ = {};
    now_ = newest_ = 0;
    first_.begin(6);
    factors_.begin(kFactors);
    time_.forget();
  }

  void skip(RangeDecoder& decoder) override {
    for (int k = 0; k < 4; ++k) {  // one change of the sequence is enough for any encoder
      const unsigned change = units_[now_].difference == 0 ? skip_first(decoder) : skip_multiple(decoder);
      if (change == 0) return;
      now_ = (now_ + change) & 3;
    }
  }

 private:
  static constexpr int kMost = 500, kLeast = -10;
  static constexpr unsigned kUnchanged = kMost - kLeast + 1, kNewSequence = kUnchanged + 1, kFactors = kUnchanged + 5;

  /// Returns the distance to the time's sequence; 0 if the time has been decoded.
  unsigned skip_first(RangeDecoder& decoder) {
    const unsigned kind = decoder.decode(first_);
    if (kind > 2) return kind - 2;
    if (kind == 1) units_[now_] = {time_.decode(decoder, 0, 0), 0};
    if (kind == 2) start_sequence(decoder);
    return 0;
  }

  unsigned skip_multiple(RangeDecoder& decoder) {
    const unsigned symbol = decoder.decode(factors_);
    if (symbol > kNewSequence) return symbol - kNewSequence;
    if (symbol == kNewSequence) start_sequence(decoder);
    if (symbol >= kUnchanged) return 0;
    TimeUnit& unit = units_[now_];
    const int factor = static_cast<int>(symbol) <= kMost ? static_cast<int>(symbol) : kMost - static_cast<int>(symbol);
    const bool is_extreme = factor == 0 || factor == kMost || factor == kLeast;
    const unsigned context = factor == 1        ? 1
                             : factor == 0      ? 7
                             : factor == kMost  ? 4
                             : factor == kLeast ? 6
                             : factor < 0       ? 5
                             : factor < 10      ? 2
                                                : 3;
    const std::int32_t difference = time_.decode(decoder, unit.times(factor), context);
    if (factor == 1) unit.extremes = 0;
    if (is_extreme) unit.note_extreme(difference);
    return 0;
  }

  void start_sequence(RangeDecoder& decoder) {
    time_.decode(decoder, 0, 8);
    decoder.decode_bits(16);
    decoder.decode_bits(16);
    now_ = newest_ = (newest_ + 1) & 3;
    units_[now_] = {};
  }

  std::array<TimeUnit, 4> units_{};
  unsigned now_ = 0, newest_ = 0;
  SymbolModel<6> first_;
  SymbolModel<kFactors> factors_;
  IntegerDecoder<32, 9> time_;
};

class Rgb12V1 final : public Item {
 public:
  void begin() override {
    used_.begin(64);
    byte_.forget();
  }
  void skip(RangeDecoder& decoder) override {
    const unsigned used = decoder.decode(used_);
    for (unsigned k = 0; k < 6; ++k) {
      if ((used >> k & 1) != 0) byte_.decode(decoder, 0, k);
    }
  }

 private:
  SymbolModel<64> used_;
  IntegerDecoder<8, 6> byte_;
};

class Rgb12V2 final : public Item {
 public:
  void begin() override {
    used_.begin(128);
    for (auto& model : bytes_) model.begin(256);
  }
  void skip(RangeDecoder& decoder) override {
    const unsigned used = decoder.decode(used_);
    const bool is_grey = (used & 64) == 0;
    for (const unsigned k : {0U, 1U, 2U, 4U, 3U, 5U}) {  // both bytes of red, then the low ones, then the high ones
      if ((used >> k & 1) != 0 && (k < 2 || !is_grey)) decoder.decode(bytes_[k]);
    }
  }

 private:
  SymbolModel<128> used_;
  std::array<SymbolModel<256>, 6> bytes_;
};

class WavePacket13 final : public Item {
 public:
  void begin() override {
    index_.begin(256);
    for (auto& model : places_) model.begin(4);
    place_ = 0;
    offset_.forget();
    size_.forget();
    return_point_.forget();
    direction_.forget();
  }
  void skip(RangeDecoder& decoder) override {
    decoder.decode(index_);
    place_ = decoder.decode(places_[place_]);
    if (place_ == 2) offset_.decode(decoder, 0, 0);
    for (int k = 0; place_ == 3 && k < 4; ++k) decoder.decode_bits(16);
    size_.decode(decoder, 0, 0);
    return_point_.decode(decoder, 0, 0);
    for (unsigned axis = 0; axis < 3; ++axis) direction_.decode(decoder, 0, axis);
  }

 private:
  SymbolModel<256> index_;
  std::array<SymbolModel<4>, 4> places_;
  unsigned place_ = 0;
  IntegerDecoder<32, 1> offset_, size_, return_point_;
  IntegerDecoder<32, 3> direction_;
};

class Bytes final : public Item {
 public:
  explicit Bytes(std::size_t count) : models_(count) {}
  void begin() override {
    for (auto& model : models_) model.begin(256);
  }
  void skip(RangeDecoder& decoder) override {
    for (auto& model : models_) decoder.decode(model);
  }

 private:
  std::vector<SymbolModel<256>> models_;
};

std::unique_ptr<Item> make_item(const LazItem& item) {
  switch (item.type) {
    case LazItemType::kGpsTime11:
      if (item.version == 1) return std::make_unique<GpsTime11V1>();
      return std::make_unique<GpsTime11V2>();
    case LazItemType::kRgb12:
      if (item.version == 1) return std::make_unique<Rgb12V1>();
      return std::make_unique<Rgb12V2>();
    case LazItemType::kWavePacket13:
      return std::make_unique<WavePacket13>();
    default:
      return std::make_unique<Bytes>(item.bytes);
  }
}

class PointwiseDecoder final : public ChunkDecoder {
 public:
  explicit PointwiseDecoder(const LazRecord& record) : first_bytes_(record.point_bytes()) {
    position_ = record.items.front().version == 1 ? std::unique_ptr<PositionItem>(std::make_unique<Point10V1>())
                                                  : std::make_unique<Point10V2>();
    for (std::size_t k = 1; k < record.items.size(); ++k) items_.push_back(make_item(record.items[k]));
  }

  bool decode(std::span<const std::uint8_t> bytes, std::uint64_t count, EmitPoints emit) override {
    if (bytes.size() < first_bytes_) return false;
    position_->begin(bytes.data());
    for (const auto& item : items_) item->begin();
    std::array<LasPoint, 1024> points;
    points[0] = decode_record(bytes.data(), false);
    std::size_t size = 1;
    if (count > 1 && bytes.size() < first_bytes_ + 4) return false;
    RangeDecoder decoder(bytes.subspan(first_bytes_));
    for (std::uint64_t k = 1; k < count; ++k) {
      if (size == points.size()) {
        emit(points);
        size = 0;
      }
      points[size++] = position_->decode(decoder);
      for (const auto& item : items_) item->skip(decoder);
      if (decoder.is_exhausted()) return false;
    }
    emit(std::span(points).first(size));
    return true;
  }

 private:
  std::size_t first_bytes_;
  std::unique_ptr<PositionItem> position_;
  std::vector<std::unique_ptr<Item>> items_;
};

}  // namespace

std::unique_ptr<ChunkDecoder> make_pointwise_decoder(const LazRecord& record) {
  return std::make_unique<PointwiseDecoder>(record);
}

}  // namespace scarp::las
