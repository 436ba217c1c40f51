// Every set of the judge's kernels gives the bits of the scalar set, for all samples, triangles and questions about the
// worst samples.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <random>

#include "laws/fields.h"
#include "measure/facet_error.h"
#include "measure/facet_task.h"
#include "measure/judge_kernels.h"

namespace scarp::judge_kernels_laws_test {
namespace {

using judge::BandRows;
using judge::Buckets;
using judge::Caution;
using judge::Facet;
using judge::FacetTask;
using judge::JudgeKernels;
using judge::RowHeights;
using judge::RowSums;
using testing::Field;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

enum class Places { kSamples, kLattice, kFree, kSlivers };

/// A band of a field, padded with values that a reader must ignore.
struct TestBand {
  std::vector<float> heights;
  std::vector<double> errors;
  std::int32_t cols, first, rows, stride;

  TestBand(const Field& field, std::int32_t from, std::int32_t count) : cols(field.cols), first(from), rows(count) {
    const auto* begin = field.samples.data() + static_cast<std::ptrdiff_t>(from) * cols;
    heights.assign(begin, begin + static_cast<std::ptrdiff_t>(count) * cols);
    heights.resize(heights.size() + judge::kKernelPadding, 1e30f);
    stride = cols + 3;
    errors.assign(static_cast<std::size_t>(stride) * static_cast<std::size_t>(count) + judge::kKernelPadding,
                  static_cast<double>(kNaN));
  }
  BandRows view() {
    const auto end = heights.end() - static_cast<std::ptrdiff_t>(judge::kKernelPadding);
    const bool is_whole = std::none_of(heights.begin(), end, [](float z) { return std::isnan(z); });
    return {heights.data(), errors.data(), cols, stride, first, is_whole};
  }
};

/// Handles samples like the judge: errors from the largest so far on are settled and become the largest.
struct Looker {
  const Facet& facet;
  const FacetTask& task;
  TestBand& band;
  double largest;
  std::uint64_t settled = 0;

