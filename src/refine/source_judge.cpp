#include "refine/source_judge.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "grid/window.h"
#include "refine/height_judge.h"

namespace scarp {

namespace {

/// The samples around some points, and the points as the window counts them.
class Window {
 public:
  Window(const HeightField& field, std::initializer_list<Point> points) : first_(*points.begin()) {
    Point last = first_;
    for (const Point p : points) {
      first_ = {std::min(first_.x, p.x), std::min(first_.y, p.y)};
      last = {std::max(last.x, p.x), std::max(last.y, p.y)};
    }
    cols_ = last.x - first_.x + 1;
    rows_ = last.y - first_.y + 1;
    samples_.resize(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_));
    if (auto read = read_window(field, first_.x, first_.y, cols_, rows_, samples_.data(), cols_); !read)
      throw SourceFailure{read.error()};
  }
  Raster raster() const { return {samples_.data(), cols_, rows_}; }
  Point inside(Point p) const { return {p.x - first_.x, p.y - first_.y}; }
  std::array<Point, 3> inside(const std::array<Point, 3>& p) const {
    return {inside(p[0]), inside(p[1]), inside(p[2])};
  }
  Candidate outside(Candidate candidate) const {
    candidate.at = {candidate.at.x + first_.x, candidate.at.y + first_.y};
    return candidate;
  }

 private:
  Point first_;
  std::int32_t cols_ = 0, rows_ = 0;
  std::vector<float> samples_;
};

}  // namespace

Fit SourceJudge::fit(const std::array<Point, 3>& corners, const FitQuestion& question) const {
  const Window window(field_, {corners[0], corners[1], corners[2]});
  Fit fit = HeightJudge(window.raster(), threshold_).fit(window.inside(corners), question);
  fit.worst = window.outside(fit.worst);
  return fit;
}

std::optional<Candidate> SourceJudge::find_candidate(const std::array<Point, 3>& corners, const Fit& fit) const {
  const Window window(field_, {corners[0], corners[1], corners[2]});
  Fit inside = fit;
  inside.worst.at = window.inside(fit.worst.at);
  const auto found = HeightJudge(window.raster(), threshold_).find_candidate(window.inside(corners), inside);
  return found ? std::optional(window.outside(*found)) : std::nullopt;
}

double SourceJudge::squares_between(Point a, Point b) const {
  const Window window(field_, {a, b});
  return HeightJudge(window.raster(), threshold_).squares_between(window.inside(a), window.inside(b));
}

double SourceJudge::bend(const std::array<Point, 3>& a, const std::array<Point, 3>& b) const {
  const Window window(field_, {a[0], a[1], a[2], b[0], b[1], b[2]});
  return HeightJudge(window.raster(), threshold_).bend(window.inside(a), window.inside(b));
}

}  // namespace scarp
