// The judge of scattered points: a bucket grid yields the triangles that may lie over each point.
//
// Points are judged at their original positions, not at those on the lattice. Chunks of points, mostly close in the
// plane, are processed in parallel. Every error has its own slot in one array, which is summed in input order, so the
// result never depends on threads.
#include "measure/point_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/branchless.h"
#include "base/caught.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "measure/bucket_grid.h"
#include "measure/check_mesh.h"
#include "measure/error_summary.h"
#include "measure/facet_error.h"
#include "measure/hull_gaps.h"
#include "measure/judge_blocks.h"
#include "measure/progress_gate.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Result<void> check_options(const PointSet& points, const MeasureOptions& options) {
  if (!(options.coverage_tolerance >= 0) || !std::isfinite(options.coverage_tolerance))
    return fail(ErrorKind::kUsage, "coverage_tolerance must be zero or a positive number of mean point distances");
  const bool fits = options.tolerance.empty() || options.tolerance.size() == points.size();
  if (!fits || options.tolerance_source != nullptr)
    return fail(ErrorKind::kUsage, "tolerances of points: give one for each, at least 0");
  return {};
}

/// More buckets than triangles if there are many points, since each point is compared with every triangle of its
/// bucket.
std::size_t buckets_for(std::size_t triangles, std::size_t points) {
  return std::max(triangles, std::min(8 * triangles, points));
}

struct PointVerdict {
  double error = kNone;  ///< NaN: uncovered
  std::uint32_t triangle = 0;
};

class Judge {
 public:
  Judge(const PointSet& points, const grid::SnappedPoints& snapped, const Mesh& mesh,
        std::span<const std::uint32_t> judged, const Box& box, double tolerance)
      : points_(points),
        snapped_(snapped),
        mesh_(mesh),
        tolerance_(tolerance),
        grid_(box, buckets_for(judged.size(), points.size())) {
    grid_.fill([&](const auto& visit) {
      for (const std::uint32_t t : judged) {
        Facet facet;
        if (get(t, facet)) visit(t, facet.plan);
      }
    });
  }

  /// Lattice points first, then the points that share them.
  std::size_t size() const { return snapped_.size() + snapped_.echoes.size(); }
  std::uint32_t source_of(std::size_t point) const {
    return point < snapped_.size() ? snapped_.source[point] : snapped_.echoes[point - snapped_.size()].source;
  }

  double height_of(std::size_t point) const {
    return point < snapped_.size() ? snapped_.z[point] : snapped_.echoes[point - snapped_.size()].z;
  }

  /// Judges points one after the other; successive points should be near each other in the plane.
  class Run {
   public:
    explicit Run(const Judge& judge) : judge_(judge) {}

    /// Errors near the bound are computed exactly.
    PointVerdict judge(std::size_t point, double bound) {
      bound_ = bound;
      const std::size_t source = judge_.source_of(point);
      const double x = judge_.points_.x[source] - judge_.mesh_.origin[0];
      const double y = judge_.points_.y[source] - judge_.mesh_.origin[1];
      const double z = judge_.height_of(point);
      enter(judge_.grid_.col_of(x), judge_.grid_.row_of(y));
      PointVerdict verdict;
      for (const Entry& entry : entries_) {
        std::array<double, 3> weights;
        for (int k = 0; k < 3; ++k) weights[k] = entry.facet.plan.weight(k, x, y);
        if (!(lesser(weights[0], weights[1], weights[2]) >= entry.least)) continue;
        for (double& weight : weights) weight = std::max(0.0, weight);
        take(verdict, error_at(entry.facet, weights, z), entry.triangle);
      }
      if (std::isnan(verdict.error)) judge_.judge_beside(x, y, z, verdict);
      return verdict;
    }

   private:
    struct Entry {
      Facet facet;
      double least = 0;  ///< weights of at least this count as zero or positive
      std::uint32_t triangle = 0;
    };

    [[gnu::noinline]] void enter(int col, int row) {
      if (col == col_ && row == row_) return;
      col_ = col;
      row_ = row;
      entries_.clear();
      for (const std::uint32_t t : judge_.grid_.bucket(col, row)) {
        Entry& entry = entries_.emplace_back();
        judge_.get(t, entry.facet);
        entry.least = -entry.facet.plan.slack();
        entry.triangle = t;
      }
    }

