// Heights packed into colours that were modified or read with the wrong encoding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "unit/raster_files.h"

namespace scarp::packed_colours_test {
namespace {

constexpr int kSide = 128;
using Colours = std::vector<double>;  // red, green and blue, row by row, as fractions
using Heights = std::function<double(double x, double y)>;

double land(double x, double y) { return 700 + 100 * std::sin(x / 40) * std::cos(y / 45) + std::sin(x * 1.7); }

std::uint32_t number_of(Decode decode, double height) {
  const double steps = decode == Decode::kTerrarium ? (height + 32768) * 256 : (height + 10000) * 10;
  return static_cast<std::uint32_t>(std::lround(steps));
}

/// The colours of kSide × kSide samples, `step` samples apart.
Colours pack(Decode decode, const Heights& heights, double step = 1) {
  Colours colours;
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const std::uint32_t number = number_of(decode, heights(col * step, row * step));
      for (const int bits : {16, 8, 0}) colours.push_back((number >> bits) & 255U);
    }
  }
  return colours;
}

/// Doubles the columns: new columns are means of two old ones, colour by colour.
Colours interpolate(const Colours& colours) {
  Colours wide = colours;
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      for (int k = 0; k < 3; ++k) {
        const auto at = [&](int c) { return colours[static_cast<std::size_t>((row * kSide + c) * 3 + k)]; };
        wide[static_cast<std::size_t>((row * kSide + col) * 3 + k)] = (at(col / 2) + at((col + 1) / 2)) / 2;
      }
    }
  }
  return wide;
}

RasterInfo read(Decode as, const Colours& colours) {
  const testing::ScratchFolder folder;
  std::vector<std::uint8_t> bands;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = k; i < colours.size(); i += 3) bands.push_back(static_cast<std::uint8_t>(colours[i]));
  }
  testing::write_envi(folder.file("tile.img"), kSide, kSide, bands);
  ReadOptions options;
  options.decode = as;
  const auto read = read_height_field(folder.file("tile.img"), options);
  EXPECT_TRUE(read) << read.error().message;
  return read ? read->info : RasterInfo{};
}

TEST(packed_colours, as_they_were_made_raise_no_doubt) {
  const Heights steep = [](double x, double y) {
    return 2000 + 1500 * std::sin(x * 2.1 + y * 3.7) * std::sin(y * 1.3 - x);
  };
  const Heights hills = [](double x, double y) {
    return 900 * std::sin(x / 3) * std::cos(y / 4) + 30 * std::sin(x * y);
  };
  const Heights whole = [](double x, double y) { return std::round(land(x, y)); };
  const Heights cliff = [](double x, double y) { return x > 30 + 9 * std::sin(y) ? 12 : 700; };
  const Heights sea = [](double x, double y) { return land(x, y) - 4000; };
  // Noise, with isolated extreme heights everywhere.
  const Heights forest = [](double x, double y) {
    double sum = 0;
    for (int k = 1; k <= 6; ++k) sum += std::sin(k * 1e4 * std::sin(x * 12.9898 + y * 78.233 + k));
    return 100.8 + 3 * sum;
  };
  for (const Decode decode : {Decode::kTerrarium, Decode::kMapbox}) {
    for (const Heights& heights : {Heights(land), steep, hills, whole, cliff, sea, forest}) {
      const RasterInfo info = read(decode, pack(decode, heights));
      EXPECT_EQ(info.packed.torn, 0U);
      EXPECT_EQ(info.packed.seems, "");
      EXPECT_TRUE(info.warnings.empty()) << info.warnings.front();
    }
  }
}

TEST(packed_colours, that_were_interpolated_are_told_with_their_number_and_jump) {
  for (const Decode decode : {Decode::kTerrarium, Decode::kMapbox}) {
    const RasterInfo info = read(decode, interpolate(pack(decode, land)));
    EXPECT_GE(info.packed.torn, 24U);
    EXPECT_GE(info.packed.torn_by, decode == Decode::kTerrarium ? 64 : 6.4);
    EXPECT_TRUE(testing::warns(info, "where a colour begins anew"));
  }
}

/// Interpolates each colour between the four around it, at kSide × kSide places that are `step` samples apart, then
/// rounds.
Colours resample(const Colours& colours, double step) {
  Colours made;
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const double x = col * step, y = row * step;
      const int left = static_cast<int>(x), top = static_cast<int>(y);
      for (int k = 0; k < 3; ++k) {
        const auto at = [&](int c, int r) {
          return colours[static_cast<std::size_t>((std::min(r, kSide - 1) * kSide + std::min(c, kSide - 1)) * 3 + k)];
        };
        const double above = at(left, top) + (x - left) * (at(left + 1, top) - at(left, top));
        const double below = at(left, top + 1) + (x - left) * (at(left + 1, top + 1) - at(left, top + 1));
        made.push_back(std::round(above + (y - top) * (below - above)));
      }
    }
  }
  return made;
}

TEST(packed_colours, that_were_resampled_to_any_size_are_told) {
  const Heights hills = [](double x, double y) {
    return 1200 + 900 * std::sin(x / 19) * std::cos(y / 23) + 9 * std::sin(x * 1.7 + y * 2.3);
  };
  for (const Decode decode : {Decode::kTerrarium, Decode::kMapbox}) {
    for (const double step : {0.17, 0.3, 0.7, 0.97}) {
      const RasterInfo info = read(decode, resample(pack(decode, hills), step));
      EXPECT_GE(info.packed.torn, 24U) << step;
      EXPECT_LT(info.packed.torn_by, decode == Decode::kTerrarium ? 384 : 38.4);
    }
  }
}

TEST(packed_colours, that_lossy_compression_changed_by_one_are_told) {
  for (const Decode decode : {Decode::kTerrarium, Decode::kMapbox}) {
    Colours colours = pack(decode, land);
    for (std::size_t i = 0; i < colours.size(); i += 3 * 13)
      colours[i + (decode == Decode::kTerrarium ? 0 : 1)] += colours[i + 1] > 100 ? -1 : 1;
    EXPECT_GE(read(decode, colours).packed.torn, 24U);
  }
}

TEST(packed_colours, of_the_other_encoding_are_named) {
  const RasterInfo mapbox = read(Decode::kTerrarium, pack(Decode::kMapbox, land));
  EXPECT_EQ(mapbox.packed.seems, "mapbox");
  EXPECT_TRUE(testing::warns(mapbox, "give --decode mapbox"));
  const RasterInfo terrarium = read(Decode::kMapbox, pack(Decode::kTerrarium, land));
  EXPECT_EQ(terrarium.packed.seems, "terrarium");
  EXPECT_TRUE(testing::warns(terrarium, "give --decode terrarium"));
}

TEST(packed_colours, that_are_black_stand_for_nodata) {
  for (const Decode decode : {Decode::kTerrarium, Decode::kMapbox}) {
    Colours colours = pack(decode, land);
    for (std::size_t i = 3000; i < 3090; ++i) colours[i] = 0;
    const RasterInfo info = read(decode, colours);
    ASSERT_EQ(info.undeclared_nodata.size(), 1U);
    EXPECT_EQ(info.undeclared_nodata[0].of.samples, 30U);
    EXPECT_EQ(info.undeclared_nodata[0].value, decode == Decode::kTerrarium ? -32768 : -10000);
    EXPECT_EQ(info.packed.torn, 0U);
  }
}

}  // namespace
}  // namespace scarp::packed_colours_test
