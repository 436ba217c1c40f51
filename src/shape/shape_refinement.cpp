#include "shape/shape_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "grid/bands.h"
#include "shape/plan_metric.h"
#include "shape/plan_shapes.h"
#include "shape/point_bench.h"
#include "shape/raster_bench.h"
#include "shape/shape_faults.h"
#include "shape/shape_need.h"
#include "shape/size_field.h"

namespace scarp::shape {

namespace {

using Vector = PlanMetric::Vector;
using Location = tin::Triangulation::Location;

constexpr double kShapeSlack = 1e-3;     ///< degrees, and share of lengths, reserved for rounding of positions
constexpr double kClosest = 1.0 / 32;    ///< in samples: least distance of vertices added for angles
constexpr double kAnyLength = 0;         ///< least length of the halves of an edge that is too long
constexpr double kFinestSize = 0.5;      ///< in samples: the smallest size with a grade
constexpr double kSnapShare = 1.0 / 12;  ///< upper bound of lattice step / distance to the nearest vertices

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1]}; }
double dot_of(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }

class ShapeRefiner {
 public:
  /// `last`: the last corner of the lattice's rectangle. `spacing`: distance of samples.
  ShapeRefiner(ShapeBench& bench, tin::Triangulation& tin, const ShapeTask& task, const PlanMetric& metric,
               const grid::Bands& bands, Point last, double spacing)
      : bench_(bench),
        bands_(bands),
        tin_(tin),
        task_(task),
        metric_(metric),
        shapes_(tin, metric_, squares_of(task.goals.min_angle + kShapeSlack).cosine),
        last_(last),
        spacing_(spacing),
        least_(kClosest * spacing) {
    if (const auto& longest = task.goals.max_edge) {
      longest2_ = *longest * *longest * (1 - kShapeSlack);
      least_ = std::min(least_, *longest / 4);
    }
    least_for_size_ = std::max(least_, task.goals.min_edge.value_or(0));
    const SquaredAngle half = squares_of((task.goals.min_angle + kShapeSlack) / 2);
    off_centre_ = 0.475 * std::sqrt(half.cosine / half.sine);
  }

  Result<ShapeWork> run() {
    note_all();
    if (task_.goals.grade) {
      sizes_.emplace(tin_, metric_, *task_.goals.grade, kFinestSize * std::max(metric_.longer_side(), spacing_));
      sizes_->measure_all(out_);
    }
    if (const double least = least_triangles(tin_, metric_, task_.goals, sizes_ ? &*sizes_ : nullptr); task_.foresee) {
      SCARP_RETURN_IF_ERROR(task_.foresee(least));
    }
    for (std::uint64_t before = work_.insertions + 1; before != work_.insertions;) {
      before = work_.insertions;
      SCARP_RETURN_IF_ERROR(bench_.is_streamed() ? sweep_bands() : sweep_all());
    }
    work_.samples_scanned = bench_.samples_scanned();
    work_.triangles_scanned = bench_.triangles_scanned();
    return work_;
  }

 private:
  Result<void> sweep_all() {
    for (tin::Triangle t = 0; t < tin_.triangle_count(); ++t) enqueue(t);
    return work_off();
  }

  /// Scans all triangles in the first sweep, and only bad triangles later.
  Result<void> sweep_bands() {
    const bool is_first = waiting_.empty();
    waiting_.assign(bands_.count(), {});
    for (tin::Triangle t = 0; t < tin_.triangle_count(); ++t) {
      if (is_first ? !tin_.is_outside(t) : find_fault(t).has_value()) waiting_[bands_.at(row_of(t))].push(t);
    }
    for (band_ = 0; band_ < bands_.count(); ++band_) {
      const std::vector<tin::Triangle> here = waiting_[band_].take();
      if (here.empty()) continue;
      bench_.hold(band_);
      for (const tin::Triangle t : here) {
        // A triangle that is no longer in the band was changed, and scanned then.
        if (is_first && bands_.at(row_of(t)) == band_) bench_.scan(t);
        enqueue(t);
      }
      if (is_first) share_ = static_cast<double>(band_ + 1) / static_cast<double>(bands_.count());
      SCARP_RETURN_IF_ERROR(work_off());
    }
    share_ = 1;
    return {};
  }

