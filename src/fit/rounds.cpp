#include "fit/rounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "fit/relocation.h"
#include "fit/removal.h"

namespace scarp::fit {

namespace {

/// Width, in edges, of the strip along earlier borders in which the last round of repair begins.
constexpr int kBorderWidth = 2;

/// Rises of the threshold, as logarithms. Removal then ends when a patch has the share of its triangles that the
/// budgets have of the mesh; before the last rise, it may end a little below. The last rise begins with an excess of at
/// most kNear and is larger than needed, because that share limits it; the one before aims at kBeforeLast.
constexpr double kLeastStep = 0.002, kLargestStep = 0.2, kNear = 0.02, kBeforeLast = 0.012, kGenerous = 1.4;
constexpr double kBeyond = 1.15;  // power of the share
constexpr double kLeastPower = 0.5, kLargestPower = 3;

/// Also marks the neighbours of marked nodes.
void spread(const Patch& patch, std::vector<std::uint8_t>& marks) {
  const std::vector<std::uint8_t> before = marks;
  for (Patch::Id f = 0; f < patch.face_count(); ++f) {
    const auto& [a, b, c] = patch.face(f).corners;
    if ((before[a] | before[b] | before[c]) != 0) marks[a] = marks[b] = marks[c] = 1;
  }
}

Freedom freedom_of(const grid::Raster& raster, const FitOptions& options) {
  const bool has_room =
      options.points != nullptr || std::max(raster.cols, raster.rows) <= kMaxCoordinate / grid::kLatticeSteps;
  return options.vertices_are_free && options.norm == nullptr && has_room ? Freedom::kLattice : Freedom::kSamples;
}

/// Limits vertices to the range of the samples.
void set_range(const grid::Raster& raster, const FitOptions& options, MoveRules& rules) {
  const ReadWindow& read = options.read;
  if (options.points != nullptr) {
    rules.lowest = options.points->lowest();
    rules.highest = options.points->highest();
    return;
  }
  rules.lowest = std::numeric_limits<float>::max();
  rules.highest = std::numeric_limits<float>::lowest();
  std::vector<float> buffer(read ? static_cast<std::size_t>(raster.cols) : 0);
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    if (read) read({{0, y}, raster.cols, 1}, buffer.data(), raster.cols);
    const float* const row = read ? buffer.data() : raster.row(y);
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      // Both are false for nodata.
      if (row[x] < rules.lowest) rules.lowest = row[x];
      if (row[x] > rules.highest) rules.highest = row[x];
    }
  }
}

double thin_share(const Patch& patch, const ShapeRule& rule) {
  std::size_t all = 0, thin = 0;
  for (Patch::Id f = 0; f < patch.face_count(); ++f) {
    const auto& [a, b, c] = patch.face(f).corners;
    if (a == tin::kNone) continue;
    ++all;
    if (rule.shape(patch.at(a), patch.at(b), patch.at(c)).form < rule.floor) ++thin;
  }
  return all == 0 ? 0 : static_cast<double>(thin) / static_cast<double>(all);
}

}  // namespace

Rounds::Rounds(const grid::Raster& raster, tin::Triangulation tin, grid::VertexLattice lattice,
               const FitOptions& options)
    : raster_(raster),
      options_(options),
      rules_{freedom_of(raster, options), options.shape.value_or(ShapeRule{options.min_shape, options.aspect})},
      fitted_{std::move(tin), {}, std::move(lattice)},
      vertices_(fitted_.tin.vertex_count()),
      settled_(fitted_.tin.vertex_count(), 0),
      held_(fitted_.tin.vertex_count(), 0),
      scratch_(static_cast<std::size_t>(thread_count(options.threads))),
      windows_(scratch_.size()) {
  fitted_.threshold = options.threshold;
  if (rules_.freedom == Freedom::kLattice) set_range(raster, options, rules_);
}

bool Rounds::raise_threshold(double left) {
  if (!options_.room) return false;
  const double share = wanted_share(), excess = std::log(left / share);
  if (excess <= 0 || fitted_.threshold >= options_.room->highest) return false;
  const bool is_stuck = left == 1 && excess_ && excess >= *excess_;
  if (left < 1) {
    excess_.reset();
  } else {
    if (excess_) power_ = std::clamp(((*excess_ - excess) / step_ + power_) / 2, kLeastPower, kLargestPower);
    excess_ = excess;
  }
  is_last_rise_ = left == 1 && excess < kNear;
  kept_ = is_last_rise_ || is_whole_ ? share : std::pow(share, kBeyond);
  const double before = step_;
  step_ = std::clamp((is_last_rise_ ? kGenerous * excess + kLeastStep : excess - kBeforeLast) / power_, kLeastStep,
                     kLargestStep);
  if (is_stuck) step_ = std::min(2 * before, kLargestStep);
  fitted_.threshold = std::min(fitted_.threshold * std::exp(step_), options_.room->highest);
  settled_.assign(settled_.size(), 0);
  return true;
}

