// Every set of kernels that scan trial triangles gives the bits of the scalar set, for all samples and triangles.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <random>

#include "fit/triangle_kernels.h"
#include "fit/triangle_scan.h"
#include "laws/fields.h"

namespace scarp::triangle_kernels_laws_test {
namespace {

using testing::Field;
using testing::Relief;

template <class Number>
void assert_same_bits(Number a, Number b) {
  using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
  RC_ASSERT(std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b));
}

void assert_same_assessment(const fit::TriangleSums& a, const fit::TriangleSums& b) {
  RC_ASSERT(a.kind == b.kind);
  assert_same_bits(a.worst, b.worst);
  assert_same_bits(a.energy, b.energy);
  RC_ASSERT(a.y == b.y && a.first == b.first && a.last == b.last);
}

RC_GTEST_PROP(TriangleKernelsLaws, AllGiveTheSameBits, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const auto below = [&](std::int32_t end) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(end));
  };
  const std::int32_t cols = 2 + below(90), rows = 2 + below(40), steps = below(2) == 0 ? grid::kLatticeSteps : 1;
  const auto relief = static_cast<Relief>(below(5));
  const Field field = random_field(static_cast<std::uint32_t>(random()), cols, rows, relief, below(2) == 0 ? 0.1 : 0);
  const float* const samples = field.samples.data();
  const fit::SampleRows of{samples, cols, samples + field.samples.size()};
  const fit::TriangleKernels& twin = fit::available_triangle_kernels().back();
  for (int i = 0; i < 50; ++i) {
    std::array<fit::FitCorner, 3> corners;
    for (fit::FitCorner& corner : corners) {
      corner.x = below((cols - 1) * grid::kLatticeSteps / steps + 1) * steps;
      corner.y = below((rows - 1) * grid::kLatticeSteps / steps + 1) * steps;
      corner.z = static_cast<float>(below(4000)) / 16 - 100;
    }
    if (fit::area2(corners[0], corners[1], corners[2]) < 0) std::swap(corners[1], corners[2]);
    if (fit::area2(corners[0], corners[1], corners[2]) == 0) continue;
    const double threshold = std::ldexp(1.0 + below(8), below(9) - 1);
    const fit::TriangleTask task(corners[0], corners[1], corners[2], threshold, threshold);
    const auto per_square = static_cast<float>(1 / (threshold * threshold));
    const fit::ErrorLimits limits{below(3) == 0 ? task.cut : std::numeric_limits<float>::max(),
                                  below(3) == 0 ? 100.0f : std::numeric_limits<float>::infinity(), per_square};
    const fit::CornerWeight weight{static_cast<float>(below(200) - 100) / 64, static_cast<float>(below(200) - 100) / 64,
                                   static_cast<float>(1 / threshold)};
    for (const fit::TriangleKernels& kernels : fit::available_triangle_kernels()) {
      for (std::size_t power = 0; power < 2; ++power) {
        assert_same_assessment(kernels.assess[power](task, of, limits), twin.assess[power](task, of, limits));
        const fit::CornerPull pull = kernels.pull[power](task, of, weight), twins = twin.pull[power](task, of, weight);
        assert_same_bits(pull.stiffness, twins.stiffness);
        assert_same_bits(pull.push, twins.push);
        fit::TriangleError::Moments moments{}, twin_moments{};
        kernels.add_moments[power](task, of, weight, moments);
        twin.add_moments[power](task, of, weight, twin_moments);
        for (std::size_t k = 0; k < moments.size(); ++k) assert_same_bits(moments[k], twin_moments[k]);
      }
      fit::TriangleError::Room room{-50, 50}, twin_room{-50, 50};
      kernels.narrow(task, of, weight, room);
      twin.narrow(task, of, weight, twin_room);
      assert_same_bits(room.lowest, twin_room.lowest);
      assert_same_bits(room.highest, twin_room.highest);
    }
  }
}

}  // namespace
}  // namespace scarp::triangle_kernels_laws_test