  Result<void> work_off() {
    for (std::uint64_t step = 0; !bench_.done() || !bad_.empty(); ++step) {
      if (bench_.is_full())
        return fail(ErrorKind::kInput,
                    "the mesh would have more than 1,431 million triangles: ask for larger angles or edges");
      if (step % 64 == 0 && task_.progress) {
        SCARP_RETURN_IF_ERROR(task_.progress(share_, tin_.vertex_count(), bench_.worst_error()));
      }
      if (!bench_.done()) {
        bench_.insert_worst();
        note_insertion();
        continue;
      }
      const ShapeFault bad = bad_.pop();
      if (corners_of(bad.triangle) != bad.corners || !find_fault(bad.triangle)) continue;
      const bool helped = bad.is_long ? shorten(bad.triangle) : blunt(bad.triangle);
      if (helped && corners_of(bad.triangle) == bad.corners) enqueue(bad.triangle);
    }
    return {};
  }

  // ---- Finding faults -----------------------------------------------------------------------------------------------

  std::array<tin::Vertex, 3> corners_of(tin::Triangle t) const {
    return {tin_.origin(3 * t), tin_.origin(3 * t + 1), tin_.origin(3 * t + 2)};
  }
  double square(tin::HalfEdge h) const { return shapes_.square(h); }
  tin::HalfEdge shortest(tin::Triangle t) const { return shapes_.shortest(t); }
  bool is_wall(tin::HalfEdge h) const { return shapes_.is_wall(h); }
  /// The row of samples at the triangle's centre.
  std::int32_t row_of(tin::Triangle t) const {
    const auto [a, b, c] = tin_.corners(t);
    return static_cast<std::int32_t>((std::int64_t{a.y} + b.y + c.y) / (3 * grid::kLatticeSteps));
  }
  tin::Vertex opposite(tin::HalfEdge h) const { return tin_.origin(tin::Triangulation::previous(h)); }

  /// The squared ratio of length to allowed length.
  double excess(tin::HalfEdge h) const {
    const double length2 = square(h);
    double excess = length2 / longest2_;
    if (sizes_) {
      const double size = std::max(sizes_->at(tin_.origin(h)), sizes_->at(tin_.origin(tin::Triangulation::next(h))));
      excess = std::max(excess, length2 / (kGradeFactor * kGradeFactor * (1 - kShapeSlack) * size * size));
    }
    return excess;
  }
  std::optional<ShapeFault> find_fault(tin::Triangle t) const {
    if (tin_.is_outside(t)) return std::nullopt;
    const double most = std::max({excess(3 * t), excess(3 * t + 1), excess(3 * t + 2)});
    if (most > 1) return ShapeFault{true, most, t, corners_of(t)};
    if (task_.goals.min_angle == 0 || !shapes_.is_sharp(t) || shapes_.is_forced(t)) return std::nullopt;
    return ShapeFault{false, -square(shortest(t)), t, corners_of(t)};
  }
  void enqueue(tin::Triangle t) {
    const auto bad = find_fault(t);
    if (!bad) return;
    if (!bench_.is_streamed() || bands_.reaches(band_, row_of(t))) {
      bad_.push(*bad);
      if (bad_.size() > 2 * tin_.triangle_count())
        bad_.clean([this](const ShapeFault& fault) { return corners_of(fault.triangle) == fault.corners; });
    } else if (const std::size_t band = bands_.at(row_of(t)); band > band_) {
      waiting_[band].push(t);
    }
  }

  /// True for an edge with surface on both sides.
  bool is_line(tin::HalfEdge h) const { return tin_.twin(h) != tin::kNone && !tin_.is_outside(tin_.twin(h) / 3); }

  // ---- Repairing faults ---------------------------------------------------------------------------------------------

