#include "fit/ring_search.h"

#include <bit>
#include <cmath>
#include <limits>

namespace scarp::fit {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t lowest(std::uint32_t set) { return static_cast<std::size_t>(std::countr_zero(set)); }
constexpr std::uint32_t only(std::size_t corner) { return 1u << corner; }

/// Visits the triangles of a triangulation in order. `middle` returns the third corner of an interval's triangle.
template <class Middle, class Visit>
void each_triangle(std::size_t corners, const Middle& middle, const Visit& visit) {
  struct Interval {
    std::size_t first, last;
  };
  std::array<Interval, RingSearch::kMostCorners> open;
  std::size_t depth = 0;
  open[depth++] = {0, corners - 1};
  while (depth > 0) {
    const auto [first, last] = open[--depth];
    const std::size_t q = middle(first, last);
    visit(first, q, last);
    if (last > q + 1) open[depth++] = {q, last};
    if (q > first + 1) open[depth++] = {first, q};
  }
}

}  // namespace

bool RingSearch::find(std::span<const FitCorner> ring, const FitCorner& hub, Point& witness) {
  ring_ = ring;
  size_ = ring.size();
  const Point centre = error_.sample_near(hub);
  look_from(centre);
  keep_positive();
  if (shape_.is_on()) keep_shapely(hub);
  cross_out();
  if (!connect()) return false;
  if (witness != centre) {
    look_from(witness);
    if (cross_out() && !connect()) return false;
  }
  for (std::size_t i = 0; i + 1 < size_; ++i) cost_[i][i + 1] = 0;
  for (std::size_t length = 2; length < size_; ++length) {
    for (std::size_t first = 0; first + length < size_; ++first) {
      if (is_needed(first, first + length) && !improve(first, first + length, witness)) return false;
    }
  }
  return energy() < kInfinity;  // infinite if there is no triangulation
}

/// Fills the table of an interval; false if the ring proves to have no triangulation.
bool RingSearch::improve(std::size_t first, std::size_t last, Point& witness) {
  float& best = cost_[first][last];
  best = kInfinity;
  for (Set left = choices_[first][last]; left != 0;) {
    const std::size_t q = lowest(left);
    left &= left - 1;
    const float beyond = cost_[first][q] + cost_[q][last];
    if (!(beyond < best)) continue;
    const auto verdict = error_.assess(ring_[first], ring_[q], ring_[last], best - beyond);
    if (verdict.kind == TriangleError::Verdict::Kind::kKeeps) {
      best = beyond + verdict.energy;
      middle_[first][last] = static_cast<std::uint8_t>(q);
      worst_[first][last] = verdict.worst;
      energy_[first][last] = verdict.energy;
    } else if (verdict.kind == TriangleError::Verdict::Kind::kBreaks) {
      witness = verdict.witness;
      allowed_[first][last] &= ~only(q);
      look_from(witness);
      cross_out();
      if (!connect()) return false;
      left &= choices_[first][last];
    }
  }
  return true;
}

/// Moves the corners so that the sample is the origin, and computes their pairwise cross products.
void RingSearch::look_from(Point sample) {
  const double height = error_.value_at(0, sample);
  limit_ = error_.limit_at(sample);
  const FitCorner origin = error_.place_of(sample);
  for (std::size_t i = 0; i < size_; ++i) {
    x_[i] = ring_[i].x - origin.x;
    y_[i] = ring_[i].y - origin.y;
    z_[i] = error_.value_at(0, ring_[i]) - height;
  }
  for (std::size_t k = 0; k < more_z_.size(); ++k) {
    const double value = error_.value_at(k + 1, sample);
    for (std::size_t i = 0; i < size_; ++i) more_z_[k][i] = error_.value_at(k + 1, ring_[i]) - value;
  }
  for (std::size_t i = 0; i < size_; ++i) {
    const double x = x_[i], y = y_[i];
    Set right = 0;
    for (std::size_t j = size_; --j > i;) {
      const double cross = x * y_[j] - x_[j] * y;
      cross_[i][j] = cross;
      right = right << 1 | Set{cross <= 0};
    }
    right_of_[i] = right << (i + 1);
  }
}

void RingSearch::keep_positive() {
  for (std::size_t i = 0; i + 2 < size_; ++i) {
    for (std::size_t j = i + 2; j < size_; ++j) {
      Set set = 0;
      for (std::size_t q = j; --q > i;) set = set << 1 | Set{cross_[i][q] + cross_[q][j] > cross_[i][j]};
      allowed_[i][j] = set << (i + 1);
    }
  }
}

/// A hub on a side is collinear with the first and the last corner of its ring.
void RingSearch::keep_shapely(const FitCorner& hub) {
  TriangleShape floor = shape_.least();
  for (std::size_t i = 0; i < size_; ++i) {
    const FitCorner &a = ring_[i], &b = ring_[i + 1 == size_ ? 0 : i + 1];
    if (area2(hub, a, b) > 0) floor = shape_.lowered(floor, hub, a, b);
  }
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = i + 1; j < size_; ++j) square_[i][j] = shape_.square(ring_[i], ring_[j]);
  }
  for (std::size_t i = 0; i + 2 < size_; ++i) {
    for (std::size_t j = i + 2; j < size_; ++j) {
      for (Set left = allowed_[i][j]; left != 0; left &= left - 1) {
        const std::size_t q = lowest(left);
        const double area = cross_[i][q] + cross_[q][j] - cross_[i][j];
        if (!shape_.of(area, square_[i][q], square_[q][j], square_[i][j]).keeps(floor)) allowed_[i][j] &= ~only(q);
      }
    }
  }
}

