#include "measure/error_summary.h"

#include <cmath>
#include <cstddef>

#include "base/bits.h"

namespace scarp::judge {

void Histogram::add(float magnitude) {
  const std::uint32_t bucket = (bit_cast<std::uint32_t>(magnitude) & 0x7fffffffu) >> kShift;
  auto& page = pages_[bucket >> kPageBits];
  if (!page) page = std::make_unique<Page>();
  ++(*page)[bucket & ((1u << kPageBits) - 1)];
  ++count_;
}

void Histogram::merge(const Histogram& other) {
  for (std::size_t p = 0; p < pages_.size(); ++p) {
    if (!other.pages_[p]) continue;
    if (!pages_[p]) pages_[p] = std::make_unique<Page>();
    for (std::size_t i = 0; i < pages_[p]->size(); ++i) (*pages_[p])[i] += (*other.pages_[p])[i];
  }
  count_ += other.count_;
}

double Histogram::percentile(unsigned permille) const {
  const std::uint64_t rank = count_ / 1000 * permille + (count_ % 1000 * permille + 999) / 1000;
  std::uint64_t passed = 0;
  for (std::size_t p = 0; p < pages_.size(); ++p) {
    if (!pages_[p]) continue;
    for (std::size_t i = 0; i < pages_[p]->size(); ++i) {
      passed += (*pages_[p])[i];
      if (passed < rank || passed == 0) continue;
      // The last finite bucket ends at infinity; there is none above it.
      const auto bucket = static_cast<std::uint32_t>((p << kPageBits) + i);
      if (bucket == 0) return 0;  // zero, or nearer to it than 1e-41
      return static_cast<double>(bit_cast<float>((bucket + 1) << kShift));
    }
  }
  return 0;
}

void Sum::add(double value) {
  const double sum = sum_ + value;
  lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
  sum_ = sum;
}

RowSums sum_row(std::span<const double> errors, Histogram& histogram) {
  RowSums sums;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double error = errors[i];
    if (std::isnan(error)) continue;
    const double magnitude = std::abs(error);
    ++sums.samples;
    sums.error += error;
    sums.magnitude += magnitude;
    sums.square += error * error;
    histogram.add(static_cast<float>(magnitude));
    if (magnitude > sums.largest) {
      sums.largest = magnitude;
      sums.largest_at = static_cast<int>(i);
    }
  }
  return sums;
}

}  // namespace scarp::judge
