// Refusals of runs that exceed their memory.
#include "base/memory_budget.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "scarp/simplify.h"

namespace scarp {
namespace {

constexpr MemoryBudget kBudget{100'000'000, 60'000'000, 100};

TEST(a_memory_budget, refuses_nothing_without_a_limit) {
  const MemoryBudget unlimited{0, 1'000'000, 100};
  EXPECT_TRUE(unlimited.check_start(UINT64_MAX / 2));
  EXPECT_TRUE(unlimited.check_mesh(0, 1'000'000'000, 0.1));
  EXPECT_EQ(unlimited.threads_within(1'000'000'000, 64), 64);
}

TEST(a_memory_budget, lets_a_mesh_grow_up_to_what_is_left) {
  EXPECT_TRUE(kBudget.check_mesh(10'000'000, 300'000, 0.5));
  const auto refused = kBudget.check_mesh(10'000'000, 300'001, 0.5);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kMemory);
  EXPECT_NE(refused.error().message.find("300001 vertices when 50 %"), std::string::npos) << refused.error().message;
  EXPECT_NE(refused.error().message.find("about 146M"), std::string::npos) << refused.error().message;
}

TEST(a_memory_budget, begins_only_with_room_for_a_small_mesh) {
  EXPECT_TRUE(kBudget.check_start(39'900'000));
  EXPECT_FALSE(kBudget.check_start(39'900'001));
  const MemoryBudget spent{50'000'000, 60'000'000, 100};
  EXPECT_FALSE(spent.check_start(0));
}

TEST(a_memory_budget, gives_a_quarter_to_threads_and_one_thread_at_least) {
  EXPECT_EQ(kBudget.threads_within(2'000'000, 64), 5);
  EXPECT_EQ(kBudget.threads_within(2'000'000, 3), 3);
  EXPECT_EQ(kBudget.threads_within(50'000'000, 64), 1);
}

TEST(simplify_within_memory, refuses_a_mesh_beyond_it_in_both_orders) {
  std::mt19937 random(7);
  std::vector<float> samples;
  for (int i = 0; i < 100 * 100; ++i) samples.push_back(static_cast<float>(random() % 1000));
  HeightField field;
  field.samples = samples.data();
  field.cols = field.rows = 100;
  SimplifyOptions options;
  options.goals.max_error = 0.25;
  options.run.memory.limit = 1'000'000;
  for (const Order order : {Order::kDominant, Order::kGreedy}) {
    options.quality.order = order;
    const auto refused = simplify(field, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::kMemory);
    EXPECT_TRUE(refused.error().message.starts_with("the memory limit is too little: the mesh has"))
        << refused.error().message;
  }
  options.run.memory.limit = 5'000'000;
  EXPECT_TRUE(simplify(field, options));
}

}  // namespace
}  // namespace scarp