  bool shorten(tin::Triangle t) {
    const tin::HalfEdge h = std::max({3 * t, 3 * t + 1, 3 * t + 2},
                                     [&](tin::HalfEdge a, tin::HalfEdge b) { return excess(a) < excess(b); });
    if (is_wall(h)) return split_wall(h, kAnyLength);
    return insert_near(t, std::numeric_limits<double>::infinity(), least_for_size_) || split_free(h);
  }
  bool blunt(tin::Triangle t) {
    return insert_near(t, off_centre_ * std::sqrt(square(shortest(t))), least_) ||
           insert_near(t, std::numeric_limits<double>::infinity(), least_);
  }

  /// Inserts a vertex towards the triangle's circumcentre, at most `reach` from its shortest edge and at least `least`
  /// from all other vertices. False if none was inserted.
  bool insert_near(tin::Triangle t, double reach, double least) {
    const tin::HalfEdge h = shortest(t);
    const Point a = tin_.point(tin_.origin(h)), b = tin_.point(tin_.origin(tin::Triangulation::next(h))),
                c = tin_.point(opposite(h));
    const Vector ab = metric_.between(a, b), ac = metric_.between(a, c);
    const double area = ab[0] * ac[1] - ab[1] * ac[0], ab2 = dot_of(ab, ab), ac2 = dot_of(ac, ac);
    const Vector centre{(ac[1] * ab2 - ab[1] * ac2) / (2 * area), (ab[0] * ac2 - ac[0] * ab2) / (2 * area)};
    Vector up = minus(centre, {ab[0] / 2, ab[1] / 2});
    const double height = std::sqrt(dot_of(up, up));
    if (height > reach) up = {up[0] * reach / height, up[1] * reach / height};
    const Vector at = metric_.to_lattice({ab[0] / 2 + up[0], ab[1] / 2 + up[1]});
    const double radius = std::sqrt(ab2 / 4 + dot_of(up, up));
    const Vector from{(double(a.x) + b.x + c.x) / 3, (double(a.y) + b.y + c.y) / 3};
    const Point p = lattice_point_near(from, {a.x + at[0], a.y + at[1]}, radius / metric_.longer_side());
    return insert_free(t, from, p, least);
  }

  /// A point on the lattice and in the rectangle, on coarse steps if `radius`, in samples, is large.
  Point lattice_point_near(const Vector& from, const Vector& wanted, double radius) const {
    const Vector far{double(last_.x), double(last_.y)};
    double share = 1;
    for (std::size_t k = 0; k < 2; ++k) {
      const double limit = wanted[k] < 0 ? 0 : far[k];
      if (wanted[k] < 0 || wanted[k] > far[k]) share = std::min(share, (limit - from[k]) / (wanted[k] - from[k]));
    }
    std::int32_t step = 1;
    while (step < grid::kLatticeSteps && 2 * step <= radius * grid::kLatticeSteps * kSnapShare) step *= 2;
    const auto snap = [&](std::size_t k) {
      const double at = std::floor((from[k] + share * (wanted[k] - from[k])) / step + 0.5) * step;
      return static_cast<std::int32_t>(std::clamp(at, 0.0, far[k]));
    };
    return {snap(0), snap(1)};
  }

