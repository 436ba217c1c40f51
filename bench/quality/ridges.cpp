// The effect of lines along ridges and valleys on meshes with the same max error: triangles, errors at streams and
// divides, and the preserved share of streams. Streams are the samples through which at least 100 others drain, by
// steepest descent over the raster filled to its spills (D8; priority flood). Divides are the streams of the inverted
// raster. Streams and divides are independent of how lines are found. A stream is preserved where the mesh, sampled on
// the raster's grid, has a stream within a sample. The height of ridges is twice the max error.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "suite.h"

namespace bench {
namespace {

using Marks = std::vector<std::uint8_t>;

constexpr std::uint32_t kLeastDrained = 100;
constexpr std::size_t kNowhere = SIZE_MAX;

const std::map<std::string, std::vector<double>> kErrors = {{"fuji.tif", {20, 50}},
                                                            {"bigtujunga30m.tif", {15, 35, 20, 50}},
                                                            {"jacksboro_fault.tif", {20, 50}},
                                                            {"crater.tif", {10, 25}},
                                                            {"gabilan_lidar_1m.tif", {0.5, 1}}};

std::vector<std::string> names(const std::filesystem::path& /*project*/) {
  return {"fuji.tif", "bigtujunga30m.tif", "jacksboro_fault.tif", "crater.tif", "gabilan_lidar_1m.tif"};
}

/// Drainage over a grid of heights.
class Drainage {
 public:
  Drainage(const std::vector<float>& heights, int cols, int rows)
      : cols_(cols), rows_(rows), heights_(heights), to_(heights.size(), kNowhere) {
    flood();
    for (const std::size_t i : reached_) to_[i] = downhill(i);
  }

  Marks streams() const {
    std::vector<std::uint32_t> drained(heights_.size(), 1);
    std::vector<std::uint8_t> inflows(heights_.size(), 0);
    for (const std::size_t i : reached_) {
      if (to_[i] != kNowhere) ++inflows[to_[i]];
    }
    std::vector<std::size_t> open;
    for (const std::size_t i : reached_) {
      if (inflows[i] == 0) open.push_back(i);
    }
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      if (to_[i] == kNowhere) continue;
      drained[to_[i]] += drained[i];
      if (--inflows[to_[i]] == 0) open.push_back(to_[i]);
    }
    Marks streams(heights_.size(), 0);
    for (const std::size_t i : reached_) streams[i] = drained[i] >= kLeastDrained ? 1 : 0;
    return streams;
  }

 private:
  template <class Visit>
  void visit_neighbours(std::size_t i, const Visit& visit) const {
    const int col = static_cast<int>(i % static_cast<std::size_t>(cols_)),
              row = static_cast<int>(i / static_cast<std::size_t>(cols_));
    for (int y = row - 1; y <= row + 1; ++y) {
      for (int x = col - 1; x <= col + 1; ++x) {
        if (x == col && y == row) continue;
        const bool is_inside = x >= 0 && y >= 0 && x < cols_ && y < rows_;
        const std::size_t j =
            is_inside ? static_cast<std::size_t>(y) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(x)
                      : kNowhere;
        visit(j != kNowhere && !std::isnan(heights_[j]) ? j : kNowhere, x != col && y != row);
      }
    }
  }

  /// Raises pits to their spills, so that all paths lead out.
  void flood() {
    using Waiting = std::pair<float, std::size_t>;
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<Waiting>> waiting;
    std::vector<std::uint8_t> is_seen(heights_.size(), 0);
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      bool is_border = false;
      visit_neighbours(i, [&](std::size_t j, bool) { is_border = is_border || j == kNowhere; });
      if (!is_border || std::isnan(heights_[i])) continue;
      is_seen[i] = 1;
      waiting.emplace(heights_[i], i);
    }
    while (!waiting.empty()) {
      const auto [level, i] = waiting.top();
      waiting.pop();
      reached_.push_back(i);
      heights_[i] = level;
      visit_neighbours(i, [&](std::size_t j, bool) {
        if (j == kNowhere || is_seen[j] != 0) return;
        is_seen[j] = 1;
        to_[j] = i;
        waiting.emplace(std::max(level, heights_[j]), j);
      });
    }
  }

