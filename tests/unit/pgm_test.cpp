#include "io/raster/pgm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scarp {
namespace {

std::vector<std::uint8_t> pgm_bytes(const std::string& text) { return {text.begin(), text.end()}; }

/// The error's message; it must be kInput and begin with the file's name.
std::string refusal(const std::string& text, const ReadOptions& options = {}) {
  const auto read = io::decode_pgm(pgm_bytes(text), "hill.pgm", options);
  if (read) return "read";
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  EXPECT_EQ(read.error().message.rfind("hill.pgm", 0), 0u) << read.error().message;
  return read.error().message;
}

void expect_refusal(const std::string& text, const std::string& part) {
  const std::string message = refusal(text);
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Pgm, PlainWithCommentsEverywhere) {
  const auto read = io::decode_pgm(
      pgm_bytes("P2# a\n#b\r\n 3 # width\n2#height\n#x\n900#max\n1 2 3\n# between\n400 500#end\n900"), "hill.pgm");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->cols, 3);
  EXPECT_EQ(read->rows, 2);
  EXPECT_EQ(read->samples, (std::vector<float>{1, 2, 3, 400, 500, 900}));
  EXPECT_EQ(read->info.format, "PGM");
  EXPECT_EQ(read->info.sample_type, "UInt16");
  EXPECT_EQ(read->info.valid, 6u);
  EXPECT_EQ(read->info.min, 1);
  EXPECT_EQ(read->info.max, 900);
  EXPECT_EQ(read->sample_rounding, 0);
  EXPECT_EQ(read->frame.kind, Frame::Kind::kGrid);
  EXPECT_EQ(read->frame.apply_affine(0, 0), (std::array<double, 2>{0, 1}));
}

TEST(Pgm, RawBytesAndWords) {
  std::string narrow = "P5 2 2 255\n";
  narrow += {'\x00', '\x0a', '\x20', '\xff'};  // a newline and a space are samples here
  auto read = io::decode_pgm(pgm_bytes(narrow), "hill.pgm");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->samples, (std::vector<float>{0, 10, 32, 255}));
  EXPECT_EQ(read->info.sample_type, "Byte");

  std::string wide = "P5 2 2 65535 ";
  wide += {'\x01', '\x02', '\x00', '\x00', '\xff', '\xff', '#', '\n'};  // no comments among samples
  read = io::decode_pgm(pgm_bytes(wide), "hill.pgm");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->samples, (std::vector<float>{258, 0, 65535, 35 * 256 + 10}));
}

TEST(Pgm, NodataOnlyIfAskedFor) {
  ReadOptions options;
  options.nodata = 7;
  auto read = io::decode_pgm(pgm_bytes("P2 2 2 9 7 1 2 3"), "hill.pgm", options);
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(read->samples[0]));
  EXPECT_EQ(read->info.valid, 3u);
  EXPECT_EQ(read->info.nodata, 7.0);
  EXPECT_NE(refusal("P2 2 2 9 7 7 7 7", options).find("all are nodata"), std::string::npos);
}

TEST(Pgm, RefusesWhatIsWrong) {
  expect_refusal("P6 2 2 255 xxxx", "not a PGM");
  expect_refusal("P2 2", "header");
  expect_refusal("P2 2 -2 9 1 1 1 1", "header");
  expect_refusal("P2 2 2 0 1 1 1 1", "maxval");
  expect_refusal("P2 2 2 65536 1 1 1 1", "maxval");
  expect_refusal("P2 2 2 9 1 1 1 10", "sample (1, 1) is 10, above the header's maxval 9");
  expect_refusal("P2 2 2 9 1 1 x 1", "sample (0, 1)");
  expect_refusal("P2 2 2 9 1 1  1 ", "sample (1, 1) is missing");
  expect_refusal("P2 2 2 9 1 1 1", "truncated");
  expect_refusal("P2 2 2 9 1 1 1 1 1", "after the last sample");
  expect_refusal("P5 2 2 9\n\x01\x01\x01", "truncated");
  expect_refusal("P5 2 2 9\n\x01\x01\x01\x0a", "maxval 9");
  expect_refusal("P5 2 2 9\n\x01\x01\x01\x01P5 2 2 9", "follow the last sample");
  expect_refusal("P5 2000000000 2000000000 255\nabc", "truncated");
  expect_refusal("P2 2147483647 2147483647 255\n1 2 3", "truncated");
  expect_refusal("P2 99999999999999999999 2 255\n1 2 3", "header");
  expect_refusal("P2 1 3 9 1 2 3", "2 x 2");
  expect_refusal("P2 3 1 9 1 2 3", "2 x 2");
  expect_refusal("P2 0 0 9 ", "2 x 2");
  EXPECT_EQ(refusal("P5 2 2 9\n\x01\x01\x01\x01\n"), "read") << "a newline at the end is no damage";
}

TEST(Pgm, RefusesOptionsThatNeedMore) {
  ReadOptions options;
  options.crs = "EPSG:32611";
  auto read = io::decode_pgm(pgm_bytes("P2 2 2 9 1 2 3 4"), "hill.pgm", options);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::kUsage);
  EXPECT_NE(read.error().message.find("EPSG:32611"), std::string::npos);
  options = {};
  options.band = 2;
  EXPECT_NE(refusal("P2 2 2 9 1 2 3 4", options).find("no band 2"), std::string::npos);
  options = {};
  options.decode = Decode::kMapbox;
  EXPECT_NE(refusal("P2 2 2 9 1 2 3 4", options).find("3 or 4 bands"), std::string::npos);
  options = {};
  options.run.memory.limit = 19;
  EXPECT_NE(refusal("P2 2 2 9 1 2 3 4", options).find("memory"), std::string::npos);
}

TEST(Pgm, SurvivesCutsAndMutations) {
  std::string plain = "P2 # c\n4 3\n300\n", raw = "P5 4 3 300\n";
  for (int k = 0; k < 12; ++k) {
    plain += std::to_string(k * 25) + " ";
    raw += static_cast<char>(k * 25 / 256);
    raw += static_cast<char>(k * 25 % 256);
  }
  std::mt19937 random(7);
  int read_count = 0;
  for (const std::string& whole : {plain, raw}) {
    for (std::size_t size = 0; size < whole.size() - 1; ++size) {
      const auto cut = io::decode_pgm(pgm_bytes(whole.substr(0, size)), "cut.pgm");
      // A plain file may end within its last number.
      EXPECT_TRUE(!cut || (whole == plain && size + 4 > whole.size())) << size;
    }
    for (int turn = 0; turn < 20000; ++turn) {
      std::string mutated = whole;
      for (auto n = random() % 3 + 1; n > 0; --n) mutated[random() % mutated.size()] = static_cast<char>(random());
      const auto read = io::decode_pgm(pgm_bytes(mutated), "mutated.pgm");
      if (!read) continue;
      ++read_count;
      ASSERT_EQ(read->samples.size(), static_cast<std::size_t>(read->cols) * static_cast<std::size_t>(read->rows));
      ASSERT_GE(read->cols, 2);
      ASSERT_GE(read->rows, 2);
      ASSERT_LE(read->info.max, 65535);
    }
  }
  EXPECT_GT(read_count, 100) << "mutations of samples must still read";
}

}  // namespace
}  // namespace scarp
