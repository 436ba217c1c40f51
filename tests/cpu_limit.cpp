// SCARP_MOST_CPU_SECONDS: a test that uses more CPU time fails, since `make check` runs before every commit and must
// remain quick. A limit on wall time would also fail tests on a busy machine.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

namespace scarp::testing {
namespace {

class CpuLimit : public ::testing::EmptyTestEventListener {
 public:
  explicit CpuLimit(double most) : most_(most) {}

  void OnTestStart(const ::testing::TestInfo&) override { start_ = std::clock(); }
  void OnTestEnd(const ::testing::TestInfo&) override {
    const double taken = static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
    if (taken > most_)
      ADD_FAILURE() << taken << " s of CPU time are more than the " << most_ << " s that a fast test may take: make it "
                    << "smaller, or name it among the slow tests of tests/CMakeLists.txt";
  }

 private:
  const double most_;
  std::clock_t start_ = 0;
};

[[maybe_unused]] const bool is_watched = [] {
  const char* most = std::getenv("SCARP_MOST_CPU_SECONDS");
  if (most != nullptr) ::testing::UnitTest::GetInstance()->listeners().Append(new CpuLimit(std::atof(most)));
  return most != nullptr;
}();

}  // namespace
}  // namespace scarp::testing
