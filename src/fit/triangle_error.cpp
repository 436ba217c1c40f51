#include "fit/triangle_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "geom/exact_error.h"
#include "geom/scan_kernels.h"

namespace scarp {

namespace {

// Rows are looked at eight samples at a time, as two vectors of four: the width that every machine has. The order of
// the sums is part of the result.
using Floats = float __attribute__((vector_size(16)));
using Masks = std::int32_t __attribute__((vector_size(16)));
using Words = std::int64_t __attribute__((vector_size(16)));
constexpr std::int32_t kLanes = 8;

Floats load(const float* from) {
  Floats four;
  std::memcpy(&four, from, sizeof four);
  return four;
}
Floats all(float value) { return Floats{value, value, value, value}; }
bool any(Masks mask) {
  const auto words = reinterpret_cast<Words>(mask);
  return (words[0] | words[1]) != 0;
}

/// Four values; 0 where they are not meant.
Floats kept(Floats values, Masks meant) { return reinterpret_cast<Floats>(reinterpret_cast<Masks>(values) & meant); }
/// Four errors' magnitudes; 0 where they are not meant, and where the sample is void: NaN is not equal to itself.
Floats magnitudes(Floats errors, Masks meant) {
  constexpr std::int32_t kAllButSign = 0x7fffffff;
  return kept(errors, meant & (errors == errors) & Masks{kAllButSign, kAllButSign, kAllButSign, kAllButSign});
}

/// Adds up lanes, in an order that is part of the result.
float sum_of(Floats low, Floats high) {
  const Floats s = low + high;
  return std::min((s[0] + s[2]) + (s[1] + s[3]), std::numeric_limits<float>::max());
}

double exact_sum_of(Floats s) { return (double{s[0]} + s[2]) + (double{s[1]} + s[3]); }

/// Largest error, lane by lane.
struct Largest {
  Floats worst{};

  void add(Floats low, Floats high) {
    const Floats larger = low > high ? low : high;
    worst = larger > worst ? larger : worst;
  }
  bool exceeds(float cut) const { return any(worst > all(cut)); }
  float largest() const { return std::max(std::max(worst[0], worst[2]), std::max(worst[1], worst[3])); }
};

/// And the sum of squares.
struct Squares : Largest {
  Floats low_sum{}, high_sum{};

  void add(Floats low, Floats high, float) {
    Largest::add(low, high);
    low_sum += low * low;
    high_sum += high * high;
  }
  float energy(float per_square) const { return sum_of(low_sum, high_sum) * per_square; }
};

/// Or of eighth powers, of errors in thresholds.
struct EighthPowers : Largest {
  Floats low_sum{}, high_sum{};

  void add(Floats low, Floats high, float per_square) {
    Largest::add(low, high);
    const Floats low2 = low * low * all(per_square), high2 = high * high * all(per_square);
    const Floats low4 = low2 * low2, high4 = high2 * high2;
    low_sum += low4 * low4;
    high_sum += high4 * high4;
  }
  float energy(float) const { return sum_of(low_sum, high_sum); }
};

/// Eight samples of a row from `samples` on, of which the first `count` are meant.
struct RowSamples {
  std::array<float, kLanes> copy;
  const float* from;
  RowSamples(const float* samples, const float* end) : from(samples) {
    if (end - samples >= kLanes) return;
    copy.fill(0);
    std::copy(samples, end, copy.begin());
    from = copy.data();
  }
};

/// The crossing of an edge with a row is off by less than 2⁻³², and, where it is no whole number, at least 2⁻²⁵ away
/// from one: a multiple of 1/(8·rows) for less than kMaxFitSteps rows of the lattice.
constexpr double kOnSample = 0x1p-28;

constexpr int kRowsPerLook = 4;  // between looks at the energy

}  // namespace

/// A triangle ready to be scanned: corners from top to bottom in samples, its plane.
struct TriangleError::Task {
  struct Place {
    double x, y;
  };
  std::array<FitCorner, 3> corners;
  Place top, middle, bottom;
  float base_x, base_y;
  ScanPlane plane;
  float doubt, certain;  // computed errors up to `doubt` keep the threshold, above `certain` break it
  float cut;             // above it they break the limit

