#include "features/path_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "lines/breaklines.h"

namespace scarp::features {
namespace {

constexpr double kCorridor = 1;           // in samples
constexpr std::size_t kLongestLink = 64;  // in samples of the path

class Links {
 public:
  Links(const lines::LineSamples& samples, const std::vector<Point>& path, double tolerance)
      : samples_(samples), path_(path), tolerance_(tolerance) {}

  /// Sum of squared distances of the samples between two vertices; nothing if the chord violates a limit.
  std::optional<double> cost(std::size_t first, std::size_t last) const {
    const Point a = path_[first], b = path_[last];
    const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    if (length2 == 0) return std::nullopt;
    const double from = samples_.at(a), rise = double{samples_.at(b)} - from;
    double sum = 0;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double x = path_[k].x - a.x, y = path_[k].y - a.y;
      const double beside = x * dy - y * dx, share = (x * dx + y * dy) / length2;
      if (beside * beside > kCorridor * kCorridor * length2 || share < 0 || share > 1) return std::nullopt;
      if (std::abs(from + share * rise - double{samples_.at(path_[k])}) > tolerance_) return std::nullopt;
      sum += beside * beside / length2;
    }
    // the same positions as in the insertion of lines
    const double looks = std::ceil(2 * std::sqrt(length2));
    for (double i = 1; i < looks; ++i) {
      const double height = lines::surface_at(samples_, {a.x + i / looks * dx, a.y + i / looks * dy});
      if (!(std::abs(from + i / looks * rise - height) <= tolerance_)) return std::nullopt;
    }
    return sum;
  }

 private:
  const lines::LineSamples& samples_;
  const std::vector<Point>& path_;
  double tolerance_;
};

struct State {
  std::uint32_t links = std::numeric_limits<std::uint32_t>::max();
  double squares = 0;
  std::size_t from = 0;
};

}  // namespace

std::vector<Point> fewest_vertices(const lines::LineSamples& samples, const ValleyPath& path, double tolerance) {
  const Links links(samples, path.samples, tolerance);
  std::vector<State> states(path.samples.size());
  states[0].links = 0;
  auto joint = path.joints.begin();
  for (std::size_t i = 0; i + 1 < path.samples.size(); ++i) {
    while (joint != path.joints.end() && *joint <= i) ++joint;
    const std::size_t most = std::min(joint == path.joints.end() ? path.samples.size() - 1 : *joint, i + kLongestLink);
    for (std::size_t j = i + 1; j <= most; ++j) {
      State& to = states[j];
      if (states[i].links + 1 > to.links) continue;
      // Adjacent samples are always linked.
      const std::optional<double> cost = j == i + 1 ? std::optional<double>(0) : links.cost(i, j);
      if (!cost) continue;
      const State way{states[i].links + 1, states[i].squares + *cost, i};
      if (way.links < to.links || way.squares < to.squares) to = way;
    }
  }
  std::vector<Point> vertices;
  for (std::size_t k = path.samples.size() - 1; k > 0; k = states[k].from) vertices.push_back(path.samples[k]);
  vertices.push_back(path.samples[0]);
  std::reverse(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace scarp::features
