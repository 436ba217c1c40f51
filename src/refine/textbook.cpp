#include "refine/textbook.h"

#include <cmath>
#include <optional>

#include "geom/exact_error.h"
#include "geom/plane.h"
#include "refine/candidate_queue.h"

namespace scarp::refine {

namespace {

bool contains(const std::array<Point, 3>& corners, Point p) {
  return orient(corners[0], corners[1], p) >= 0 && orient(corners[1], corners[2], p) >= 0 &&
         orient(corners[2], corners[0], p) >= 0;
}

/// The sample as a candidate of the triangle, if its error exceeds the threshold there.
std::optional<metric::Candidate> assess(const grid::Raster& raster, const std::array<Point, 3>& corners, Point p,
                                        double threshold) {
  if (!raster.is_valid(p) || !contains(corners, p)) return std::nullopt;
  const std::array<float, 3> heights{raster.at(corners[0]), raster.at(corners[1]), raster.at(corners[2])};
  if (!geom::exceeds_exactly(corners, heights, p, raster.at(p), threshold)) return std::nullopt;
  return metric::Candidate{std::abs(geom::Plane::through(corners, heights).height_at(p) - double{raster.at(p)}), p};
}

void keep_worse(std::optional<metric::Candidate>& worst, const std::optional<metric::Candidate>& other) {
  if (other && (!worst || metric::is_worse(*other, *worst))) worst = other;
}

std::optional<metric::Candidate> worst_in_triangle(const grid::Raster& raster, const tin::Triangulation& tin,
                                                   tin::Triangle t, double threshold) {
  std::optional<metric::Candidate> worst;
  if (tin.is_outside(t)) return worst;
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    for (std::int32_t x = 0; x < raster.cols; ++x) keep_worse(worst, assess(raster, tin.corners(t), {x, y}, threshold));
  }
  return worst;
}

}  // namespace

std::vector<Point> insert_by_brute_force(const grid::Raster& raster, tin::Triangulation& tin, double threshold,
                                         std::size_t most) {
  std::vector<Point> inserted;
  while (inserted.size() < most) {
    std::optional<metric::Candidate> worst;
    for (tin::Triangle t = 0; t < tin.triangle_count(); ++t)
      keep_worse(worst, worst_in_triangle(raster, tin, t, threshold));
    if (!worst) break;
    tin.insert(worst->at, tin.locate(worst->at, 0));
    inserted.push_back(worst->at);
  }
  return inserted;
}

std::vector<Point> insert_by_local_search(const grid::Raster& raster, tin::Triangulation& tin, double threshold,
                                          std::size_t most) {
  std::vector<Point> inserted;
  std::vector<std::optional<metric::Candidate>> candidates(tin.triangle_count());
  std::vector<tin::Triangle> star;
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) candidates[t] = worst_in_triangle(raster, tin, t, threshold);
  while (inserted.size() < most) {
    std::optional<metric::Candidate> worst;
    for (const auto& candidate : candidates) keep_worse(worst, candidate);
    if (!worst) break;
    tin.star(tin.insert(worst->at, tin.locate(worst->at, 0)), star);
    inserted.push_back(worst->at);
    candidates.resize(tin.triangle_count());
    for (tin::Triangle t : star) candidates[t] = worst_in_triangle(raster, tin, t, threshold);
  }
  return inserted;
}

}  // namespace scarp::refine
