// Statistics of errors that do not depend on the order of counting.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "scarp/measure.h"

namespace scarp::judge {

/// A bucket of the histogram counts the errors with the same leading bits of |error| as float32. There are 2^12 buckets
/// per power of two, so a bucket's ends differ by at most 0.025 %.
constexpr int kBucketShift = 11;

/// Buckets of the errors of a row, as returned by the kernels.
struct Buckets {
  std::uint32_t* values = nullptr;  ///< room for the whole row and kKernelPadding more
  std::size_t count = 0;
  std::int64_t zeros = 0;  ///< to add to the count of bucket 0
};

/// Counts |error| by bucket: the first kFew in a list, later ones in pages. Clearing pages would cost more than judging
/// a small raster.
class Histogram {
 public:
  void add(const Buckets& buckets);
  void merge(const Histogram& other);
  /// For each of the ascending `permilles`: the upper end of the bucket that contains the `permille`·n/1000-th smallest
  /// value; 0 if nothing was counted.
  template <std::size_t kCount>
  std::array<double, kCount> percentiles(const std::array<unsigned, kCount>& permilles) const {
    std::array<double, kCount> found{};
    find(permilles, found);
    return found;
  }

 private:
  static constexpr unsigned kPageBits = 12, kPages = 256;
  static constexpr std::size_t kPageSize = std::size_t{1} << kPageBits;
  static constexpr std::uint32_t kNone = 0xffffffff;
  static constexpr std::array<std::uint32_t, kPages> no_pages() {
    std::array<std::uint32_t, kPages> none{};
    none.fill(kNone);
    return none;
  }
  static constexpr std::size_t kFew = 1 << 14;
  bool has_pages() const { return counts_.size() > 0; }
  void turn_pages();
  void count(std::span<const std::uint32_t> buckets);
  void find_among_few(std::span<const std::uint64_t> ranks, std::span<double> found) const;
  void make_page(std::uint32_t index);
  void make_first_pages(std::uint32_t index);
  void carry();
  /// The bucket's count, from counts_ and small_.
  std::uint32_t recent_in(std::size_t at) const { return counts_[at] + (at < dense_size_ ? small_[at] : 0u); }
  std::uint64_t count_in(std::size_t first, std::size_t end) const;
  void find(std::span<const unsigned> permilles, std::span<double> found) const;

  std::vector<std::uint32_t> few_;  ///< buckets, before pages exist

  /// Pages of counts, one per exponent of the float, created on first use. The first pages are adjacent. They hold the
  /// `dense_size_` buckets from `dense_from_` on, so most errors need no access to pages_. Their counts are first added
  /// to small_, which needs half as much cache.
  Array<std::uint32_t> counts_;
  Array<std::uint16_t> small_;
  std::array<std::uint32_t, kPages> pages_ = no_pages();  ///< by exponent: start of the page
  std::uint32_t dense_from_ = 0, dense_size_ = 0;
  std::vector<std::uint64_t> carried_;  ///< overflow of counts_, in the same order
  std::uint64_t recent_ = 0;            ///< in counts_
  std::int64_t zeros_ = 0;              ///< zeros in addition to those counted in bucket 0
  std::uint64_t count_ = 0;
};

/// A running sum with Neumaier's compensation.
class Sum {
 public:
  void add(double value);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

/// Sums of one row. Each sum has kSumParts parts, by column, which sum_of_parts() adds up.
struct RowSums {
  std::uint64_t samples = 0;
  double error = 0, magnitude = 0, square = 0;
  double largest = -1;  ///< |error|; −1 without samples
};

constexpr std::size_t kSumParts = 8;

[[gnu::always_inline]] inline double sum_of_parts(const double* parts) {
  return ((parts[0] + parts[4]) + (parts[2] + parts[6])) + ((parts[1] + parts[5]) + (parts[3] + parts[7]));
}

/// Sums up the errors that are not NaN, with the kernels in use. Returns their buckets, stored in `room`.
RowSums sum_row(std::span<const double> errors, Array<std::uint32_t>& room, Buckets& buckets);

/// Sets p50 … p999 of the counted errors, each at most the max error in `result`.
void set_percentiles(const Histogram& histogram, Measurement& result);

}  // namespace scarp::judge