  static double look(void* self, std::int32_t row, std::int32_t column, std::uint32_t lanes) {
    auto& looker = *static_cast<Looker*>(self);
    for (std::int32_t k = 0; lanes >> k != 0; ++k) {
      if ((lanes >> k & 1) != 0) looker.look_at(column + k, row);
    }
    return looker.largest;
  }
  void look_at(std::int32_t col, std::int32_t row) {
    const std::size_t at = static_cast<std::size_t>(row - band.first) * static_cast<std::size_t>(band.cols) +
                           static_cast<std::size_t>(col);
    const double sample = band.heights[at];
    std::array<double, 3> w{};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      w[k] = std::max(0.0, task.dx[k] * (row - task.y[k]) - task.dy[k] * (col - task.x[k]));
      sum += w[k] * (facet.z[k] - sample);
    }
    double error = sum * task.per_area;
    if (std::abs(error) >= largest) {
      error = judge::settle_error(w, facet.z, sample);
      ++settled;
      largest = std::max(largest, std::abs(error));
    }
    double& held = band.errors[static_cast<std::size_t>((row - band.first) * band.stride + col)];
    if (!(std::abs(error) <= std::abs(held)) || error == std::abs(held)) held = error;
  }
};

std::vector<Facet> random_facets(std::mt19937& random, const Field& field, Places places, int count) {
  const auto uniform = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<Facet> facets;
  while (facets.size() < static_cast<std::size_t>(count)) {
    const double reach = std::ldexp(1, static_cast<int>(random() % 9));
    const double x = uniform(-3, field.cols + 3), y = uniform(-3, field.rows + 3);
    Facet facet;
    for (std::size_t k = 0; k < 3; ++k) {
      facet.plan.x[k] = x + uniform(-reach, reach);
      facet.plan.y[k] = y + uniform(-reach, reach);
      if (places == Places::kSlivers && k == 2) {
        const double t = uniform(0, 1), off = std::ldexp(uniform(-1, 1), -static_cast<int>(random() % 50));
        facet.plan.x[k] = facet.plan.x[0] + t * (facet.plan.x[1] - facet.plan.x[0]) + off;
        facet.plan.y[k] = facet.plan.y[0] + t * (facet.plan.y[1] - facet.plan.y[0]);
      }
      const double steps = places == Places::kSamples ? 1 : 256;
      if (places == Places::kSamples || places == Places::kLattice) {
        facet.plan.x[k] = std::round(facet.plan.x[k] * steps) / steps;
        facet.plan.y[k] = std::round(facet.plan.y[k] * steps) / steps;
      }
      const auto col = std::clamp(static_cast<int>(facet.plan.x[k]), 0, field.cols - 1),
                 row = std::clamp(static_cast<int>(facet.plan.y[k]), 0, field.rows - 1);
      const float z = field.samples[static_cast<std::size_t>(row * field.cols + col)];
      facet.z[k] = std::isnan(z) ? 3 : random() % 4 == 0 ? uniform(-9, 9) : double{z};
    }
    if (make_counter_clockwise(facet)) facets.push_back(facet);
  }
  return facets;
}

std::vector<double> judge_all(const JudgeKernels& kernels, const Field& field, const std::vector<Facet>& facets,
                              bool is_on_lattice, double watch) {
  std::vector<double> errors;
  for (std::int32_t first = 0; first < field.rows; first += judge::kMostBandRows) {
    TestBand band(field, first, std::min(judge::kMostBandRows, field.rows - first));
    double largest = watch;
    for (const Facet& facet : facets) {
      FacetTask task;
      if (!make_task(facet, {first, first + band.rows - 1, band.cols}, is_on_lattice, task)) continue;
      Looker looker{facet, task, band, largest};
      Caution caution{largest, &looker, &Looker::look};
      kernels.judge_facet(task, band.view(), caution);
      largest = looker.largest;
    }
    errors.insert(errors.end(), band.errors.begin(),
                  band.errors.end() - static_cast<std::ptrdiff_t>(judge::kKernelPadding));
    errors.push_back(largest);
  }
  return errors;
}

bool have_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

RC_GTEST_PROP(judge_kernels_laws, facets_agree_to_the_bit, ()) {
  const auto cols = *rc::gen::inRange(2, 120), rows = *rc::gen::inRange(2, 90);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const Places places = *rc::gen::element(Places::kSamples, Places::kLattice, Places::kFree, Places::kSlivers);
  const Field field = testing::random_field(seed, cols, rows, testing::kReliefs[*rc::gen::inRange(0, 5)],
                                            *rc::gen::element(0.0, 0.0, 0.05, 0.4));
  const double watch = *rc::gen::element(-1.0, 0.0, 0.5, 4.0, 1e300);
  std::mt19937 random(seed);
  const std::vector<Facet> facets = random_facets(random, field, places, 60);
  const bool is_on_lattice = places == Places::kSamples || places == Places::kLattice;
  const auto expected = judge_all(judge::available_judge_kernels().back(), field, facets, is_on_lattice, watch);
  for (const JudgeKernels& kernels : judge::available_judge_kernels())
    RC_ASSERT(have_same_bits(judge_all(kernels, field, facets, is_on_lattice, watch), expected));
  // The shortcut for corners on the lattice changes nothing.
  if (is_on_lattice)
    RC_ASSERT(have_same_bits(judge_all(judge::judge_kernels(), field, facets, false, watch), expected));
}

/// The number of samples in each bucket, with zeros subtracted.
std::vector<std::int64_t> counts_of(const Buckets& buckets) {
  std::vector<std::int64_t> counts(1 << 20);
  for (std::size_t i = 0; i < buckets.count; ++i) ++counts[buckets.values[i]];
  counts[0] += buckets.zeros;
  return counts;
}

RC_GTEST_PROP(judge_kernels_laws, sums_agree_to_the_bit, ()) {
  const auto count = *rc::gen::inRange(0, 80);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto zeros = static_cast<unsigned>(random() % 3), missing = static_cast<unsigned>(random() % 3);
  std::vector<double> errors(static_cast<std::size_t>(count));
  for (double& error : errors) {
    error = std::ldexp(static_cast<double>(random()) - 0x1p31, static_cast<int>(random() % 60) - 60);
    if (zeros != 0 && random() % (zeros * zeros) == 0) error = 0;
    if (missing != 0 && random() % (3 * missing) == 0) error = static_cast<double>(kNaN);
  }
  std::vector<std::uint32_t> room(errors.size() + judge::kKernelPadding);
  const auto sum = [&](const JudgeKernels& kernels, Buckets& buckets) {
    buckets.values = room.data();
    return kernels.sum_row(errors.data(), count, buckets);
  };
  Buckets buckets;
  const RowSums expected = sum(judge::available_judge_kernels().back(), buckets);
  const auto expected_counts = counts_of(buckets);
  for (const JudgeKernels& kernels : judge::available_judge_kernels()) {
    const RowSums sums = sum(kernels, buckets);
    RC_ASSERT(sums.samples == expected.samples);
    RC_ASSERT(sums.error == expected.error);
    RC_ASSERT(sums.magnitude == expected.magnitude);
    RC_ASSERT(sums.square == expected.square);
    RC_ASSERT(sums.largest == expected.largest);
    RC_ASSERT(counts_of(buckets) == expected_counts);
  }
}

RC_GTEST_PROP(judge_kernels_laws, rows_are_taken_alike, ()) {
  const auto count = *rc::gen::inRange(1, 80);
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const float nodata = *rc::gen::element(kNaN, 2.0f, -9999.0f);
  std::vector<float> row(static_cast<std::size_t>(count));
  for (float& z : row) {
    z = static_cast<float>(random() % 5);
    if (random() % 11 == 0) z = kNaN;
    if (random() % 11 == 0) z = std::numeric_limits<float>::infinity();
    if (random() % 11 == 0) z = nodata;
  }
  std::vector<float> expected(row.size());
  const RowHeights heights =
      judge::available_judge_kernels().back().take_row(row.data(), count, nodata, expected.data());
  for (const JudgeKernels& kernels : judge::available_judge_kernels()) {
    std::vector<float> taken = row;
    const RowHeights found = kernels.take_row(taken.data(), count, nodata, taken.data());
    RC_ASSERT(found.valid == heights.valid);
    RC_ASSERT(found.least == heights.least);
    RC_ASSERT(found.most == heights.most);
    const RowHeights only_seen = kernels.take_row(row.data(), count, nodata, nullptr);
    RC_ASSERT(only_seen.valid == heights.valid && only_seen.least == heights.least && only_seen.most == heights.most);
    for (std::size_t k = 0; k < row.size(); ++k)
      RC_ASSERT(taken[k] == expected[k] || (std::isnan(taken[k]) && std::isnan(expected[k])));
  }
}

}  // namespace
}  // namespace scarp::judge_kernels_laws_test
