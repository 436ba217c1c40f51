#include "io/line_heights.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scarp::io {

namespace {

using HeightPlace = std::array<double, 3>;

/// Fills the places between `from` and `to`, which have known heights. Indices beyond the end wrap around the ring.
void fill_between(std::span<HeightPlace> places, std::size_t from, std::size_t to) {
  const auto at = [&](std::size_t k) -> HeightPlace& { return places[k % places.size()]; };
  std::vector<double> ways{0};
  for (std::size_t k = from; k < to; ++k)
    ways.push_back(ways.back() + std::hypot(at(k + 1)[0] - at(k)[0], at(k + 1)[1] - at(k)[1]));
  const double begin = at(from)[2], end = at(to)[2];
  for (std::size_t k = from + 1; k < to; ++k) {
    const double share = ways.back() > 0 ? ways[k - from] / ways.back() : 0;
    at(k)[2] = begin + share * (end - begin);
  }
}

}  // namespace

std::size_t fill_heights(std::span<HeightPlace> places, bool is_ring) {
  const auto is_known = [](const HeightPlace& place) { return !std::isnan(place[2]); };
  if (places.size() < 2) return 0;
  // A ring's last place is its first.
  const std::span<HeightPlace> distinct = is_ring ? places.first(places.size() - 1) : places;
  if (is_ring && !is_known(distinct.front())) distinct.front()[2] = places.back()[2];
  const auto known = static_cast<std::size_t>(std::count_if(distinct.begin(), distinct.end(), is_known));
  if (known == 0) return 0;
  const auto first =
      static_cast<std::size_t>(std::find_if(distinct.begin(), distinct.end(), is_known) - distinct.begin());
  std::size_t last = first;
  for (std::size_t k = first + 1; k < distinct.size(); ++k) {
    if (!is_known(distinct[k])) continue;
    fill_between(distinct, last, k);
    last = k;
  }
  if (is_ring) {
    fill_between(distinct, last, first + distinct.size());
    places.back()[2] = distinct.front()[2];
  } else {
    for (std::size_t k = 0; k < first; ++k) places[k][2] = places[first][2];
    for (std::size_t k = last + 1; k < places.size(); ++k) places[k][2] = places[last][2];
  }
  return distinct.size() - known;
}

}  // namespace scarp::io
