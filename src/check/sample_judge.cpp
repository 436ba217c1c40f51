#include "check/sample_judge.h"

#include <algorithm>
#include <cmath>

namespace scarp::check {

std::size_t SampleJudge::bucket_of(double place) {
  const double bucket = std::floor(place / (kWholeTile + 1) * kBuckets);
  return static_cast<std::size_t>(std::clamp(bucket, 0.0, kBuckets - 1.0));
}

SampleJudge::SampleJudge(const ClientTile& tile) : tile_(tile), buckets_(kBuckets * kBuckets) {
  for (std::uint32_t k = 0; k < tile.triangles.size(); k += 3) {
    const std::uint32_t a = tile.triangles[k], b = tile.triangles[k + 1], c = tile.triangles[k + 2];
    const auto [west, east] = std::minmax({tile.u[a], tile.u[b], tile.u[c]});
    const auto [south, north] = std::minmax({tile.v[a], tile.v[b], tile.v[c]});
    for (std::size_t j = bucket_of(south); j <= bucket_of(north); ++j) {
      for (std::size_t i = bucket_of(west); i <= bucket_of(east); ++i) buckets_[j * kBuckets + i].push_back(k);
    }
  }
}

double SampleJudge::error_at(double u, double v, double height) const {
  constexpr double kSlack = 1e-9;
  double error = 0;
  for (const std::uint32_t k : buckets_[bucket_of(v) * kBuckets + bucket_of(u)]) {
    const std::uint32_t a = tile_.triangles[k], b = tile_.triangles[k + 1], c = tile_.triangles[k + 2];
    const double bu = tile_.u[b] - tile_.u[a], bv = tile_.v[b] - tile_.v[a], cu = tile_.u[c] - tile_.u[a],
                 cv = tile_.v[c] - tile_.v[a], area = bu * cv - cu * bv;
    if (area == 0) continue;
    const double x = u - tile_.u[a], y = v - tile_.v[a];
    const double to_b = (x * cv - cu * y) / area, to_c = (bu * y - x * bv) / area;
    if (to_b < -kSlack || to_c < -kSlack || to_b + to_c > 1 + kSlack) continue;
    const double mesh =
        tile_.heights[a] + to_b * (tile_.heights[b] - tile_.heights[a]) + to_c * (tile_.heights[c] - tile_.heights[a]);
    error = std::max(error, std::abs(mesh - height));
  }
  return error;
}

}  // namespace scarp::check