  Task(const FitCorner& a, const FitCorner& b, const FitCorner& c, double threshold, double limit) : corners{a, b, c} {
    constexpr double kStep = 1.0 / kLatticeSteps;
    const Place pa{a.x * kStep, a.y * kStep}, pb{b.x * kStep, b.y * kStep}, pc{c.x * kStep, c.y * kStep};
    top = pa;
    middle = pb;
    bottom = pc;
    if (middle.y < top.y) std::swap(top, middle);
    if (bottom.y < top.y) std::swap(top, bottom);
    if (bottom.y < middle.y) std::swap(middle, bottom);
    base_x = static_cast<float>(pa.x);
    base_y = static_cast<float>(pa.y);
    plane = ScanPlane::spanned(
        a.z, {pb.x - pa.x, pb.y - pa.y, pc.x - pa.x, pc.y - pa.y, double{b.z} - double{a.z}, double{c.z} - double{a.z}},
        limit);
    doubt = scan_floor(threshold, plane.guard);
    certain = static_cast<float>(threshold + double{plane.guard});
    cut = static_cast<float>(limit + double{plane.guard});
  }

  float row_height(std::int32_t y) const { return plane.slope_y * (static_cast<float>(y) - base_y); }
  float error(std::int32_t x, float row, float sample) const {
    return std::abs((plane.slope_x * (static_cast<float>(x) - base_x) + row) - (sample - plane.height));
  }
};

TriangleError::TriangleError(const Raster& raster, Point first, double threshold, const ErrorRule& rule)
    : raster_(raster),
      first_(first),
      threshold_(threshold),
      limit_(rule.slack * threshold),
      power_(rule.power),
      per_threshold_(threshold > 0x1p-60 && threshold < 0x1p60 ? static_cast<float>(1 / threshold) : 0),
      per_square_(per_threshold_ > 0 ? static_cast<float>(1 / (threshold * threshold)) : 0),
      end_(raster.row(raster.rows)) {}

/// Calls row(y, first, last) for each row with samples, top down, until it answers false; whether it never did.
template <class Row>
bool TriangleError::each_row(const Task& task, const Row& row) {
  const Task::Place top = task.top, middle = task.middle, bottom = task.bottom;
  const double along = (bottom.x - top.x) / (bottom.y - top.y);
  const double upper = middle.y > top.y ? (middle.x - top.x) / (middle.y - top.y) : 0;
  const double lower = bottom.y > middle.y ? (bottom.x - middle.x) / (bottom.y - middle.y) : 0;
  for (double y = std::ceil(top.y); y <= bottom.y; ++y) {
    const double from = top.x + (y - top.y) * along;
    const double to = y < middle.y ? top.x + (y - top.y) * upper : middle.x + (y - middle.y) * lower;
    const auto first = static_cast<std::int32_t>(std::min(from, to) + (1 - kOnSample));
    const auto last = static_cast<std::int32_t>(std::max(from, to) + kOnSample);
    if (first <= last && !row(static_cast<std::int32_t>(y), first, last)) return false;
  }
  return true;
}

namespace {

/// A triangle as exact arithmetic wants it.
struct Outline {
  std::array<Point, 3> corners;
  std::array<float, 3> heights;

  explicit Outline(const std::array<FitCorner, 3>& of) {
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = {of[k].x, of[k].y};
      heights[k] = of[k].z;
    }
  }
};

/// By Pick's theorem: the smallest triangle whose corners are samples.
bool holds_corners_only(const FitCorner& a, const FitCorner& b, const FitCorner& c) {
  if (((a.x | a.y | b.x | b.y | c.x | c.y) & (kLatticeSteps - 1)) != 0) return false;
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == kLatticeSteps * kLatticeSteps;
}

}  // namespace

/// A scan on its way through the rows of a triangle.
struct TriangleError::Scan {
  const Task& task;
  const float* end;  // of the samples
  Floats slope, height;
  int rows = 0;

  Scan(const Task& of, const float* samples_end)
      : task(of), end(samples_end), slope(all(of.plane.slope_x)), height(all(of.plane.height)) {}