/// Excludes the triangles that contain the given sample and break the threshold there; true if there are any. Rounding
/// may exclude a triangle exactly at the threshold; it never accepts a wrong one, since the others are scanned. The
/// inner loop avoids branches, which would be unpredictable.
template <class AddMore>
bool RingSearch::cross_out_by(const AddMore& add_more) {
  Set any = 0;
  for (std::size_t i = 0; i + 2 < size_; ++i) {
    const Set far = ~Set{0} << (i + 2);
    for (Set lasts = right_of_[i] & far; lasts != 0; lasts &= lasts - 1) {
      const std::size_t j = lowest(lasts);
      const double wq = -cross_[i][j];
      Set broken = 0;
      for (std::size_t q = j; --q > i;) {
        const double wi = cross_[q][j], wj = cross_[i][q];
        const double error = add_more(std::abs(wi * z_[i] + wq * z_[q] + wj * z_[j]), i, q, j);
        broken = broken << 1 | (Set{wi >= 0} & Set{wj >= 0} & Set{error > limit_ * (wi + wq + wj)});
      }
      broken = broken << (i + 1) & allowed_[i][j];
      allowed_[i][j] ^= broken;
      any |= broken;
    }
  }
  return any != 0;
}

bool RingSearch::cross_out() {
  if (more_z_.empty()) return cross_out_by([](double error, std::size_t, std::size_t, std::size_t) { return error; });
  return cross_out_by([this](double error, std::size_t i, std::size_t q, std::size_t j) {
    const double wi = cross_[q][j], wq = -cross_[i][j], wj = cross_[i][q];
    if (wi < 0 || wj < 0) return error;
    for (const auto& z : more_z_)
      error = add_to_norm_of(error_.norm(), error, std::abs(wi * z[i] + wq * z[q] + wj * z[j]));
    return error;
  });
}

/// Finds the intervals that can be triangulated, from short to long ones, then those that a triangulation of the whole
/// ring needs. False if the ring has no triangulation. The code avoids branches, which would be unpredictable.
bool RingSearch::connect() {
  std::array<Set, kMostCorners> open_to;  // first corners of intervals that can be triangulated
  for (std::size_t j = 1; j < size_; ++j) open_to[j] = only(j - 1);
  for (std::size_t i = size_ - 2; i-- > 0;) {
    Set open_from = only(i + 1);
    for (std::size_t j = i + 2; j < size_; ++j) {
      const Set choices = allowed_[i][j] & open_from & open_to[j], is_open = choices != 0 ? 1 : 0;
      choices_[i][j] = choices;
      open_from |= is_open << j;
      open_to[j] |= is_open << i;
    }
  }
  const std::size_t last = size_ - 1;
  if (choices_[0][last] == 0) return false;
  for (std::size_t j = 0; j < size_; ++j) needed_to_[j] = 0;
  Set needed_from = only(last);
  for (std::size_t i = 0; i + 2 < size_; ++i, needed_from = 0) {
    for (std::size_t j = last; j >= i + 2; --j) {
      const Set is_needed = (needed_from >> j | needed_to_[j] >> i) & 1, choices = choices_[i][j] & (0 - is_needed);
      needed_from |= choices;
      needed_to_[j] |= choices;
    }
    needed_from_[i] = needed_from;
  }
  return true;
}

std::uint64_t RingSearch::code() const {
  std::uint64_t code = 0;
  unsigned shift = 0;
  each_triangle(
      size_, [&](std::size_t first, std::size_t last) { return middle_[first][last]; },
      [&](std::size_t, std::size_t q, std::size_t) {
        code |= std::uint64_t{q} << shift;
        shift += 4;
      });
  return code;
}

void RingSearch::triangles(std::vector<Patch::RingTriangle>& list) const {
  list.clear();
  each_triangle(
      size_, [&](std::size_t first, std::size_t last) { return middle_[first][last]; },
      [&](std::size_t first, std::size_t q, std::size_t last) {
        list.push_back({static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(q), static_cast<std::uint8_t>(last),
                        worst_[first][last], energy_[first][last]});
      });
}

void RingSearch::decode(std::uint64_t code, std::size_t corners, std::vector<Patch::RingTriangle>& list) {
  list.clear();
  const auto next = [&](std::size_t, std::size_t) {
    const auto q = static_cast<std::size_t>(code & 15);
    code >>= 4;
    return q;
  };
  each_triangle(corners, next, [&](std::size_t first, std::size_t q, std::size_t last) {
    list.push_back(
        {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(q), static_cast<std::uint8_t>(last), -1, -1});
  });
}

}  // namespace scarp::fit