  /// The triangle that contains p, or the wall that hides p from `from` in t.
  struct Sight {
    tin::Triangle triangle = tin::kNone;
    tin::HalfEdge wall = tin::kNone;
  };
  Sight look(tin::Triangle t, const Vector& from, Point p) const {
    const Vector ahead{p.x - from[0], p.y - from[1]};
    const auto is_left = [&](tin::Vertex v) {
      const Point q = tin_.point(v);
      return ahead[0] * (q.y - from[1]) - ahead[1] * (q.x - from[0]) > 0;
    };
    tin::HalfEdge entered = tin::kNone;
    for (std::size_t step = 0; step < tin_.triangle_count(); ++step) {
      tin::HalfEdge exit = tin::kNone;
      for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (h == entered ||
            orient(tin_.point(tin_.origin(h)), tin_.point(tin_.origin(tin::Triangulation::next(h))), p) >= 0)
          continue;
        // If p is beyond two edges, the segment crosses one of them, left or right of their common corner.
        if (exit == tin::kNone) {
          exit = h;
        } else if (tin::Triangulation::next(exit) == h) {
          exit = is_left(tin_.origin(h)) ? exit : h;
        } else {
          exit = is_left(tin_.origin(exit)) ? h : exit;
        }
      }
      if (exit == tin::kNone) return {t, tin::kNone};
      if (is_wall(exit)) return {tin::kNone, exit};
      entered = tin_.twin(exit);
      t = entered / 3;
    }
    return {};  // lost by rounding
  }

  /// The triangles that inserting p would remove, and the walls around them whose diametral circles contain p, longest
  /// first.
  struct Cavity {
    double nearest2 = std::numeric_limits<double>::infinity();
    std::vector<tin::HalfEdge> encroached;
  };
  Cavity cavity_of(Point p, const Location& location) {
    Cavity cavity;
    seen_.resize(tin_.triangle_count(), 0);
    std::vector<tin::Triangle> found{location.edge / 3};
    if (location.kind == Location::Kind::kOnEdge) found.push_back(tin_.twin(location.edge) / 3);
    for (const tin::Triangle t : found) seen_[t] = 1;
    for (std::size_t k = 0; k < found.size(); ++k) {
      for (tin::HalfEdge h = 3 * found[k]; h < 3 * found[k] + 3; ++h) {
        const Point a = tin_.point(tin_.origin(h)), b = tin_.point(tin_.origin(tin::Triangulation::next(h)));
        cavity.nearest2 = std::min(cavity.nearest2, metric_.square(p, a));
        if (is_wall(h)) {
          if (metric_.dot(p, a, b) < 0) cavity.encroached.push_back(h);
          continue;
        }
        const tin::Triangle beyond = tin_.twin(h) / 3;
        if (seen_[beyond] != 0 || !metric_.is_in_circle(tin_.corners(beyond), p)) continue;
        seen_[beyond] = 1;
        found.push_back(beyond);
      }
    }
    for (const tin::Triangle t : found) seen_[t] = 0;
    std::stable_sort(cavity.encroached.begin(), cavity.encroached.end(),
                     [&](tin::HalfEdge a, tin::HalfEdge b) { return square(a) > square(b); });
    return cavity;
  }

  bool insert_free(tin::Triangle t, const Vector& from, Point p, double least) {
    const Sight sight = look(t, from, p);
    if (sight.wall != tin::kNone) return split_wall(sight.wall, least);
    if (sight.triangle == tin::kNone) return false;
    const Location location = tin_.locate_in(p, sight.triangle);
    if (location.kind == Location::Kind::kOnVertex) return false;
    if (location.kind == Location::Kind::kOnEdge && is_wall(location.edge)) return split_wall(location.edge, least);
    const Cavity cavity = cavity_of(p, location);
    for (const tin::HalfEdge wall : cavity.encroached) {
      if (split_wall(wall, least)) return true;
    }
    return cavity.nearest2 >= least * least && insert_in_surface(p, location);
  }

  bool insert_in_surface(Point p, const Location& location) {
    if (!bench_.insert(p, location)) return false;
    note_insertion();
    return true;
  }

  bool split_free(tin::HalfEdge h) {
    const Point a = tin_.point(tin_.origin(h)), b = tin_.point(tin_.origin(tin::Triangulation::next(h)));
    const auto p = beside({(double(a.x) + b.x) / 2, (double(a.y) + b.y) / 2}, h);
    return p && insert_in_surface(*p, {Location::Kind::kOnEdge, std::min(h, tin_.twin(h))});
  }

  /// The lattice point nearest to `wanted` with which the two triangles of an edge become four positive triangles.
  std::optional<Point> beside(const Vector& wanted, tin::HalfEdge h) const {
    const Point a = tin_.point(tin_.origin(h)), b = tin_.point(tin_.origin(tin::Triangulation::next(h))),
                c = tin_.point(opposite(h)), d = tin_.point(opposite(tin_.twin(h)));
    const auto x = static_cast<std::int32_t>(std::floor(wanted[0])),
               y = static_cast<std::int32_t>(std::floor(wanted[1]));
    std::optional<Point> best;
    double least = std::numeric_limits<double>::infinity();
    for (const Point p : {Point{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}}) {
      const Vector off{p.x - wanted[0], p.y - wanted[1]};
      const double distance = dot_of(off, off);
      if (distance >= least || orient(b, c, p) <= 0 || orient(c, a, p) <= 0 || orient(a, d, p) <= 0 ||
          orient(d, b, p) <= 0)
        continue;
      best = p;
      least = distance;
    }
    return best;
  }

  /// Halves a wall approximately if both halves have at least the least length. False if no vertex was inserted.
  bool split_wall(tin::HalfEdge h, double least) {
    if (tin_.is_outside(h / 3)) h = tin_.twin(h);
    if (square(h) < 4 * least * least) return false;
    const tin::Vertex from = tin_.origin(h), to = tin_.origin(tin::Triangulation::next(h));
    const Point a = tin_.point(from), b = tin_.point(to);
    const double share = share_of_split(h);
    // The outline of the valid data must not move. Along a cutline, few lattice points are exactly on the edge.
    std::optional<Point> p;
    if (!is_line(h)) p = on_outline(a, b, share);
    const bool bends = !p && tin_.twin(h) != tin::kNone;
    std::pair<Point, Point> line{a, b};
    if (bends) {
      for (const tin::Vertex v : {from, to}) {
        if (const auto bent = lines_.find(v); bent != lines_.end()) line = bent->second;
      }
      p = beside_line(line, h, share, least == kAnyLength ? 0.25 : 0);
    }
    if (!p) return false;
    if (bends) lines_[static_cast<tin::Vertex>(tin_.vertex_count())] = line;
    bench_.insert_on_edge(*p, h, std::sqrt(metric_.square(a, *p) / square(h)));
    note_insertion();
    return true;
  }

  /// The lattice point beside() a line that contains the edge. Few lattice points are possible next to existing
  /// vertices on the line: returns the one nearest to the wanted share, at most `leeway` from it.
  std::optional<Point> beside_line(const std::pair<Point, Point>& line, tin::HalfEdge h, double share,
                                   double leeway) const {
    constexpr int kTries = 512;
    const Point a = tin_.point(tin_.origin(h)), b = tin_.point(tin_.origin(tin::Triangulation::next(h)));
    for (int k = 0; k < (leeway > 0 ? kTries : 1); ++k) {
      const double at = share + (k % 2 == 0 ? 1 : -1) * leeway * ((k + 1) / 2) * 2 / kTries;
      if (const auto p = beside(on_line(line, {a.x + at * (b.x - a.x), a.y + at * (b.y - a.y)}), h)) return p;
    }
    return std::nullopt;
  }

  /// One half; at an acute corner, the share that makes the length from the corner a power of two.
  double share_of_split(tin::HalfEdge h) const {
    const tin::Vertex from = tin_.origin(h), to = tin_.origin(tin::Triangulation::next(h));
    const bool begins = is_acute(from, to), ends = is_acute(to, from);
    if (begins == ends) return 0.5;
    const double length = std::sqrt(square(h));
    double shell = metric_.shorter_side() / grid::kLatticeSteps;
    while (1.5 * shell < length / 2) shell *= 2;
    const double share = std::clamp(shell / length, 0.25, 0.75);
    return begins ? share : 1 - share;
  }
  /// True if another wall begins at v, less than 45 degrees from the one to w.
  bool is_acute(tin::Vertex v, tin::Vertex w) const {
    const Point apex = tin_.point(v), end = tin_.point(w);
    bool found = false;
    visit_around(tin_, out_[v], [&](tin::HalfEdge out) {
      if (tin_.is_outside(out / 3)) return;
      for (const auto& [side, u] : {std::pair{out, tin_.origin(tin::Triangulation::next(out))},
                                    std::pair{tin::Triangulation::previous(out), opposite(out)}}) {
        if (u == w || !is_wall(side)) continue;
        const double squares = metric_.square(apex, end) * square(side);
        found = found || is_sharper(metric_.dot(apex, end, tin_.point(u)), squares, kAcute);
      }
    });
    return found;
  }

  static Vector on_line(const std::pair<Point, Point>& line, const Vector& near) {
    const Vector a{double(line.first.x), double(line.first.y)};
    const Vector way{double(line.second.x) - a[0], double(line.second.y) - a[1]};
    const double along = dot_of(minus(near, a), way) / dot_of(way, way);
    return {a[0] + along * way[0], a[1] + along * way[1]};
  }

  /// A lattice point exactly between a and b: a sample if samples are fine enough.
  std::optional<Point> on_outline(Point a, Point b, double share) const {
    const std::int32_t units = std::gcd(std::abs(b.x - a.x), std::abs(b.y - a.y));
    if (units < 2) return std::nullopt;
    const Point unit{(b.x - a.x) / units, (b.y - a.y) / units};
    std::int32_t step = 1;
    while (step < grid::kLatticeSteps && 2 * step <= units * kSnapShare) step *= 2;
    // Multiples of the step are counted from the raster's corner, as for other lattice points.
    const std::int32_t begin = unit.x != 0 ? a.x * (unit.x < 0 ? -1 : 1) : a.y * (unit.y < 0 ? -1 : 1);
    const double at = std::floor((begin + share * units) / step + 0.5) * step - begin;
    const auto k = static_cast<std::int32_t>(std::clamp(at, 1.0, units - 1.0));
    return Point{a.x + k * unit.x, a.y + k * unit.y};
  }

  // ---- Bookkeeping -------------------------------------------------------------------------------------------------

  void note_all() {
    out_.resize(tin_.vertex_count());
    for (tin::HalfEdge h = 0; h < 3 * tin_.triangle_count(); ++h) out_[tin_.origin(h)] = h;
  }
  void note_insertion() {
    ++work_.insertions;
    out_.resize(tin_.vertex_count());
    for (const tin::Triangle t : bench_.changed()) {
      for (tin::HalfEdge h = 3 * t; h < 3 * t + 3; ++h) out_[tin_.origin(h)] = h;
    }
    if (sizes_) {
      fallen_.clear();
      sizes_->update(bench_.changed(), out_, fallen_);
      for (const tin::Vertex v : fallen_) visit_around(tin_, out_[v], [&](tin::HalfEdge h) { enqueue(h / 3); });
    }
    for (const tin::Triangle t : bench_.changed()) enqueue(t);
  }

  ShapeBench& bench_;
  const grid::Bands& bands_;
  tin::Triangulation& tin_;
  const ShapeTask& task_;
  const PlanMetric& metric_;
  PlanShapes shapes_;
  Point last_;
  double spacing_, least_, least_for_size_ = 0, longest2_ = std::numeric_limits<double>::infinity(), off_centre_ = 0;
  std::optional<SizeField> sizes_;
  ShapeFaults bad_;
  std::size_t band_ = 0;
  double share_ = 1;                                                ///< fraction of bands processed
  std::vector<WaitingTriangles> waiting_;                           ///< by band
  std::vector<tin::HalfEdge> out_;                                  ///< by vertex: a half-edge that begins there
  std::unordered_map<tin::Vertex, std::pair<Point, Point>> lines_;  ///< by vertex that halves a line: the line's ends
  std::vector<tin::Vertex> fallen_;
  std::vector<std::uint8_t> seen_;
  ShapeWork work_;
};

}  // namespace