  std::size_t downhill(std::size_t i) const {
    std::size_t to = to_[i];
    if (to == kNowhere) return to;
    double steepest = 0;
    visit_neighbours(i, [&](std::size_t j, bool is_diagonal) {
      if (j == kNowhere) return;
      const double fall = (double{heights_[i]} - double{heights_[j]}) / (is_diagonal ? std::sqrt(2.0) : 1.0);
      if (!(fall > steepest)) return;
      steepest = fall;
      to = j;
    });
    return to;
  }

  int cols_, rows_;
  std::vector<float> heights_;
  std::vector<std::size_t> to_;
  std::vector<std::size_t> reached_;  // from the border upwards
};

std::vector<float> turned(std::vector<float> heights) {
  for (float& height : heights) height = -height;
  return heights;
}

/// The share of marks with one of `others` at or next to them.
double share_kept(const Marks& marks, const Marks& others, int cols, int rows) {
  std::size_t all = 0, kept = 0;
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(x);
      };
      if (marks[at(col, row)] == 0) continue;
      ++all;
      bool is_kept = false;
      for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
        for (int x = std::max(col - 1, 0); x <= std::min(col + 1, cols - 1); ++x)
          is_kept = is_kept || others[at(x, y)] != 0;
      }
      kept += is_kept ? 1 : 0;
    }
  }
  return all == 0 ? 1 : static_cast<double>(kept) / static_cast<double>(all);
}

double rmse_at(const Marks& marks, const std::vector<float>& errors) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == 0 || std::isnan(errors[i])) continue;
    sum += double{errors[i]} * double{errors[i]};
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

enum class Lines { kNone, kPreferred, kKept };

std::string row_of(const scarp::OwnedHeightField& field, double error, scarp::Effort effort, Lines lines) {
  scarp::SimplifyOptions options;
  options.goals.max_error = error;
  options.quality.effort = effort;
  options.run.threads = 0;
  scarp::RidgeOptions asked;
  asked.height = 2 * error;
  asked.max_error = error;
  asked.affine = options.features.breaklines.affine = scarp::map_affine(field.info, field.rows);
  asked.are_kept = lines == Lines::kKept;
  const auto ridges = check(scarp::detect_ridges(field.view(), asked));
  for (const auto* found : {&ridges.ridges, &ridges.valleys}) {
    if (lines != Lines::kNone)
      options.features.breaklines.lines.insert(options.features.breaklines.lines.end(), found->begin(), found->end());
  }
  const auto result = check(scarp::simplify(field, options));

  std::vector<float> errors;
  scarp::MeasureOptions measuring;
  measuring.topology = false;
  measuring.run.threads = 0;
  measuring.on_row = [&](int, std::span<const float> row) { errors.insert(errors.end(), row.begin(), row.end()); };
  const auto measured = check(scarp::measure(field, result.mesh, measuring));
  std::vector<float> surface = field.samples;
  for (std::size_t i = 0; i < surface.size(); ++i) surface[i] += errors[i];
  const auto streams_of = [&](const std::vector<float>& heights) {
    return Drainage(heights, field.cols, field.rows).streams();
  };
  const Marks streams = streams_of(field.samples), divides = streams_of(turned(field.samples));
  return fmt::format("{},{},{},{},{:.6g},{:.4g},{:.4g},{:.4g},{:.4f},{:.4f}", ridges.ridges.size(),
                     ridges.valleys.size(), ridges.vertices, result.mesh.triangle_count(), measured.max_error,
                     measured.rmse, rmse_at(streams, errors), rmse_at(divides, errors),
                     share_kept(streams, streams_of(surface), field.cols, field.rows),
                     share_kept(divides, streams_of(turned(surface)), field.cols, field.rows));
}

constexpr std::pair<const char*, scarp::Effort> kEfforts[] = {
    {"fast", scarp::Effort::kFast}, {"normal", scarp::Effort::kNormal}, {"high", scarp::Effort::kHigh}};
constexpr std::pair<const char*, Lines> kLines[] = {
    {"none", Lines::kNone}, {"preferred", Lines::kPreferred}, {"kept", Lines::kKept}};

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  for (const double error : kErrors.at(name)) {
    for (const auto& [effort, level] : kEfforts) {
      for (const auto& [kind, lines] : kLines)
        rows.add(fmt::format("{},{},{},{},{}", name, error, effort, kind, row_of(field, error, level, lines)));
    }
  }
}

}  // namespace

const Suite kRidges{"ridges",
                    "raster,error,effort,lines,ridges,valleys,line_vertices,triangles,max_error,rmse,stream_rmse,"
                    "divide_rmse,streams_kept,divides_kept",
                    names, measure};

}  // namespace bench
