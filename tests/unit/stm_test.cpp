#include "io/raster/stm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scarp {
namespace {

std::vector<std::uint8_t> stm(const std::string& head, std::initializer_list<int> order,
                              const std::vector<int>& heights) {
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  for (const int byte : order) bytes.push_back(static_cast<std::uint8_t>(byte));
  bytes.push_back('\n');
  const bool big = *order.begin() == 4;
  for (const int z : heights) {
    bytes.push_back(static_cast<std::uint8_t>(big ? z >> 8 : z & 255));
    bytes.push_back(static_cast<std::uint8_t>(big ? z & 255 : z >> 8));
  }
  return bytes;
}

std::string refusal(const std::vector<std::uint8_t>& bytes) {
  const auto read = io::decode_stm(bytes, "hill.stm");
  if (read) return "read";
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  EXPECT_EQ(read.error().message.rfind("hill.stm", 0), 0u) << read.error().message;
  return read.error().message;
}

TEST(Stm, BothByteOrders) {
  for (const auto order : {std::initializer_list<int>{4, 3, 2, 1}, std::initializer_list<int>{1, 2, 3, 4}}) {
    const auto read = io::decode_stm(stm("STM 3 2 ", order, {1, 258, 3, 65535, 40000, 6}), "hill.stm");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->cols, 3);
    EXPECT_EQ(read->rows, 2);
    EXPECT_EQ(read->samples[1], 258);
    EXPECT_TRUE(std::isnan(read->samples[3]));
    EXPECT_EQ(read->samples[4], 40000);
    EXPECT_EQ(read->info.valid, 5u);
    EXPECT_EQ(read->info.nodata, 65535.0);
    EXPECT_EQ(read->info.format, "STM");
    EXPECT_EQ(read->frame.kind, Frame::Kind::kGrid);
  }
}

TEST(Stm, AnotherNodataMakes65535AHeight) {
  ReadOptions options;
  options.nodata = 6;
  const auto read = io::decode_stm(stm("STM 2 2 ", {4, 3, 2, 1}, {1, 65535, 3, 6}), "hill.stm", options);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->samples[1], 65535);
  EXPECT_TRUE(std::isnan(read->samples[3]));
}

TEST(Stm, RefusesWhatIsWrong) {
  EXPECT_NE(refusal(stm("STX 2 2 ", {4, 3, 2, 1}, {1, 2, 3, 4})).find("not an STM"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 2 ", {4, 3, 2, 1}, {1, 2, 3, 4})).find("header"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 2 2 ", {4, 2, 3, 1}, {1, 2, 3, 4})).find("byte order is 04 02 03 01"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 2 2 ", {4, 3, 2, 1}, {1, 2, 3})).find("truncated"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 2 2 ", {4, 3, 2, 1}, {1, 2, 3, 4, 5})).find("not what its header says"),
            std::string::npos);
  EXPECT_NE(refusal(stm("STM 2147483647 2147483647 ", {4, 3, 2, 1}, {1})).find("truncated"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 99999999999 2 ", {4, 3, 2, 1}, {1})).find("header"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 1 3 ", {4, 3, 2, 1}, {1, 2, 3})).find("2 x 2"), std::string::npos);
  EXPECT_NE(refusal(stm("STM 2 2 ", {4, 3, 2, 1}, {65535, 65535, 65535, 65535})).find("all are nodata"),
            std::string::npos);
}

TEST(Stm, SurvivesCutsAndMutations) {
  const auto whole = stm("STM 4 3 ", {4, 3, 2, 1}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(io::decode_stm(std::span(whole).first(size), "cut.stm")) << size;
  }
  std::mt19937 random(11);
  int read_count = 0;
  for (int turn = 0; turn < 40000; ++turn) {
    auto mutated = whole;
    for (auto n = random() % 3 + 1; n > 0; --n)
      mutated[random() % mutated.size()] = static_cast<std::uint8_t>(random());
    const auto read = io::decode_stm(mutated, "mutated.stm");
    if (!read) continue;
    ++read_count;
    ASSERT_EQ(read->samples.size(), 12u);
  }
  EXPECT_GT(read_count, 100);
}

}  // namespace
}  // namespace scarp
