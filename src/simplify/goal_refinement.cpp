#include "simplify/goal_refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pieces/locked_border.h"
#include "pieces/passes.h"
#include "refine/settle_edges.h"
#include "simplify/pass_work.h"

namespace scarp::run {

GoalRefinement::GoalRefinement(const pieces::Recipe& recipe, const grid::Raster& raster,
                               const metric::Criterion& criterion, std::span<const Point> border, Reporter& reporter)
    : recipe_(recipe),
      raster_(raster),
      options_(recipe.options),
      criterion_(criterion),
      border_(border),
      reporter_(reporter),
      budget_(recipe.options) {}

Result<void> GoalRefinement::start(Simplified& result) {
  const auto start = Clock::now();
  SCARP_TRY(auto&& domain, refine::build_domain(raster_, options_.domain.outline_tolerance, recipe_.field.frame));
  take(std::move(domain));
  insert_points();
  result.passes.push_back(pass_of("domain", seconds_since(start)));
  return {};
}

void GoalRefinement::start_with(refine::DomainMesh domain) {
  take(std::move(domain));
  note_sides();
}

Result<void> GoalRefinement::run(Simplified& result) {
  const auto start = Clock::now();
  refinement_.emplace(criterion_.metric(), piece_->tin, options_.strategy.algorithm, options_.strategy.edges);
  const char* culprit = !border_.empty() ? "the locked border and the outline of the valid data alone need"
                        : options_.features.points.empty() ? "the outline of the valid data alone needs"
                                                           : "the outline of the valid data and the points need";
  const char* advice = is_whole_ ? "" : ", or simplify the outline with an outline tolerance";
  SCARP_RETURN_IF_ERROR(budget_.check(size(), culprit, advice));
  SCARP_RETURN_IF_ERROR(refine(result.stop));
  finish_edges(result);
  result.passes.push_back(pass_of("refine", seconds_since(start), result.work));
  return {};
}

Result<void> GoalRefinement::run_on(Simplified& result) {
  const auto start = Clock::now();
  refinement_.emplace(criterion_.metric(), piece_->tin);
  auto refined = refine(result.stop);
  result.passes.push_back(pass_of("refine", seconds_since(start), refinement_->work()));
  return refined;
}

void GoalRefinement::release() {
  forget();
  piece_.reset();
}

void GoalRefinement::take(refine::DomainMesh domain) {
  is_whole_ = domain.whole;
  unused_ = domain.unused;
  piece_.emplace(pieces::Piece{raster_, 0, std::move(domain.tin)});
}

void GoalRefinement::note_sides() {
  if (!border_.empty()) on_sides_ = pieces::find_side_vertices(piece_->tin, raster_, 1);
}

void GoalRefinement::insert_points() {
  for (const Point p : border_) insert_seed(p);
  note_sides();
  for (const auto& [col, row] : options_.features.points) insert_seed({col, row});
  seeds_ = piece_->tin.vertex_count();
}

void GoalRefinement::insert_seed(Point p) {
  const tin::Triangulation& tin = piece_->tin;
  const auto location = tin.locate(p, tin.last_touched());
  const tin::HalfEdge twin =
      location.kind == tin::Triangulation::Location::Kind::kOnEdge ? tin.twin(location.edge) : tin::kNone;
  const bool inside = !tin.is_outside(location.edge / 3) || (twin != tin::kNone && !tin.is_outside(twin / 3));
  if (inside && raster_.is_valid(p)) piece_->tin.insert(p, location);
}

Result<void> GoalRefinement::check_border() const {
  if (border_.empty()) return {};
  std::vector<Point> expected = on_sides_;
  for (Point& p : expected) p = {p.x * piece_->lattice.steps, p.y * piece_->lattice.steps};
  if (pieces::find_side_vertices(piece_->tin, raster_, piece_->lattice.steps) == expected) return {};
  return fail(ErrorKind::kPromise,
              "the locked border cannot be kept: heights differ too much in magnitude for its line");
}

std::optional<StopReason> GoalRefinement::reached() const {
  if (refinement_->done()) return criterion_.has_error_goal() ? StopReason::kMaxError : StopReason::kExact;
  return exceeded(refinement_->next_gain());
}

Result<void> GoalRefinement::refine(StopReason& stop) {
  const double first_error = refinement_->worst_error();
  best_ = {piece_->tin.vertex_count(), in_last_stretch() ? first_error : std::numeric_limits<double>::infinity()};
  for (std::uint64_t step = 0;; ++step) {
    if (const auto reason = reached()) {
      stop = *reason;
      return {};
    }
    if (refinement_->is_full()) return fail(ErrorKind::kInput, pieces::kTooManyTriangles);
    if ((step < 1024 || step % 256 == 0 || options_.strategy.batch.rule != Batch::Rule::kSequential) &&
        reporter_.due() && !reporter_.report("refine", fraction(first_error), vertices(), refinement_->worst_error()))
      return fail(ErrorKind::kCancelled, "cancelled while refining");
    if (step % 256 == 0) {
      SCARP_RETURN_IF_ERROR(recipe_.memory.check_mesh(0, vertices(), fraction(first_error)));
    }
    if (const auto budget = take_step()) {
      stop = *budget;
      return {};
    }
    if (in_last_stretch() && refinement_->worst_error() <= best_.error)
      best_ = {piece_->tin.vertex_count(), refinement_->worst_error()};
  }
}

std::optional<StopReason> GoalRefinement::take_step() {
  if (options_.strategy.batch.rule != Batch::Rule::kSequential) return insert_batch();
  if (options_.strategy.importance.one_pass) return insert_ranked();
  refinement_->insert_worst();
  return std::nullopt;
}

std::optional<StopReason> GoalRefinement::insert_batch() {
  std::optional<StopReason> budget;
  for (const auto& [candidate, triangle] : refinement_->collect(options_.strategy.batch)) {
    if (options_.strategy.batch.rule == Batch::Rule::kIndependent && refinement_->has_changed(triangle)) continue;
    const std::uint32_t gain = refinement_->gain_near(candidate.at, triangle);
    if (gain == 0) continue;  // on an edge, named by both triangles
    budget = exceeded(gain);
    if (budget || refinement_->is_full()) break;
    refinement_->insert_unseen(candidate.at, triangle);
  }
  refinement_->rescan_changed();
  return budget;
}

std::optional<StopReason> GoalRefinement::insert_ranked() {
  if (!ranking_) ranking_ = criterion_.ranking();
  while (ranked_ < ranking_->size()) {
    const Point p = (*ranking_)[ranked_];
    const std::uint32_t gain = refinement_->gain_at(p);
    if (const auto budget = gain == 0 ? std::nullopt : exceeded(gain)) return budget;
    ++ranked_;
    if (gain == 0) continue;
    refinement_->insert(p);
    return std::nullopt;
  }
  refinement_->insert_worst();
  return std::nullopt;
}

double GoalRefinement::fraction(double first_error) const {
  const double goal = criterion_.has_error_goal() ? criterion_.metric().goal() : 0;
  return std::max(budget_.used(size()), error_progress(first_error, refinement_->worst_error(), goal));
}

bool GoalRefinement::in_last_stretch() const {
  return options_.strategy.best_of_budget && criterion_.importance_is_error() &&
         !options_.strategy.importance.one_pass && budget_.in_last_stretch(size());
}

void GoalRefinement::take_best_prefix() {
  if (refinement_->done() || std::isinf(best_.error) || best_.vertices == piece_->tin.vertex_count()) return;
  std::vector<Point> points;
  for (std::size_t v = seeds_; v < best_.vertices; ++v)
    points.push_back(piece_->tin.point(static_cast<tin::Vertex>(v)));
  refinement_.reset();
  take(*refine::build_domain(raster_, options_.domain.outline_tolerance, recipe_.field.frame));
  insert_points();
  std::optional<refine::DataDependentRule> rule;
  if (options_.strategy.edges.data_dependent) rule.emplace(criterion_.metric(), options_.strategy.edges);
  tin::Triangulation& tin = piece_->tin;
  for (Point p : points) {
    const auto location = tin.locate(p, tin.last_touched());
    rule ? rule->insert(tin, p, location) : tin.insert(p, location);
  }
}

void GoalRefinement::finish_edges(Simplified& result) {
  result.work = refinement_->work();
  take_best_prefix();
  const Work settling = refine::settle_edges(piece_->tin, criterion_.metric(), options_.strategy.edges,
                                             result.stop == StopReason::kMaxError || result.stop == StopReason::kExact);
  result.work.samples_scanned += settling.samples_scanned;
  result.work.triangles_scanned += settling.triangles_scanned;
}

Result<bool> GoalRefinement::mend(std::vector<Offender> offenders, Simplified& result) {
  if (!refinement_)
    refinement_.emplace(criterion_.metric(), piece_->tin, options_.strategy.algorithm, options_.strategy.edges,
                        refine::Refinement::Start::kClean);
  // If a vertex is among them, its rounding breaks the bound, and no other vertex can mend that.
  const auto is_vertex = [this](const Offender& o) { return refinement_->gain_at({o.col, o.row}) == 0; };
  // To remove a fold, any sample may be named.
  const auto is_useless = [&](const Offender& o) {
    return std::isinf(o.error) && (!raster_.is_valid({o.col, o.row}) || is_vertex(o));
  };
  if (recipe_.field.frame.space)
    offenders.erase(std::remove_if(offenders.begin(), offenders.end(), is_useless), offenders.end());
  const auto is_locked = [this](const Offender& o) {
    return !border_.empty() && (o.col == 0 || o.row == 0 || o.col == raster_.cols - 1 || o.row == raster_.rows - 1);
  };
  if (std::any_of(offenders.begin(), offenders.end(), is_locked)) return false;
  if (offenders.empty() || std::any_of(offenders.begin(), offenders.end(), is_vertex)) return false;
  std::optional<StopReason> budget;
  for (const Offender& o : offenders) {
    const std::uint32_t gain = refinement_->gain_at({o.col, o.row});
    if (gain == 0) continue;  // named by two triangles
    budget = exceeded(gain);
    if (budget) break;
    refinement_->insert({o.col, o.row});
  }
  if (budget) {
    result.stop = *budget;
    return true;
  }
  SCARP_RETURN_IF_ERROR(refine(result.stop));
  finish_edges(result);
  return true;
}

}  // namespace scarp::run