std::optional<fit::ShapeRule> shape_rule(const ShapeGoals& goals, const Frame& frame) {
  const auto& a = frame.affine;
  if (goals.grade || a[1] * a[2] + a[4] * a[5] != 0) return std::nullopt;
  const double width = std::sqrt(a[1] * a[1] + a[4] * a[4]), height = std::sqrt(a[2] * a[2] + a[5] * a[5]);
  fit::ShapeRule rule;
  rule.by_angle = true;
  rule.aspect = height / width;
  // Without a smallest angle, any triangle with an area is valid, unless a shortest edge is requested, as for
  // simulations.
  constexpr double kUsualAngle = 5;
  const double angle = goals.min_edge && goals.min_angle == 0 ? kUsualAngle : goals.min_angle;
  rule.floor = std::max(squares_of(angle + kShapeSlack).sine, std::numeric_limits<double>::min());
  if (goals.min_edge) {
    const double shortest = *goals.min_edge / width * grid::kLatticeSteps;
    rule.shortest_square = shortest * shortest * (1 + kShapeSlack);
    rule.edge_first = goals.min_angle == 0;
  }
  if (!goals.max_edge) return rule;
  const double longest = *goals.max_edge / width * grid::kLatticeSteps;
  rule.longest_square = longest * longest * (1 - kShapeSlack);
  return rule;
}