double Rounds::wanted_share() const {
  const auto all = static_cast<double>(triangles()), vertices = static_cast<double>(fitted_.tin.vertex_count());
  // Each vertex adds two triangles, except on the sides.
  const double fewer = 2 * std::max(0.0, vertices - static_cast<double>(options_.room->most_vertices));
  return std::clamp(all - fewer, 1.0, std::max(1.0, static_cast<double>(options_.room->most_triangles))) /
         std::max(1.0, all);
}

std::size_t Rounds::most_of(const Patch& patch) const {
  return static_cast<std::size_t>(std::floor(kept_ * static_cast<double>(patch.count_faces()) * (1 + 0x1p-40)));
}

std::uint64_t Rounds::triangles() const {
  std::uint64_t count = 0;
  for (tin::Triangle t = 0; t < fitted_.tin.triangle_count(); ++t) count += fitted_.tin.is_outside(t) ? 0 : 1;
  return count;
}

bool Rounds::run(const PatchGrid& grid, double end, bool relocates) {
  return work_on(grid, end, relocates ? steps_of(relocation_freedom()) : fitted_.lattice.steps,
                 [&](Patch& patch, const std::vector<tin::Vertex>& vertices, const TriangleError& error) {
                   return remove(patch, vertices, error, relocates);
                 });
}

bool Rounds::repair(const PatchGrid& grid, double end, const RepairOptions& options, bool only_held) {
  return work_on(grid, end, steps_of(rules_.freedom),
                 [&](Patch& patch, const std::vector<tin::Vertex>& vertices, const TriangleError& error) {
                   // A single bound, outside the range of energies.
                   if (!error.has_energy()) return FitCounts{};
                   const std::vector<std::uint8_t> wanted =
                       only_held ? near_held(patch, vertices) : std::vector<std::uint8_t>();
                   RepairOptions here = options;
                   here.wanted = wanted;
                   here.most = most_of(patch);
                   here.rules = rules_of(patch);
                   const RepairCounts counts = repair_vertices(patch, error, here);
                   return FitCounts{counts.removed, 0, counts.removed, counts.tried};
                 });
}

bool Rounds::work_twice(const PatchGrid& grid, double end, Prepare prepare, Between between, Job job) {
  const PatchCutter cutter = this->cutter(grid);
  std::vector<Patch> patches(cutter.count());
  std::vector<std::vector<tin::Vertex>> vertices(cutter.count());
  const double begin = done_;
  if (!each_patch(cutter.count(), begin, (3 * begin + end) / 4, [&](std::size_t i, std::size_t worker) {
        patches[i] = cutter.cut(i, scratch_[worker], vertices[i]);
        prepare(patches[i], errors_of(patches[i], windows_[worker]));
      }))
    return false;
  between(patches);
  if (!each_patch(cutter.count(), done_, end, [&](std::size_t i, std::size_t worker) {
        if (is_worked_on(patches[i])) job(i, patches[i], errors_of(patches[i], windows_[worker]));
        patches[i].pack();
      }))
    return false;
  join(cutter, std::move(patches), std::move(vertices), steps_of(rules_.freedom));
  fitted_.counts.removed = vertices_ - std::min<std::uint64_t>(vertices_, fitted_.tin.vertex_count());
  return true;
}

MoveRules Rounds::rules_of(const Patch& patch) const {
  MoveRules rules = rules_;
  if (options_.floor_yields && thin_share(patch, rules.shape) > kThinShare) rules.shape.floor = 0;
  return rules;
}

Fitted Rounds::finish() {
  fitted_.is_cut_short = is_time_up();
  return std::move(fitted_);
}

/// Cuts patches, calls work(patch, vertices, error) for each, and joins them on a lattice of `steps` steps. work()
/// counts its changes.
bool Rounds::work_on(const PatchGrid& grid, double end, std::int32_t steps, Work work) {
  const PatchCutter cutter = this->cutter(grid);
  is_whole_ = grid.side >= std::max(raster_.cols, raster_.rows);
  std::vector<Patch> patches(cutter.count());
  std::vector<std::vector<tin::Vertex>> vertices(cutter.count());
  counts_.assign(cutter.count(), {});
  if (!each_patch(cutter.count(), done_, end, [&](std::size_t i, std::size_t worker) {
        patches[i] = cutter.cut(i, scratch_[worker], vertices[i]);
        if (!is_time_up() && is_worked_on(patches[i]))
          counts_[i] = work(patches[i], vertices[i], errors_of(patches[i], windows_[worker]));
        patches[i].pack();
      }))
    return false;
  hold_borders(vertices);
  join(cutter, std::move(patches), std::move(vertices), steps);
  return true;
}