    /// Computed exactly if the error is 0, near the bound, or possibly the largest of the run.
    double error_at(const Facet& facet, const std::array<double, 3>& weights, double z) {
      constexpr double kRounding = 0x1p-48;
      double sum = 0, size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double part = weights[k] * (facet.z[k] - z);
        sum += part;
        size += std::abs(part);
      }
      const double area = weights[0] + weights[1] + weights[2];
      const double error = sum / area, magnitude = std::abs(error), rounding = kRounding * size / area;
      const bool is_plain =
          magnitude > rounding && magnitude + rounding < largest_ && !(std::abs(magnitude - bound_) <= rounding);
      if (is_plain || size == 0) return error;
      const double exact = settle_error(weights, facet.z, z);
      largest_ = std::max(largest_, std::abs(exact));
      return exact;
    }

    const Judge& judge_;
    double bound_ = HUGE_VAL, largest_ = 0;
    int col_ = -1, row_ = -1;
    std::vector<Entry> entries_;
  };

 private:
  /// False if the triangle has no area seen from above.
  bool get(std::uint32_t t, Facet& facet) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const double* p = &mesh_.positions[3 * std::size_t{mesh_.triangles[3 * std::size_t{t} + k]}];
      facet.plan.x[k] = p[0];
      facet.plan.y[k] = p[1];
      facet.z[k] = mesh_.origin[2] + p[2];
    }
    return make_counter_clockwise(facet);
  }
  /// Keeps the larger error; for ties, the lower triangle.
  static void take(PointVerdict& verdict, double error, std::uint32_t t) {
    if (std::abs(error) <= std::abs(verdict.error)) return;
    verdict = {error, t};
  }
  void judge_beside(double x, double y, double z, PointVerdict& verdict) const {
    double nearest = tolerance_;
    Facet facet;
    for (int row = grid_.row_of(y - tolerance_); row <= grid_.row_of(y + tolerance_); ++row) {
      for (int col = grid_.col_of(x - tolerance_); col <= grid_.col_of(x + tolerance_); ++col) {
        for (const std::uint32_t t : grid_.bucket(col, row)) {
          get(t, facet);
          const double distance = facet.plan.distance(x, y);
          if (!(distance <= nearest)) continue;
          const PointVerdict beside{error_beside(facet, x, y, z, tolerance_), t};
          if (distance == nearest && std::abs(beside.error) <= std::abs(verdict.error)) continue;
          nearest = distance;
          verdict = beside;
        }
      }
    }
  }

  const PointSet& points_;
  const grid::SnappedPoints& snapped_;
  const Mesh& mesh_;
  double tolerance_;
  BucketGrid grid_;
};

/// The bounds of points. Tolerances allow for the rounding of the judge's own arithmetic.
class PointBounds {
 public:
  PointBounds(const grid::SnappedPoints& snapped, const MeasureOptions& options)
      : for_all_(options.collect_above.value_or(HUGE_VAL)), tolerances_(options.tolerance) {
    for (const double z : snapped.z) largest_ = std::max(largest_, std::abs(z));
  }

  double at(std::uint32_t source) const { return std::min(for_all_, own(source)); }
  /// The point's tolerance; infinite if it has none.
  double own(std::uint32_t source) const {
    if (tolerances_.empty()) return HUGE_VAL;
    const double tolerance = double{tolerances_[source]};
    return tolerance + 1e-12 * (tolerance + largest_);
  }

 private:
  double for_all_, largest_ = 0;
  std::span<const float> tolerances_;
};

/// The polygons at which the surface ends: those of the points, if any, else those of the options.
std::vector<PlaceRing> rings_of(const PointSet& points, const MeasureOptions& options) {
  std::vector<PlaceRing> rings;
  for (const auto& ring : points.boundary) {
    rings.emplace_back();
    for (const std::uint32_t i : ring) rings.back().push_back({points.x[i], points.y[i]});
  }
  if (!rings.empty() || options.cutline == nullptr) return rings;
  for (const Line& ring : options.cutline->rings) {
    rings.emplace_back();
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k)
      rings.back().push_back({ring.points[k][0], ring.points[k][1]});
  }
  return rings;
}

/// The worst point of each triangle, and uncovered points, in input order.
class Offenders {
 public:
  void add(std::uint32_t triangle, std::uint32_t point, double error) { found_.push_back({triangle, point, error}); }
  void add_uncovered(std::uint32_t point) { all_.push_back({static_cast<std::int32_t>(point), 0, HUGE_VAL}); }
  std::vector<Offender> finish() {
    sort_rarely(found_, [](const Found& a, const Found& b) {
      if (a.triangle != b.triangle) return a.triangle < b.triangle;
      return std::abs(a.error) != std::abs(b.error) ? std::abs(a.error) > std::abs(b.error) : a.point < b.point;
    });
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (i > 0 && found_[i].triangle == found_[i - 1].triangle) continue;
      all_.push_back({static_cast<std::int32_t>(found_[i].point), 0, found_[i].error});
    }
    sort_rarely(all_, [](const Offender& a, const Offender& b) { return a.col < b.col; });
    return std::move(all_);
  }

 private:
  struct Found {
    std::uint32_t triangle, point;
    double error;
  };
  std::vector<Found> found_;
  std::vector<Offender> all_;
};