  /// Calls visit(left, low, low_meant, high, high_meant) for each eight samples: the first four's offset from the base,
  /// errors, and which are meant. `samples`: the row, from its first sample in the window.
  template <class Visit>
  void each_eight(const float* samples, std::int32_t y, std::int32_t first, std::int32_t last, const Visit& visit) {
    const Floats row = all(task.row_height(y));
    for (std::int32_t x = first; x <= last; x += kLanes) {
      const RowSamples eight(samples + x, end);
      const float offset = static_cast<float>(x) - task.base_x;
      const Floats left = all(offset) + Floats{0, 1, 2, 3}, right = all(offset) + Floats{4, 5, 6, 7};
      const std::int32_t count = last - x + 1;
      const Masks counts{count, count, count, count};
      const Floats low = (slope * left + row) - (load(eight.from) - height);
      const Floats high = (slope * right + row) - (load(eight.from + 4) - height);
      visit(left, low, Masks{0, 1, 2, 3} < counts, high, Masks{4, 5, 6, 7} < counts);
    }
    ++rows;
  }
  bool is_time_to_look() const { return rows % kRowsPerLook == 0; }
};

TriangleError::Verdict TriangleError::judge(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                            float energy_limit) const {
  if (holds_corners_only(a, b, c)) return judge_corners({a, b, c}, energy_limit);
  return power_ == ErrorRule::Power::kTwo ? judge_by<Squares>(a, b, c, energy_limit)
                                          : judge_by<EighthPowers>(a, b, c, energy_limit);
}

template <class Sums>
TriangleError::Verdict TriangleError::judge_by(const FitCorner& a, const FitCorner& b, const FitCorner& c,
                                               float energy_limit) const {
  const Task task(a, b, c, threshold_, limit_);
  Scan scan(task, end_);
  Sums sums;
  Verdict verdict;
  const auto add = [&](Floats, Floats low, Masks low_meant, Floats high, Masks high_meant) {
    sums.add(magnitudes(low, low_meant), magnitudes(high, high_meant), per_square_);
  };
  const bool is_whole = each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    scan.each_eight(raster_.row(first_.y + y) + first_.x, y, first, last, add);
    if (sums.exceeds(task.cut)) {
      verdict.kind = Verdict::Kind::kBreaks;
      verdict.witness = find_worst(task, y, first, last);
      return false;
    }
    if (scan.is_time_to_look() && sums.energy(per_square_) >= energy_limit) {
      verdict.kind = Verdict::Kind::kCostly;
      return false;
    }
    return true;
  });
  if (!is_whole) return verdict;
  verdict.worst = sums.largest();
  verdict.energy = sums.energy(per_square_);
  if (verdict.energy >= energy_limit) {
    verdict.kind = Verdict::Kind::kCostly;
  } else if (!decide(task, verdict) && limit_ == threshold_) {
    verdict.kind = Verdict::Kind::kBreaks;
  }
  return verdict;
}

/// Whether the triangle keeps the threshold; `worst` is brought into line.
bool TriangleError::decide(const Task& task, Verdict& verdict) const {
  const bool in_doubt = verdict.worst > task.doubt || double{task.plane.guard} > threshold_;
  const bool keeps = !(verdict.worst > task.certain) && (!in_doubt || settle(task, verdict));
  take_side(keeps, verdict);
  return keeps;
}

/// Moves `worst` to the side of the threshold where it belongs.
void TriangleError::take_side(bool keeps, Verdict& verdict) const {
  auto nearest = static_cast<float>(threshold_);
  if (keeps) {
    if (double{nearest} > threshold_) nearest = std::nextafter(nearest, 0.0f);
    verdict.worst = std::min(verdict.worst, nearest);
  } else {
    if (double{nearest} <= threshold_) nearest = std::nextafter(nearest, std::numeric_limits<float>::infinity());
    verdict.worst = std::max(verdict.worst, nearest);
  }
}

/// Calls add(t, λ) for each four samples: errors in thresholds, and weights of the first corner; both 0
/// where none is meant.
template <class Add>
void TriangleError::each_residual(const Task& task, const std::array<FitCorner, 3>& corners, const Add& add) const {
  const auto& [a, b, c] = corners;
  constexpr double kStep = 1.0 / kLatticeSteps;
  const ScanPlane weight = ScanPlane::spanned(
      1, {(b.x - a.x) * kStep, (b.y - a.y) * kStep, (c.x - a.x) * kStep, (c.y - a.y) * kStep, -1, -1}, 0);
  Scan scan(task, end_);
  each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const Floats row = all(1 + weight.slope_y * (static_cast<float>(y) - task.base_y));
    const auto give = [&](Floats offset, Floats error, Masks meant) {
      const Floats share = row + all(weight.slope_x) * offset;
      const Masks counts = meant & (error == error);
      add(kept(error, counts) * all(per_threshold_), kept(share, counts));
    };
    scan.each_eight(raster_.row(first_.y + y) + first_.x, y, first, last,
                    [&](Floats left, Floats low, Masks low_meant, Floats high, Masks high_meant) {
                      give(left, low, low_meant);
                      give(left + all(4), high, high_meant);
                    });
    return true;
  });
}