Result<ShapeWork> refine_shapes(const grid::Raster& raster, tin::Triangulation& tin, grid::VertexLattice& lattice,
                                const ShapeTask& task) {
  const PlanMetric metric(task.affine, grid::kLatticeSteps);
  const grid::Bands bands{raster.rows, std::max(task.rows_at_once / 2, 1)};
  PlanDelaunay delaunay(metric);
  RasterBench bench(raster, tin, lattice, task, bands, delaunay);
  const Point last{(raster.cols - 1) * grid::kLatticeSteps, (raster.rows - 1) * grid::kLatticeSteps};
  auto work = ShapeRefiner(bench, tin, task, metric, bands, last, metric.shorter_side()).run();
  if (work) lattice = bench.lattice(task.all_may_go);
  return work;
}

namespace {

/// A frame with samples that are kLatticeSteps steps of the points' lattice apart.
Frame frame_of(const grid::PointLattice& lattice) {
  const double cell = grid::kLatticeSteps * lattice.step;
  Frame frame;
  frame.affine = {lattice.west, cell, 0, lattice.north, 0, -cell};
  return frame;
}

}  // namespace

Result<ShapeWork> refine_shapes(const grid::SnappedPoints& points, std::span<const double> heights,
                                refine::ScatteredDomain& domain, const ShapeGoals& goals, double threshold,
                                std::span<const double> bounds, Reporter& reporter) {
  ShapeTask task{goals, frame_of(points.lattice).affine, threshold};
  task.progress = [&](double, std::uint64_t count, double error) -> Result<void> {
    if (!reporter.due() || reporter.report("shape", 0, count, error)) return {};
    return fail(ErrorKind::kCancelled, "cancelled while refining shapes");
  };
  task.foresee = [](double triangles) { return check_need(triangles, {}, 0); };
  const PlanMetric metric(task.affine, grid::kLatticeSteps);
  const grid::Bands bands{1, 1};
  PlanDelaunay delaunay(metric);
  restore_delaunay(domain.tin, delaunay);
  PointBench bench(points, heights, domain, threshold, bounds);
  const Point last{points.lattice.cols - 1, points.lattice.rows - 1};
  const double spacing = points.lattice.step * std::sqrt(double(last.x) * last.y / static_cast<double>(points.size()));
  return ShapeRefiner(bench, domain.tin, task, metric, bands, last, spacing).run();
}

std::optional<fit::ShapeRule> shape_rule(const ShapeGoals& goals, const grid::PointLattice& lattice) {
  return shape_rule(goals, frame_of(lattice));
}

ShapeReport report_shapes(const Mesh& mesh, const ShapeGoals& goals, const tin::Triangulation& tin,
                          const grid::PointLattice& lattice) {
  return report_shapes(mesh, goals, count_losses(tin, grid::kLatticeSteps, frame_of(lattice), goals));
}

}  // namespace scarp::shape