/// Errors of points with consecutive numbers, NaN for uncovered ones, and the triangles of the errors.
struct Errors {
  std::vector<double> errors;
  std::vector<std::uint32_t> triangles;
};

/// Judges all points, in lattice order; nothing if cancelled.
std::optional<Errors> judge_all(const Judge& judge, const PointBounds& bounds, bool has_triangles, int threads,
                                ProgressGate& gate) {
  Errors all{std::vector<double>(judge.size(), kNone), std::vector<std::uint32_t>(has_triangles ? judge.size() : 0)};
  constexpr std::size_t kChunk = 1 << 14;
  const std::size_t chunks = (judge.size() + kChunk - 1) / kChunk;
  const std::size_t window = 4 * static_cast<std::size_t>(std::min(thread_count(threads), 1024));
  for (std::size_t first = 0; first < chunks; first += window) {
    if (!gate.go_on("measure", static_cast<double>(first) / static_cast<double>(chunks))) return std::nullopt;
    parallel_for(std::min(window, chunks - first), threads, [&](std::size_t i) {
      const std::size_t begin = (first + i) * kChunk, end = std::min(judge.size(), begin + kChunk);
      Judge::Run run(judge);
      for (std::size_t point = begin; point < end; ++point) {
        const PointVerdict verdict = run.judge(point, bounds.at(judge.source_of(point)));
        all.errors[point] = verdict.error;
        if (has_triangles) all.triangles[point] = verdict.triangle;
      }
    });
  }
  return all;
}

tl::unexpected<Error> report_cancelled() { return fail(ErrorKind::kCancelled, "measuring was cancelled"); }

}  // namespace

std::optional<std::size_t> ErrorTally::add(std::span<const double> errors) {
  constexpr std::size_t kTogether = 1 << 16;
  std::optional<std::size_t> worst;
  for (std::size_t first = 0; first < errors.size(); first += kTogether) {
    const auto part = errors.subspan(first, std::min(kTogether, errors.size() - first));
    Buckets buckets;
    const RowSums sums = sum_row(part, room_, buckets);
    histogram_.add(buckets);
    samples_ += sums.samples;
    error_.add(sums.error);
    magnitude_.add(sums.magnitude);
    square_.add(sums.square);
    if (!(sums.largest > largest_)) continue;
    largest_ = sums.largest;
    const auto at = std::find_if(part.begin(), part.end(), [&](double e) { return std::abs(e) == largest_; });
    worst = first + static_cast<std::size_t>(at - part.begin());
  }
  return worst;
}

void ErrorTally::finish(Measurement& result) const {
  result.samples = samples_;
  result.max_error = std::max(0.0, largest_);
  if (samples_ > 0) {
    const auto count = static_cast<double>(samples_);
    result.mean_error = error_.value() / count;
    result.mean_abs_error = magnitude_.value() / count;
    result.rmse = std::sqrt(square_.value() / count);
  }
  set_percentiles(histogram_, result);
}

Result<std::vector<double>> judge_block(const PointSet& block, const Mesh& mesh, double tolerance,
                                        const MeasureOptions& options) {
  grid::SnappedPoints places;
  places.at.resize(block.size());  // not read
  places.z = block.z;
  places.source.resize(block.size());
  std::iota(places.source.begin(), places.source.end(), 0);
  Box box;
  for (std::size_t i = 0; i < block.size(); ++i) box.include(block.x[i] - mesh.origin[0], block.y[i] - mesh.origin[1]);
  const Box near{box.x0 - tolerance, box.y0 - tolerance, box.x1 + tolerance, box.y1 + tolerance};
  std::vector<std::uint32_t> judged;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    Box of;
    for (std::size_t k = 0; k < 3; ++k) {
      const double* const p = &mesh.positions[3 * std::size_t{mesh.triangles[3 * std::size_t{t} + k]}];
      of.include(p[0], p[1]);
    }
    if (of.x0 <= near.x1 && of.x1 >= near.x0 && of.y0 <= near.y1 && of.y1 >= near.y0) judged.push_back(t);
  }
  ProgressGate gate(options.run.progress);
  const Judge judge(block, places, mesh, judged, box, tolerance);
  auto all = judge_all(judge, PointBounds(places, options), false, options.run.threads, gate);
  if (!all) return report_cancelled();
  return std::move(all->errors);
}