/// Runs in parallel, and reports progress. Adds counts_ of each finished patch.
bool Rounds::each_patch(std::size_t count, double begin, double end,
                        FunctionRef<void(std::size_t i, std::size_t worker)> one) {
  bool goes_on = true;
  parallel_in_order(count, options_.threads, one, [&](std::size_t i) {
    if (i < counts_.size()) add(std::exchange(counts_[i], {}));
    goes_on = tell(begin + static_cast<double>(i + 1) / static_cast<double>(count) * (end - begin));
    return goes_on;
  });
  if (goes_on) done_ = end;
  return goes_on;
}

void Rounds::join(const PatchCutter& cutter, std::vector<Patch> patches, std::vector<std::vector<tin::Vertex>> vertices,
                  std::int32_t steps) {
  std::vector<tin::Vertex> numbers;
  grid::VertexLattice lattice{steps, {}, {}};
  tin::Triangulation joined = cutter.join(std::move(patches), std::move(vertices), numbers, lattice);
  renumber(numbers, joined.vertex_count());
  fitted_.tin = std::move(joined);
  fitted_.lattice = std::move(lattice);
}

std::int32_t Rounds::steps_of(Freedom freedom) const {
  return freedom == Freedom::kLattice ? grid::kLatticeSteps : fitted_.lattice.steps;
}

bool Rounds::is_worked_on(const Patch& patch) const {
  const Patch::Window& window = patch.window();
  return options_.most_window == 0 || std::int64_t{window.cols} * window.rows <= options_.most_window;
}

PatchCutter Rounds::cutter(const PatchGrid& grid) const {
  return {raster_, fitted_.tin, fitted_.lattice, grid, options_.free_sides, options_.threads, options_.points};
}

TriangleError Rounds::errors_of(const Patch& patch, SampleWindow& window) const {
  if (options_.points != nullptr) return window.errors(*options_.points, patch, fitted_.threshold);
  if (options_.read) return window.errors(options_.read, options_.read_bounds, patch, fitted_.threshold);
  return window.errors(raster_, options_.bounds, options_.norm, patch, fitted_.threshold);
}

void Rounds::add(const FitCounts& counts) {
  fitted_.counts.removed += counts.removed;
  fitted_.counts.searches += counts.searches;
  fitted_.counts.repaired += counts.repaired;
  fitted_.counts.tried += counts.tried;
}

/// Before rounds of repair, which move vertices off their samples, relocation to samples leaves fewer triangles.
Freedom Rounds::relocation_freedom() const { return options_.depth.rounds > 0 ? Freedom::kSamples : rules_.freedom; }

/// A vertex that is free in one patch is in no other, so patches write to separate elements.
FitCounts Rounds::remove(Patch& patch, const std::vector<tin::Vertex>& vertices, const TriangleError& error,
                         bool relocates) {
  std::vector<std::uint8_t> settled;
  settled.reserve(vertices.size());
  for (const tin::Vertex v : vertices) settled.push_back(settled_[v]);
  ShapeRule shape = rules_.shape;
  if (options_.floor_yields) shape.floor = 0;
  const std::size_t most = most_of(patch);
  RemovalCounts counts = remove_vertices(patch, error, shape, most, options_.is_time_up, settled);
  if (relocates && patch.count_faces() > most && error.has_energy() && !is_time_up()) {
    relocate_vertices(patch, error, {relocation_freedom(), shape, rules_.lowest, rules_.highest}, settled);
    const RemovalCounts more = remove_vertices(patch, error, shape, most, options_.is_time_up, settled);
    counts.removed += more.removed;
    counts.searches += more.searches;
  }
  for (Patch::Id v = 0; v < vertices.size(); ++v) {
    if (!patch.is_locked(v)) settled_[vertices[v]] = settled[v];
  }
  return {counts.removed, counts.searches, 0, 0};
}

/// Vertices in more than one patch were on a border.
void Rounds::hold_borders(const std::vector<std::vector<tin::Vertex>>& vertices) {
  std::vector<bool> is_seen(held_.size(), false);
  for (const std::vector<tin::Vertex>& of_patch : vertices) {
    for (const tin::Vertex v : of_patch) {
      if (is_seen[v]) held_[v] = 1;
      is_seen[v] = true;
    }
  }
}

std::vector<std::uint8_t> Rounds::near_held(const Patch& patch, const std::vector<tin::Vertex>& vertices) const {
  std::vector<std::uint8_t> marks;
  marks.reserve(vertices.size());
  for (const tin::Vertex v : vertices) marks.push_back(held_[v]);
  for (int i = 0; i < kBorderWidth; ++i) spread(patch, marks);
  return marks;
}

/// New vertices are neither settled nor held.
void Rounds::renumber(const std::vector<tin::Vertex>& numbers, std::size_t count) {
  for (std::vector<std::uint8_t>* of_vertices : {&settled_, &held_}) {
    std::vector<std::uint8_t> now(count, 0);
    for (tin::Vertex v = 0; v < of_vertices->size(); ++v) {
      if (numbers[v] != tin::kNone) now[numbers[v]] = (*of_vertices)[v];
    }
    *of_vertices = std::move(now);
  }
}

}  // namespace scarp::fit
