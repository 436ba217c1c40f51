// Heights packed into red, green and blue.
//
//   terrarium:  R·256 + G + B/256 − 32768            steps of 1/256 m: exact in float32
//   mapbox:     −10000 + (R·65536 + G·256 + B)·0.1   steps of 0.1 m: rounded to float32, the rounding recorded
//
// Both compute a height from one integer, 24 bits in three colours. A colour that exceeds its largest value wraps
// around, and the next higher colour increases by one. There, interpolation or lossy compression of colours makes
// heights jump. Two tests detect such jumps:
//
//   - Lossy compression changes a colour by one, which causes spikes of about one colour step. Spikes of real land
//     cross colour steps no more often than their size implies.
//   - Interpolation passes through all values of a colour that wraps around. Between two close samples on opposite
//     sides of such a height, a sample then differs from both in 40 % of cases or more, sometimes below and sometimes
//     above. Real land does not depend on the wraps: it is equally rough at heights a quarter, a half and three
//     quarters of a step above them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "io/gdal/read_samples.h"

namespace scarp::gdal {
namespace {

double decode_height(Decode decode, const std::uint8_t* rgb) {
  if (decode == Decode::kTerrarium) return rgb[0] * 256 + rgb[1] + rgb[2] / 256.0 - 32768;
  return -10000 + (rgb[0] * 65536 + rgb[1] * 256 + rgb[2]) * 0.1;
}

Decode other_than(Decode decode) { return decode == Decode::kTerrarium ? Decode::kMapbox : Decode::kTerrarium; }

/// Land and the sea floor.
bool is_on_earth(double height) { return height >= -11500 && height <= 9500; }

constexpr std::uint32_t kNoNumber = ~std::uint32_t{0};
constexpr std::array kColourBits{8, 16};

std::uint32_t number_of(const std::uint8_t* rgb) {
  return static_cast<std::uint32_t>(rgb[0]) << 16 | static_cast<std::uint32_t>(rgb[1]) << 8 | rgb[2];
}

/// Counts the middle one of three neighbours if it differs from both others and these are close to each other. On
/// unmodified land, spikes of that size cross a colour step in somewhat more than half of all cases.
void count_torn(std::uint32_t a, std::uint32_t b, std::uint32_t c, Findings::Colours& colours) {
  const auto [low, high] = std::minmax(a, c);
  const std::uint32_t off = b < low ? low - b : b > high ? b - high : 0;
  for (std::size_t k = 0; off > 0 && k < kColourBits.size(); ++k) {
    const std::uint32_t step = std::uint32_t{1} << kColourBits[k];
    if (off < step / 4 || off >= step + step / 2 || high - low >= step / 4) continue;
    const bool changes = (a ^ b) >= step || (b ^ c) >= step;
    ++(changes ? colours.torn : colours.whole)[k];
    if (changes) colours.most[k] = std::max(colours.most[k], off);
  }
}

/// The interval between examined rows: 1 for a tile; larger for a large raster, to limit the samples.
std::int64_t every_row(int cols, int rows) { return 1 + std::int64_t{cols} * rows / (1 << 18); }

constexpr std::array<std::size_t, 2> kLags{1, 4};  // the second one detects enlargement by more than three

/// If the outer two of three samples are close, counts the middle one at each quarter of a colour step between them.
void count_lines(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t lag, std::size_t first_colour,
                 Findings::Colours& colours) {
  const auto [low, high] = std::minmax(a, c);
  for (std::size_t k = first_colour; k < kColourBits.size(); ++k) {
    const std::uint32_t step = std::uint32_t{1} << kColourBits[k];
    const int quarter = kColourBits[k] - 2;
    const std::uint32_t first = low >> quarter, last = high >> quarter;
    if (first == last || high - low >= step / 2) continue;
    const std::uint32_t off = b < low ? low - b : b > high ? b - high : 0;
    const bool is_off = off >= step / 8 && off < step;
    for (std::uint32_t line = first + 1; line <= last; ++line) {
      Findings::Colours::Line& here = colours.lines[lag][k][line & 3U];
      ++here.crossed;
      if (!is_off) continue;
      ++here.off;
      if ((line & 3U) != 0) continue;
      colours.farthest[lag][k] = std::max(colours.farthest[lag][k], off);
      ++colours.sides[lag][k][line >> 2 & 7U][b < low ? 0 : 1];
    }
  }
}

/// In terrarium, a step of the middle colour is 1 m, and heights in whole metres change only by such steps.
std::size_t first_colour(Decode decode) { return decode == Decode::kTerrarium ? 1 : 0; }

/// True if more samples differ at a colour's wraps than on real land.
bool are_swept(const Findings::Colours& colours, std::size_t lag, std::size_t k) {
  constexpr std::uint64_t kLeast = 24;
  constexpr double kLeastShare = 0.35, kTimesOthers = 1.5, kLeastBoth = 0.16;
  const auto& lines = colours.lines[lag][k];
  const auto share = [](const Findings::Colours::Line& line) {
    return line.crossed == 0 ? 0 : static_cast<double>(line.off) / static_cast<double>(line.crossed);
  };
  double others = 0;
  for (std::size_t k = 1; k < lines.size(); ++k) others = std::max(others, share(lines[k]));
  if (lines[0].off < kLeast || share(lines[0]) < std::max(kLeastShare, kTimesOthers * others)) return false;
  // Spikes above a plain, or noise around it, only differ towards the plain.
  std::uint64_t both = 0;
  for (const auto& [below, above] : colours.sides[lag][k]) both += 2 * std::min(below, above);
  return static_cast<double>(both) >= kLeastBoth * static_cast<double>(lines[0].crossed);
}

/// The nodata colour: every band's declared value.
std::optional<std::array<std::uint8_t, 3>> find_nodata_colour(GDALDatasetH dataset) {
  std::array<std::uint8_t, 3> colour{};
  for (int k = 0; k < 3; ++k) {
    int declared = 0;
    const double value = GDALGetRasterNoDataValue(GDALGetRasterBand(dataset, k + 1), &declared);
    if (!declared || !(value >= 0 && value <= 255) || std::floor(value) != value) return {};
    colour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

class PackedReader : public WindowReader {
 public:
  PackedReader(GDALDatasetH dataset, const ReadOptions& options)
      : dataset_(dataset),
        decode_(options.decode),
        z_scale_(options.z_scale),
        z_offset_(options.z_offset),
        nodata_(options.nodata),
        bands_(GDALGetRasterCount(dataset)),
        red_(GDALGetRasterBand(dataset, 1)),
        masked_(bands_ == 3 && (GDALGetMaskFlags(red_) & GMF_PER_DATASET) != 0),
        nodata_colour_(options.nodata ? std::nullopt : find_nodata_colour(dataset)),
        every_(every_row(GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset))) {}

  bool read(const Window& w, float* out, std::ptrdiff_t stride) override {
    const auto count = static_cast<std::size_t>(w.cols) * static_cast<std::size_t>(w.rows);
    const auto depth = static_cast<std::size_t>(bands_);
    pixels_.resize(count * depth);
    if (GDALDatasetRasterIOEx(dataset_, GF_Read, w.col, w.row, w.cols, w.rows, pixels_.data(), w.cols, w.rows, GDT_Byte,
                              bands_, nullptr, bands_, static_cast<GSpacing>(bands_) * w.cols, 1, nullptr) != CE_None) {
      return false;
    }
    if (masked_) {
      mask_.resize(count);
      if (GDALRasterIOEx(GDALGetMaskBand(red_), GF_Read, w.col, w.row, w.cols, w.rows, mask_.data(), w.cols, w.rows,
                         GDT_Byte, 0, 0, nullptr) != CE_None) {
        return false;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto row = static_cast<std::ptrdiff_t>(k / static_cast<std::size_t>(w.cols));
      const auto col = static_cast<std::ptrdiff_t>(k % static_cast<std::size_t>(w.cols));
      const std::uint8_t* rgb = pixels_.data() + k * depth;
      const float height = height_of(rgb, masked_ && mask_[k] == 0);
      out[row * stride + col] = height;
      if (col == 0) before_ = here_ = kNoNumber;
      look_at_colour(rgb, std::isnan(height) ? kNoNumber : number_of(rgb));
      if (col == w.cols - 1 && (w.row + row) % every_ == 0) look_at_row(pixels_.data() + (k + 1) * depth, w.cols);
    }
    return true;
  }

 private:
  /// `end`: end of the row's pixels.
  void look_at_row(const std::uint8_t* end, int cols) {
    row_.clear();
    for (const std::uint8_t* rgb = end - std::ptrdiff_t{cols} * bands_; rgb != end; rgb += bands_)
      row_.push_back(number_of(rgb) == 0 || (bands_ == 4 && rgb[3] == 0) ? kNoNumber : number_of(rgb));
    for (std::size_t lag = 0; lag < kLags.size(); ++lag) {
      const std::size_t apart = kLags[lag];
      for (std::size_t k = 2 * apart; k < row_.size(); ++k) {
        const std::uint32_t a = row_[k - 2 * apart], b = row_[k - apart], c = row_[k];
        if (a == kNoNumber || b == kNoNumber || c == kNoNumber) continue;
        count_lines(a, b, c, lag, first_colour(decode_), findings_.colours);
      }
    }
  }

  void look_at_colour(const std::uint8_t* rgb, std::uint32_t number) {
    Findings::Colours& colours = findings_.colours;
    if (before_ != kNoNumber && here_ != kNoNumber && number != kNoNumber) count_torn(before_, here_, number, colours);
    before_ = std::exchange(here_, number);
    if (number == kNoNumber || number == 0) return;
    ++colours.valid;
    colours.on_earth += is_on_earth(decode_height(decode_, rgb)) ? 1 : 0;
    colours.on_earth_otherwise += is_on_earth(decode_height(other_than(decode_), rgb)) ? 1 : 0;
  }

  float height_of(const std::uint8_t* rgb, bool is_masked) {
    const double height = decode_height(decode_, rgb);
    const bool is_nodata = (bands_ == 4 && rgb[3] == 0) || is_masked ||
                           (nodata_colour_ && std::equal(rgb, rgb + 3, nodata_colour_->begin())) ||
                           (nodata_ && static_cast<float>(*nodata_) == static_cast<float>(height));
    if (is_nodata) return std::numeric_limits<float>::quiet_NaN();
    const double scaled = z_scale_ * height + z_offset_;
    const auto z = static_cast<float>(scaled);
    findings_.rounding = std::max(findings_.rounding, std::abs(scaled - static_cast<double>(z)));
    return z;
  }

  GDALDatasetH dataset_;
  Decode decode_;
  double z_scale_, z_offset_;
  std::optional<double> nodata_;
  int bands_;
  GDALRasterBandH red_;
  bool masked_;
  std::optional<std::array<std::uint8_t, 3>> nodata_colour_;
  std::vector<std::uint8_t> pixels_, mask_;
  std::uint32_t before_ = kNoNumber, here_ = kNoNumber;  // the last two in the row
  std::vector<std::uint32_t> row_;
  std::int64_t every_;  // interval between rows examined as a whole
};

}  // namespace

void Findings::Colours::add(const Colours& further) {
  valid += further.valid;
  on_earth += further.on_earth;
  on_earth_otherwise += further.on_earth_otherwise;
  for (std::size_t k = 0; k < torn.size(); ++k) {
    torn[k] += further.torn[k];
    whole[k] += further.whole[k];
    most[k] = std::max(most[k], further.most[k]);
    for (std::size_t lag = 0; lag < lines.size(); ++lag) {
      farthest[lag][k] = std::max(farthest[lag][k], further.farthest[lag][k]);
      for (std::size_t line = 0; line < lines[lag][k].size(); ++line) {
        lines[lag][k][line].crossed += further.lines[lag][k][line].crossed;
        lines[lag][k][line].off += further.lines[lag][k][line].off;
      }
      for (std::size_t line = 0; line < sides[lag][k].size(); ++line) {
        for (std::size_t side = 0; side < 2; ++side) sides[lag][k][line][side] += further.sides[lag][k][line][side];
      }
    }
  }
}

void doubt_colours(const Findings& findings, Decode decode, const std::string& loss, RasterInfo& info) {
  constexpr std::uint64_t kLeastTorn = 24, kTimesWhole = 12;
  const Findings::Colours& colours = findings.colours;
  if (decode == Decode::kNone) return;
  const auto name = [](Decode d) { return d == Decode::kTerrarium ? "terrarium" : "mapbox"; };
  if (2 * colours.on_earth < colours.valid && 2 * colours.on_earth_otherwise > colours.valid) {
    info.packed.seems = name(other_than(decode));
    info.warnings.push_back(fmt::format(
        "decoded as {}, {} of {} heights are none on earth, and as {} they are: give "
        "--decode {} if these are such tiles",
        name(decode), colours.valid - colours.on_earth, colours.valid, info.packed.seems, info.packed.seems));
    return;
  }
  for (std::size_t k = first_colour(decode); k < kColourBits.size(); ++k) {
    std::uint64_t torn = 0;
    std::uint32_t most = 0;
    const auto take = [&](std::uint64_t samples, std::uint32_t farthest) {
      torn = std::max(torn, samples);
      most = std::max(most, farthest);
    };
    if (colours.torn[k] > kLeastTorn + kTimesWhole * colours.whole[k]) take(colours.torn[k], colours.most[k]);
    for (std::size_t lag = 0; lag < kLags.size(); ++lag) {
      if (are_swept(colours, lag, k)) take(colours.lines[lag][k][0].off, colours.farthest[lag][k]);
    }
    const double step = decode == Decode::kTerrarium ? 1.0 / 256 : 0.1;
    info.packed.torn += torn;
    info.packed.torn_by = std::max(info.packed.torn_by, step * most);
  }
  if (info.packed.torn == 0) {
    if (!loss.empty())
      info.warnings.push_back(
          fmt::format("the colours are compressed with a loss ({}), which changes the heights packed into them by any "
                      "amount: take tiles as they were made (PNG, lossless WebP)",
                      loss));
    return;
  }
  info.warnings.push_back(fmt::format(
      "{} samples jump by up to {:.6g} m and back where a colour begins anew, as colours do that were "
      "interpolated or compressed with a loss: take tiles as they were made (PNG, lossless WebP), and resample "
      "their heights, not their colours (gdalwarp -r near)",
      info.packed.torn, info.packed.torn_by));
}

std::string find_loss(GDALDatasetH dataset) {
  constexpr const char* kStructure = "IMAGE_STRUCTURE";
  const char* compression = GDALGetMetadataItem(dataset, "COMPRESSION", kStructure);
  const char* reversibility = GDALGetMetadataItem(dataset, "COMPRESSION_REVERSIBILITY", kStructure);
  const std::string_view name = compression != nullptr ? compression : "";
  const bool is_jpeg = name == "JPEG" || name == "YCbCr JPEG";
  const bool is_lossy = reversibility != nullptr && std::string_view(reversibility).starts_with("LOSSY");
  return is_jpeg || is_lossy ? std::string(name) : "";
}

Result<void> verify_packed(GDALDatasetH dataset, const std::string& path) {
  const int count = GDALGetRasterCount(dataset);
  bool bytes = count == 3 || count == 4;
  for (int k = 1; bytes && k <= count; ++k) bytes = GDALGetRasterDataType(GDALGetRasterBand(dataset, k)) == GDT_Byte;
  if (bytes) return {};
  return fail(
      ErrorKind::kInput,
      fmt::format("{}: heights packed into colours need 3 or 4 bands of bytes, and this raster has {} of type {}", path,
                  count, GDALGetDataTypeName(GDALGetRasterDataType(GDALGetRasterBand(dataset, 1)))));
}

std::unique_ptr<WindowReader> make_packed_reader(GDALDatasetH dataset, const ReadOptions& options) {
  return std::make_unique<PackedReader>(dataset, options);
}

}  // namespace scarp::gdal