Result<Measurement> judge_points(const PointSet& points, const grid::SnappedPoints& snapped, const Mesh& mesh,
                                 const MeasureOptions& options) {
  SCARP_RETURN_IF_ERROR(check_mesh(mesh));
  SCARP_RETURN_IF_ERROR(check_options(points, options));
  ProgressGate gate(options.run.progress);

  Measurement result;
  result.vertices = mesh.vertex_count();
  result.triangles = mesh.triangle_count();
  std::vector<std::uint32_t> all, upward;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[3 * std::size_t{t}]}];
    const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[3 * std::size_t{t} + 1]}];
    const double* c = &mesh.positions[3 * std::size_t{mesh.triangles[3 * std::size_t{t} + 2]}];
    all.push_back(t);
    if ((b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])) upward.push_back(t);
  }
  Connections connections;
  const EdgeReport& edges = connections.edges;
  if (options.topology || upward.size() < all.size()) {
    connections = connect(mesh, upward.size() == all.size());
    result.closed = edges.open.empty();
  }
  const std::vector<std::uint32_t>& judged = result.closed ? upward : all;

  Box box;
  const auto include = [&](std::uint32_t source) {
    box.include(points.x[source] - mesh.origin[0], points.y[source] - mesh.origin[1]);
  };
  for (const std::uint32_t source : snapped.source) include(source);
  for (const grid::Echo& echo : snapped.echoes) include(echo.source);
  const double area = (box.x1 - box.x0) * (box.y1 - box.y0);
  const auto places = static_cast<double>(snapped.size() + snapped.echoes.size());
  const double tolerance = options.coverage_tolerance * std::sqrt(area / places);
  const Judge judge(points, snapped, mesh, judged, box, tolerance);

  const PointBounds bounds(snapped, options);
  // In lattice order, so that sums do not depend on the order of the points.
  auto all_errors = judge_all(judge, bounds, options.collect_above.has_value(), options.run.threads, gate);
  if (!all_errors) return report_cancelled();
  auto& [errors, triangles] = *all_errors;
  Offenders offenders;
  for (std::size_t point = 0; point < judge.size(); ++point) {
    const std::uint32_t source = judge.source_of(point);
    const double error = errors[point];
    result.uncovered += std::isnan(error);
    result.over_tolerance += std::abs(error) > bounds.own(source);
    if (!options.collect_above) continue;
    if (std::isnan(error)) {
      offenders.add_uncovered(source);
    } else if (std::abs(error) > bounds.at(source)) {
      offenders.add(triangles[point], source, error);
    }
  }
  result.offenders = offenders.finish();
  for (std::size_t point = 0; points.added > 0 && point < judge.size(); ++point) {
    if (judge.source_of(point) >= points.size() - points.added) errors[point] = kNone;
  }
  ErrorTally tally;
  if (const auto worst = tally.add(errors))
    result.max_error_at = {static_cast<std::int32_t>(judge.source_of(*worst)), 0};
  tally.finish(result);
  if (options.on_row) {
    std::vector<float> row(points.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t point = 0; point < errors.size(); ++point)
      row[judge.source_of(point)] = static_cast<float>(errors[point]);
    options.on_row(0, row);
  }

  if (options.topology) {
    if (!gate.go_on("topology", 0)) return report_cancelled();
    result.open_edges = edges.open.size();
    result.misoriented_edges = edges.misoriented;
    result.non_manifold_edges = edges.non_manifold;
    result.border_loops = edges.loops;
    count_faults(mesh, options.run.threads, result);
    measure_angles(mesh, judged, options.run.threads, result);
    result.t_junctions = count_t_junctions(mesh, connections);
    if (const auto rings = rings_of(points, options); !rings.empty()) {
      result.gaps = count_boundary_gaps(rings, mesh, edges.open, tolerance);
    } else if (!options.inlets || edges.loops > 1) {
      result.gaps = count_hull_gaps(points, snapped, mesh, edges.open, tolerance);
    }
    if (connections.is_single_layer) return result;
    bool is_stopped = false;
    result.overlaps = count_overlaps(mesh, judged, options.run.threads, [&](double fraction) {
      is_stopped = !gate.go_on("topology", fraction);
      return !is_stopped;
    });
    if (is_stopped) return report_cancelled();
  }
  return result;
}

}  // namespace scarp::judge

namespace scarp {

Result<Measurement> measure_points(const PointSet& points, const Mesh& mesh, DuplicatePolicy duplicates,
                                   const MeasureOptions& options) try {
  auto snapped = grid::snap_points(points, duplicates, grid::PointSteps::kJudge);
  if (!snapped) {
    Error error = snapped.error();
    if (!points.path.empty()) error.message = points.path + ": " + error.message;
    return tl::unexpected(std::move(error));
  }
  return judge::judge_points(points, *snapped, mesh, options);
} catch (...) {
  return caught(ErrorKind::kInput, "measure the mesh");
}

}  // namespace scarp
