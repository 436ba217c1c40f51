#include "base/radix_sort.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <span>

#include "base/sort.h"

namespace scarp {
namespace {

RC_GTEST_PROP(radix_sort, is_a_stable_sort_of_any_keys, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint32_t>());
  const std::uint64_t mask = *rc::gen::element<std::uint64_t>(0, 7, 0xff00, 0xffffffff, ~std::uint64_t{0});
  std::vector<std::pair<std::uint64_t, std::size_t>> items(*rc::gen::element<std::size_t>(0, 1, 100, 128, 129, 3000));
  for (std::size_t k = 0; k < items.size(); ++k) items[k] = {random() & mask, k};
  auto sorted = items;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  radix_sort(items, [](const auto& item) { return item.first; });
  RC_ASSERT(items == sorted);
}

RC_GTEST_PROP(sort_rarely, is_a_stable_sort_of_a_part, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint32_t>());
  const std::uint64_t mask = *rc::gen::element<std::uint64_t>(0, 7, ~std::uint64_t{0});
  std::vector<std::pair<std::uint64_t, std::uint16_t>> items(*rc::gen::inRange<std::size_t>(0, 300));
  for (std::size_t k = 0; k < items.size(); ++k) items[k] = {random() & mask, static_cast<std::uint16_t>(k)};
  auto sorted = items;
  const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
  const auto middle = static_cast<std::ptrdiff_t>(items.size() / 2);
  std::stable_sort(sorted.begin() + middle, sorted.end(), before);
  std::span part(items.begin() + middle, items.end());
  sort_rarely(part, before);
  RC_ASSERT(items == sorted);
}

TEST(radix_sort, points_come_in_raster_order_each_once) {
  std::vector<Point> points{{3, 1}, {0, 2}, {3, 1}, {5, 0}, {0, 2}, {2, 1}};
  sort_uniquely(points);
  EXPECT_EQ(points, (std::vector<Point>{{5, 0}, {2, 1}, {3, 1}, {0, 2}}));
}

}  // namespace
}  // namespace scarp