TriangleError::Pull TriangleError::pull(const FitCorner& a, const FitCorner& b, const FitCorner& c) const {
  const Task task(a, b, c, threshold_, limit_);
  Floats stiffness{}, push{};
  each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
    const Floats t2 = t * t, t6_share = t2 * t2 * t2 * share;
    stiffness += t6_share * share;
    push += t6_share * t;
  });
  return {exact_sum_of(stiffness), exact_sum_of(push), double{task.plane.slope_x} / threshold_,
          double{task.plane.slope_y} / threshold_};
}

void TriangleError::add_moments(const FitCorner& a, const FitCorner& b, const FitCorner& c, Moments& moments) const {
  const Task task(a, b, c, threshold_, limit_);
  std::array<Floats, 9> sums{};
  each_residual(task, {a, b, c}, [&](Floats t, Floats share) {
    const Floats t2 = t * t, t4 = t2 * t2, share2 = share * share, share4 = share2 * share2, both = t * share;
    sums[0] += t4 * t4;
    sums[1] += t4 * t2 * both;
    sums[2] += t4 * t2 * share2;
    sums[3] += t4 * both * share2;
    sums[4] += t4 * share4;
    sums[5] += t2 * both * share4;
    sums[6] += t2 * share4 * share2;
    sums[7] += both * share4 * share2;
    sums[8] += share4 * share4;
  });
  for (std::size_t k = 0; k < sums.size(); ++k) moments[k] += exact_sum_of(sums[k]);
}

float TriangleError::energy_of(float error) const {
  const float square = error * error * per_square_;
  return power_ == ErrorRule::Power::kTwo ? square : square * square * (square * square);
}

/// REQUIRES: corners are samples' places, and no other sample lies in the triangle.
TriangleError::Verdict TriangleError::judge_corners(const std::array<FitCorner, 3>& corners, float energy_limit) const {
  const Outline outline(corners);
  Verdict verdict;
  bool keeps = true;
  for (const FitCorner& corner : corners) {
    const Point at{corner.x / kLatticeSteps, corner.y / kLatticeSteps};
    const float sample = height_at(at), error = std::abs(corner.z - sample);
    if (corner.z == sample || std::isnan(error)) continue;
    if (exceeds_exactly(outline.corners, outline.heights, {corner.x, corner.y}, sample, threshold_)) {
      keeps = false;
      if (limit_ == threshold_ || double{error} > limit_) {
        verdict.kind = Verdict::Kind::kBreaks;
        verdict.witness = at;
        return verdict;
      }
    }
    verdict.worst = std::max(verdict.worst, error);
    verdict.energy += energy_of(error);
  }
  take_side(keeps, verdict);
  if (verdict.energy >= energy_limit) verdict.kind = Verdict::Kind::kCostly;
  return verdict;
}

/// Decides in exact arithmetic about the samples that rounding leaves in doubt; false where one breaks the threshold.
bool TriangleError::settle(const Task& task, Verdict& verdict) const {
  const Outline outline(task.corners);
  const bool all_in_doubt = double{task.plane.guard} > threshold_;
  return each_row(task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const float row = task.row_height(y);
    for (std::int32_t x = first; x <= last; ++x) {
      const float sample = height_at({x, y});
      if (std::isnan(sample) || (!all_in_doubt && !(task.error(x, row, sample) > task.doubt))) continue;
      verdict.witness = {x, y};
      if (exceeds_exactly(outline.corners, outline.heights, {x * kLatticeSteps, y * kLatticeSteps}, sample, threshold_))
        return false;
    }
    return true;
  });
}

/// The sample of a row with the largest error.
Point TriangleError::find_worst(const Task& task, std::int32_t y, std::int32_t first, std::int32_t last) const {
  const float row = task.row_height(y);
  float worst = -1;
  Point at{first, y};
  for (std::int32_t x = first; x <= last; ++x) {
    if (const float error = task.error(x, row, height_at({x, y})); error > worst) {
      worst = error;
      at.x = x;
    }
  }
  return at;
}

}  // namespace scarp
