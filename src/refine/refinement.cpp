#include "refine/refinement.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/sort.h"

namespace scarp::refine {

Refinement::Refinement(const metric::ErrorMetric& metric, tin::Triangulation& tin, Algorithm algorithm,
                       const EdgeRule& edges, Start start)
    : metric_(metric), tin_(tin), algorithm_(algorithm) {
  if (edges.data_dependent) rule_ = std::make_unique<DataDependentRule>(metric, edges);
  if (algorithm == Algorithm::kHeap) {
    candidates_ = std::make_unique<CandidateQueue>();
  } else {
    candidates_ = std::make_unique<CandidateList>();
  }
  for (tin::Triangle t = 0; t < tin.triangle_count(); ++t) inside_ += !tin.is_outside(t);
  if (start == Start::kScan) {
    rescan_all();
  } else {
    candidates_->grow(tin.triangle_count());
  }
}

Refinement::Look Refinement::look_at(tin::Triangle t) const {
  const metric::Fit fit = metric_.fit(tin_.corners(t), {});
  return {metric_.find_candidate(tin_.corners(t), fit), fit.scanned};
}

void Refinement::take(tin::Triangle t, const std::optional<metric::Candidate>& candidate) {
  if (candidate) {
    candidates_->set(t, *candidate);
  } else {
    candidates_->remove(t);
  }
}

void Refinement::rescan(tin::Triangle t) {
  if (tin_.is_outside(t)) return take(t, std::nullopt);
  if (rule_) return take(t, metric_.find_candidate(tin_.corners(t), rule_->fit_of(tin_, t)));
  const Look look = look_at(t);
  samples_ += look.samples;
  ++triangles_;
  take(t, look.candidate);
}

void Refinement::scan(std::span<const tin::Triangle> triangles, int threads) {
  struct Found {
    tin::Triangle triangle;
    metric::Candidate candidate;
  };
  struct Part {
    std::vector<Found> found;
    std::uint64_t samples = 0, triangles = 0;
  };
  constexpr std::size_t kTogether = 4096;
  std::vector<Part> parts((triangles.size() + kTogether - 1) / kTogether);
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    Part& part = parts[i];
    for (const tin::Triangle t :
         triangles.subspan(i * kTogether, std::min(kTogether, triangles.size() - i * kTogether))) {
      if (tin_.is_outside(t)) continue;
      const Look look = look_at(t);
      part.samples += look.samples;
      ++part.triangles;
      if (look.candidate) part.found.push_back({t, *look.candidate});
    }
  });
  for (const Part& part : parts) {
    samples_ += part.samples;
    triangles_ += part.triangles;
    for (const Found& found : part.found) candidates_->set(found.triangle, found.candidate);
  }
}

void Refinement::rescan_all() {
  candidates_->grow(tin_.triangle_count());
  for (tin::Triangle t = 0; t < tin_.triangle_count(); ++t) rescan(t);
}

std::uint32_t Refinement::gain(const tin::Triangulation::Location& location) const {
  const auto counts = [this](tin::HalfEdge h) { return h != tin::kNone && !tin_.is_outside(h / 3) ? 1u : 0u; };
  switch (location.kind) {
    case tin::Triangulation::Location::Kind::kInside:
      return 2 * counts(location.edge);
    case tin::Triangulation::Location::Kind::kOnEdge:
      return counts(location.edge) + counts(tin_.twin(location.edge));
    case tin::Triangulation::Location::Kind::kOnVertex:
      break;
  }
  return 0;
}

std::uint32_t Refinement::next_gain() const {
  const tin::Triangle t = candidates_->worst();
  return gain(tin_.locate_in(candidates_->candidate(t).at, t));
}

void Refinement::insert_worst() {
  const tin::Triangle t = candidates_->worst();
  const Point p = candidates_->candidate(t).at;
  insert_at(p, tin_.locate_in(p, t));
}

void Refinement::insert(Point p) { insert_at(p, tin_.locate(p, tin_.last_touched())); }

void Refinement::add(Point p, tin::Triangulation::Location location) {
  inside_ += gain(location);
  if (rule_) {
    rule_->insert(tin_, p, location);
    star_ = rule_->changed();
  } else {
    tin_.star(tin_.insert(p, location, flips_), star_);
  }
  candidates_->grow(tin_.triangle_count());
}

void Refinement::insert_at(Point p, tin::Triangulation::Location location) {
  add(p, location);
  ++passes_;
  if (algorithm_ == Algorithm::kBruteForce) return rescan_all();
  for (const tin::Triangle t : star_) rescan(t);
}

std::vector<Refinement::BatchCandidate> Refinement::collect(const Batch& batch) const {
  std::vector<BatchCandidate> found;
  if (done()) return found;
  std::vector<std::uint32_t> ids;
  candidates_->collect(batch.rule == Batch::Rule::kFraction ? batch.fraction * worst_error() : 0, ids);
  for (const tin::Triangle t : ids) found.push_back({candidates_->candidate(t), t});
  sort_rarely(found, [](const BatchCandidate& a, const BatchCandidate& b) {
    if (!(a.candidate.at == b.candidate.at) || a.candidate.error != b.candidate.error)
      return metric::is_worse(a.candidate, b.candidate);
    return a.triangle < b.triangle;
  });
  return found;
}

void Refinement::insert_unseen(Point p, tin::Triangle hint) {
  add(p, tin_.locate(p, hint));
  changed_.resize(tin_.triangle_count(), 0);
  for (const tin::Triangle t : star_) {
    if (changed_[t] == 0) unseen_.push_back(t);
    changed_[t] = 1;
  }
}

void Refinement::rescan_changed() {
  ++passes_;
  for (const tin::Triangle t : unseen_) {
    changed_[t] = 0;
    if (algorithm_ != Algorithm::kBruteForce) rescan(t);
  }
  unseen_.clear();
  if (algorithm_ == Algorithm::kBruteForce) rescan_all();
}

Work Refinement::work() const {
  Work work{samples_, triangles_, candidates_->moves(), passes_};
  if (rule_) {
    work.samples_scanned += rule_->samples_scanned();
    work.triangles_scanned += rule_->triangles_scanned();
  }
  return work;
}

}  // namespace scarp::refine
