#include "measure/error_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/bits.h"
#include "measure/judge_kernels.h"

namespace scarp::judge {

void Histogram::make_page(std::uint32_t index) {
  const std::size_t begin = counts_.size();
  counts_.resize(begin + kPageSize);
  std::fill(counts_.begin() + begin, counts_.end(), 0u);
  pages_[index] = static_cast<std::uint32_t>(begin);
}

/// Makes pages around the exponent of the first row's largest error.
void Histogram::make_first_pages(std::uint32_t index) {
  constexpr std::uint32_t kBelow = 9, kAbove = 2;
  const std::uint32_t first = index - std::min(index, kBelow), last = std::min(index + kAbove, kPages - 1);
  for (std::uint32_t page = first; page <= last; ++page) make_page(page);
  dense_from_ = first << kPageBits;
  dense_size_ = static_cast<std::uint32_t>(counts_.size());
  small_.resize(dense_size_);
  std::fill(small_.begin(), small_.end(), std::uint16_t{0});
}

void Histogram::carry() {
  carried_.resize(counts_.size(), 0);
  for (std::size_t i = 0; i < counts_.size(); ++i) carried_[i] += recent_in(i);
  std::fill(counts_.begin(), counts_.end(), 0u);
  std::fill(small_.begin(), small_.end(), std::uint16_t{0});
  recent_ = 0;
}

void Histogram::add(const Buckets& buckets) {
  const std::span<const std::uint32_t> values(buckets.values, buckets.count);
  if (!has_pages() && few_.size() + values.size() <= kFew) {
    few_.insert(few_.end(), values.begin(), values.end());
  } else {
    count(values);
  }
  zeros_ += buckets.zeros;
  count_ += static_cast<std::uint64_t>(static_cast<std::int64_t>(buckets.count) + buckets.zeros);
}

/// Moves the first counts to pages.
void Histogram::turn_pages() {
  if (!few_.empty()) count(std::exchange(few_, {}));
}

void Histogram::count(std::span<const std::uint32_t> buckets) {
  if (buckets.empty()) return;
  turn_pages();
  if (recent_ + buckets.size() > std::numeric_limits<std::uint32_t>::max()) carry();
  recent_ += buckets.size();
  if (!has_pages()) make_first_pages(*std::max_element(buckets.begin(), buckets.end()) >> kPageBits);
  constexpr std::uint32_t kSmallRoom = 1 << 16;
  std::uint32_t* counts = counts_.data();
  std::uint16_t* const small = small_.data();
  const std::uint32_t dense_from = dense_from_, dense_size = dense_size_;
  for (const std::uint32_t bucket : buckets) {
    if (bucket - dense_from < dense_size) {
      if (++small[bucket - dense_from] == 0) counts[bucket - dense_from] += kSmallRoom;
      continue;
    }
    const std::uint32_t index = bucket >> kPageBits;
    if (pages_[index] == kNone) {
      make_page(index);
      counts = counts_.data();
    }
    ++counts[pages_[index] + (bucket & (kPageSize - 1))];
  }
}

void Histogram::merge(const Histogram& other) {
  if (!other.has_pages() && !has_pages() && few_.size() + other.few_.size() <= kFew) {
    few_.insert(few_.end(), other.few_.begin(), other.few_.end());
  } else {
    turn_pages();
    count(other.few_);
  }
  if (recent_ + other.recent_ > std::numeric_limits<std::uint32_t>::max() || !other.carried_.empty()) carry();
  for (std::uint32_t p = 0; p < kPages; ++p) {
    if (other.pages_[p] == kNone) continue;
    if (pages_[p] == kNone) make_page(p);
    std::uint32_t* to = &counts_[pages_[p]];
    for (std::size_t i = 0; i < kPageSize; ++i) to[i] += other.recent_in(other.pages_[p] + i);
    if (other.pages_[p] >= other.carried_.size()) continue;
    carried_.resize(counts_.size(), 0);
    for (std::size_t i = 0; i < kPageSize; ++i) carried_[pages_[p] + i] += other.carried_[other.pages_[p] + i];
  }
  recent_ += other.recent_;
  zeros_ += other.zeros_;
  count_ += other.count_;
}

std::uint64_t Histogram::count_in(std::size_t first, std::size_t end) const {
  std::uint64_t count = 0;
  for (std::size_t i = first; i < end; ++i) count += recent_in(i);
  for (std::size_t i = first; i < std::min(end, carried_.size()); ++i) count += carried_[i];
  return count;
}

namespace {

/// The last finite bucket ends at infinity; there is no bucket above it.
double end_of(std::uint32_t bucket) { return static_cast<double>(bit_cast<float>((bucket + 1) << kBucketShift)); }

}  // namespace

/// Finds the values of ascending ranks, from 1 to the number counted: first by the counts of coarse bins, then in the
/// ranks' bins.
void Histogram::find_among_few(std::span<const std::uint64_t> ranks, std::span<double> found) const {
  constexpr std::uint32_t kBins = 1024;
  const std::uint32_t largest = few_.empty() ? 0 : *std::max_element(few_.begin(), few_.end());
  std::uint32_t shift = 0;
  while (largest >> shift >= kBins) ++shift;
  std::array<std::uint32_t, kBins> counts{}, ends;
  for (const std::uint32_t bucket : few_) ++counts[bucket >> shift];
  struct Place {
    std::uint32_t bin;
    std::int64_t rank;  ///< in its bin, from 0
  };
  std::vector<Place> places;
  places.reserve(ranks.size());
  ends.fill(kNone);
  std::uint32_t collected = 0;
  const auto rank_of = [&](std::size_t i) { return static_cast<std::int64_t>(ranks[i]); };
  std::int64_t passed = zeros_;  // negative if bucket 0 was counted too often
  std::size_t zeros = 0;
  while (zeros < ranks.size() && rank_of(zeros) <= passed) ++zeros;
  for (std::uint32_t bin = 0; bin < kBins && zeros + places.size() < ranks.size(); passed += counts[bin++]) {
    for (std::size_t i = zeros + places.size(); i < ranks.size() && rank_of(i) <= passed + counts[bin]; ++i) {
      if (ends[bin] == kNone) collected += counts[bin];
      ends[bin] = collected - counts[bin];
      places.push_back({bin, rank_of(i) - passed - 1});
    }
  }
  std::vector<std::uint32_t> in_bins(collected);
  for (const std::uint32_t bucket : few_) {
    if (std::uint32_t& end = ends[bucket >> shift]; end != kNone) in_bins[end++] = bucket;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto end = in_bins.begin() + ends[places[i].bin], begin = end - counts[places[i].bin];
    const auto at = begin + static_cast<std::ptrdiff_t>(places[i].rank);
    std::nth_element(begin, at, end);
    if (*at > 0) found[zeros + i] = end_of(*at);
  }
}

void Histogram::find(std::span<const unsigned> permilles, std::span<double> found) const {
  const auto rank = [this](unsigned permille) {
    return count_ / 1000 * permille + (count_ % 1000 * permille + 999) / 1000;
  };
  if (count_ == 0) return;
  if (!has_pages()) {
    std::vector<std::uint64_t> ranks;
    for (const unsigned permille : permilles) ranks.push_back(rank(permille));
    find_among_few(ranks, found);
    return;
  }
  std::size_t next = 0;
  std::uint64_t passed = static_cast<std::uint64_t>(zeros_);
  const auto settle = [&](double value) {
    while (next < permilles.size() && passed != 0 && passed >= rank(permilles[next])) found[next++] = value;
  };
  if (pages_[0] != kNone) passed += count_in(pages_[0], pages_[0] + 1);
  settle(0);  // zeros, and errors below 1e-41
  for (std::uint32_t p = 0; p < kPages && next < permilles.size(); ++p) {
    if (pages_[p] == kNone) continue;
    const std::size_t first = pages_[p] + (p == 0 ? 1 : 0), end = pages_[p] + kPageSize;
    const std::uint64_t in_page = count_in(first, end);
    if (passed + in_page < rank(permilles[next])) {
      passed += in_page;
      continue;
    }
    for (std::size_t at = first; at < end; ++at) {
      if (recent_in(at) == 0 && at >= carried_.size()) continue;
      passed += count_in(at, at + 1);
      settle(end_of(static_cast<std::uint32_t>((std::size_t{p} << kPageBits) + (at - pages_[p]))));
    }
  }
}

void Sum::add(double value) {
  const double sum = sum_ + value;
  lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
  sum_ = sum;
}

RowSums sum_row(std::span<const double> errors, Array<std::uint32_t>& room, Buckets& buckets) {
  room.resize(errors.size() + kKernelPadding);
  buckets.values = room.data();
  return judge_kernels().sum_row(errors.data(), static_cast<std::int32_t>(errors.size()), buckets);
}

void set_percentiles(const Histogram& histogram, Measurement& result) {
  const auto found = histogram.percentiles(std::array{500u, 950u, 990u, 999u});
  double* const percentiles[] = {&result.p50, &result.p95, &result.p99, &result.p999};
  for (std::size_t i = 0; i < found.size(); ++i) *percentiles[i] = std::min(found[i], result.max_error);
}

}  // namespace scarp::judge
