#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "fit/removal.h"
#include "fit/sample_window.h"
#include "fit/schedule.h"

namespace scarp {

namespace {

/// Rounds beyond those that were asked for end with two in a row that take away less than this share of the vertices.
constexpr double kWorthARound = 1e-3;
constexpr int kPoorRounds = 2;

/// How far from the borders of patches the last round of repair begins, in edges.
constexpr int kBorderWidth = 2;

/// Whether the mesh is one patch.
bool is_small(const Triangulation& tin) { return tin.triangle_count() <= 2 * kPatchTriangles; }

/// Side of squares of some kPatchTriangles, or of shorter pieces of a narrow raster.
std::int32_t patch_side(const Raster& raster, const Triangulation& tin) {
  const double cols = raster.cols, rows = raster.rows;
  const double area = cols * rows * kPatchTriangles / static_cast<double>(tin.triangle_count());
  const double side = std::max(std::sqrt(area), area / std::min(cols, rows));
  return std::clamp(static_cast<std::int32_t>(side), 2, std::max(raster.cols, raster.rows));
}

/// Marks the neighbours of marked nodes too.
void spread(const Patch& patch, std::vector<std::uint8_t>& marks) {
  const std::vector<std::uint8_t> before = marks;
  for (Patch::Id f = 0; f < patch.face_count(); ++f) {
    const auto& [a, b, c] = patch.face(f).corners;
    if ((before[a] | before[b] | before[c]) != 0) marks[a] = marks[b] = marks[c] = 1;
  }
}

/// Whether errors have energies somewhere.
bool has_energies(const FitOptions& options) {
  const auto has = [](double bound) { return bound > 0x1p-60 && bound < 0x1p60; };
  if (options.read_bounds) return true;
  return options.bounds.empty() ? has(options.threshold)
                                : std::any_of(options.bounds.begin(), options.bounds.end(), has);
}

Freedom freedom_of(const Raster& raster, const FitOptions& options) {
  const bool has_room = std::max(raster.cols, raster.rows) <= kMaxCoordinate / kLatticeSteps;
  return options.vertices_are_free && options.norm == nullptr && has_room ? Freedom::kLattice : Freedom::kSamples;
}

/// Lets vertices be as low and as high as samples are.
void set_range(const Raster& raster, const ReadWindow& read, MoveRules& rules) {
  rules.lowest = std::numeric_limits<float>::max();
  rules.highest = std::numeric_limits<float>::lowest();
  std::vector<float> buffer(read ? static_cast<std::size_t>(raster.cols) : 0);
  for (std::int32_t y = 0; y < raster.rows; ++y) {
    if (read) read({{0, y}, raster.cols, 1}, buffer.data(), raster.cols);
    const float* const row = read ? buffer.data() : raster.row(y);
    for (std::int32_t x = 0; x < raster.cols; ++x) {
      // False where the sample is nodata.
      if (row[x] < rules.lowest) rules.lowest = row[x];
      if (row[x] > rules.highest) rules.highest = row[x];
    }
  }
}

/// One round after the other, on squares that are shifted against each other.
class Rounds {
 public:
  Rounds(const Raster& raster, Triangulation tin, VertexLattice lattice, const FitOptions& options)
      : raster_(raster),
        options_(options),
        rules_{freedom_of(raster, options), options.shape.value_or(ShapeRule{options.min_shape, options.aspect})},
        fitted_{std::move(tin), {}, std::move(lattice)},
        vertices_(fitted_.tin.vertex_count()),
        settled_(fitted_.tin.vertex_count(), 0),
        held_(fitted_.tin.vertex_count(), 0),
        scratch_(static_cast<std::size_t>(thread_count(options.threads))),
        windows_(scratch_.size()) {
    if (rules_.freedom == Freedom::kLattice) set_range(raster, options.read, rules_);
  }

  /// Of removal. `end`: the share of the whole that is then done. False if it was told to stop, as those below.
  bool run(const PatchGrid& grid, double end) {
    return work_on(grid, end, fitted_.lattice.steps,
                   [this](Patch& patch, const std::vector<Vertex>& vertices, const TriangleError& error) {
                     return remove(patch, vertices, error);
                   });
  }

  /// Of removal with repair; `only_held`: it begins with the vertices that repair has had on borders so far.
  bool repair(const PatchGrid& grid, double end, const RepairOptions& options, bool only_held = false) {
    const std::int32_t steps = rules_.freedom == Freedom::kLattice ? kLatticeSteps : fitted_.lattice.steps;
    return work_on(
        grid, end, steps, [&](Patch& patch, const std::vector<Vertex>& vertices, const TriangleError& error) {
          // One bound alone, and that beyond energies.
          if (!error.has_energy()) return FitCounts{};
          const std::vector<std::uint8_t> wanted = only_held ? near_held(patch, vertices) : std::vector<std::uint8_t>();
          RepairOptions here = options;
          here.wanted = wanted;
          const RepairCounts counts = repair_vertices(patch, error, here);
          return FitCounts{counts.removed, 0, counts.removed, counts.tried};
        });
  }

  /// What a round of repair is to do; `shake` as there.
  RepairOptions repair_options(int polishes, std::uint32_t shake) const {
    return {options_.depth.repair, rules_, shake, polishes, {}, options_.is_time_up};
  }

  /// What removal has had on borders it takes up itself.
  void forget_held() { held_.assign(held_.size(), 0); }

  const Triangulation& tin() const { return fitted_.tin; }

  bool is_time_up() const { return options_.is_time_up && options_.is_time_up(); }
  std::uint64_t vertices() const { return vertices_ - fitted_.counts.removed; }

  Fitted finish() {
    fitted_.is_cut_short = is_time_up();
    return std::move(fitted_);
  }

 private:
  /// Cuts, lets job(patch, vertices, error) count what it does to each patch, and joins, to a lattice of so many steps.
  template <class Job>
  bool work_on(const PatchGrid& grid, double end, std::int32_t steps, const Job& job) {
    const PatchCutter cutter(raster_, fitted_.tin, fitted_.lattice, grid, options_.free_sides, options_.threads);
    std::vector<Patch> patches(cutter.count());
    std::vector<std::vector<Vertex>> vertices(cutter.count());
    counts_.assign(cutter.count(), {});
    const auto one = [&](std::size_t i, std::size_t worker) {
      patches[i] = cutter.cut(i, scratch_[worker], vertices[i]);
      if (!is_time_up() && is_worked_on(patches[i]))
        counts_[i] = job(patches[i], vertices[i], errors_of(patches[i], windows_[worker]));
      patches[i].pack();
    };
    bool goes_on = true;
    parallel_in_order(cutter.count(), options_.threads, one, [&](std::size_t i) {
      add(counts_[i]);
      const double share = static_cast<double>(i + 1) / static_cast<double>(cutter.count());
      goes_on = tell(done_ + share * (end - done_));
      return goes_on;
    });
    if (!goes_on) return false;
    done_ = end;
    hold_borders(vertices);
    std::vector<Vertex> numbers;
    VertexLattice lattice{steps, {}, {}};
    Triangulation joined = cutter.join(std::move(patches), vertices, numbers, lattice);
    renumber(numbers, joined.vertex_count());
    fitted_.tin = std::move(joined);
    fitted_.lattice = std::move(lattice);
    return true;
  }

  bool is_worked_on(const Patch& patch) const {
    const Patch::Window& window = patch.window();
    return options_.most_window == 0 || std::int64_t{window.cols} * window.rows <= options_.most_window;
  }
  TriangleError errors_of(const Patch& patch, SampleWindow& window) const {
    if (options_.read) return window.errors(options_.read, options_.read_bounds, patch, options_.threshold);
    return window.errors(raster_, options_.bounds, options_.norm, patch, options_.threshold);
  }

  void add(const FitCounts& counts) {
    fitted_.counts.removed += counts.removed;
    fitted_.counts.searches += counts.searches;
    fitted_.counts.repaired += counts.repaired;
    fitted_.counts.tried += counts.tried;
  }
  bool tell(double share) const { return !options_.progress || options_.progress(share, vertices()); }

  /// A vertex that is free in one patch is in no other, so patches write to elements of their own.
  FitCounts remove(Patch& patch, const std::vector<Vertex>& vertices, const TriangleError& error) {
    std::vector<std::uint8_t> settled;
    settled.reserve(vertices.size());
    for (const Vertex v : vertices) settled.push_back(settled_[v]);
    const RemovalCounts counts = remove_vertices(patch, error, rules_.shape, options_.is_time_up, settled);
    for (Patch::Id v = 0; v < vertices.size(); ++v) {
      if (!patch.is_locked(v)) settled_[vertices[v]] = settled[v];
    }
    return {counts.removed, counts.searches, 0, 0};
  }

  /// Vertices of more than one patch were on a border.
  void hold_borders(const std::vector<std::vector<Vertex>>& vertices) {
    std::vector<bool> is_seen(held_.size(), false);
    for (const std::vector<Vertex>& of_patch : vertices) {
      for (const Vertex v : of_patch) {
        if (is_seen[v]) held_[v] = 1;
        is_seen[v] = true;
      }
    }
  }

  std::vector<std::uint8_t> near_held(const Patch& patch, const std::vector<Vertex>& vertices) const {
    std::vector<std::uint8_t> marks;
    marks.reserve(vertices.size());
    for (const Vertex v : vertices) marks.push_back(held_[v]);
    for (int i = 0; i < kBorderWidth; ++i) spread(patch, marks);
    return marks;
  }

  void renumber(const std::vector<Vertex>& numbers, std::size_t count) {
    for (std::vector<std::uint8_t>* of_vertices : {&settled_, &held_}) {
      std::vector<std::uint8_t> now(count);
      for (Vertex v = 0; v < numbers.size(); ++v) {
        if (numbers[v] != kNone) now[numbers[v]] = (*of_vertices)[v];
      }
      *of_vertices = std::move(now);
    }
  }

  const Raster& raster_;
  const FitOptions& options_;
  MoveRules rules_;
  Fitted fitted_;
  std::uint64_t vertices_;                     // of the mesh that was given
  double done_ = 0;                            // share of the whole
  std::vector<std::uint8_t> settled_;          // by vertex
  std::vector<std::uint8_t> held_;             // by vertex: it has been on a border between patches
  std::vector<PatchCutter::Scratch> scratch_;  // by thread
  std::vector<SampleWindow> windows_;
  std::vector<FitCounts> counts_;
};

}  // namespace

Result<Fitted> fit(const Raster& raster, Triangulation tin, VertexLattice lattice, const FitOptions& options) {
  const std::int32_t longest = std::max(raster.cols, raster.rows);
  const std::int32_t most = options.most_side > 0 ? std::min(options.most_side, longest) : longest;
  const bool is_cut = most < longest || (options.patch_side > 0 ? options.patch_side < longest : !is_small(tin));
  Rounds rounds(raster, std::move(tin), std::move(lattice), options);
  const auto side = [&] {
    if (!is_cut) return longest;
    return std::min(most, options.patch_side > 0 ? options.patch_side : patch_side(raster, rounds.tin()));
  };
  const int repairs = has_energies(options) ? options.depth.rounds : 0;
  // A round of repair takes some five times as long as removal, whose second round looks at little more than what the
  // borders of the first held back; so does the last one of repair.
  const double removal = 1.0 / (1 + 5 * repairs);
  const std::int32_t first_side = side();
  bool goes_on = rounds.run({first_side, 0}, is_cut ? 0.8 * removal : removal);
  if (goes_on && is_cut) goes_on = rounds.run({first_side, first_side / 2}, removal);
  rounds.forget_held();
  // As triangles become fewer, squares become larger.
  const auto grid = [&](int round) {
    const std::int32_t now = side();
    return PatchGrid{now, is_cut && round % 2 == 1 ? now / 2 : 0};
  };
  const bool has_last = is_cut && repairs > 0;
  const double whole = repairs + (has_last ? 0.2 : 0.0);
  for (int round = 0; goes_on && round < repairs; ++round) {
    const double end = removal + (1 - removal) * (round + 1) / whole;
    const int polishes = !has_last && round + 1 == repairs ? options.depth.polishes : 0;
    goes_on = rounds.repair(grid(round), end, rounds.repair_options(polishes, 0));
  }
  if (goes_on && has_last) {
    const std::int32_t now = side();
    goes_on = rounds.repair({now, now / 4}, 1, rounds.repair_options(options.depth.polishes, 0), true);
  }
  int poor = repairs > 0 && options.goes_on ? 0 : kPoorRounds;
  for (int round = repairs; goes_on && poor < kPoorRounds && !rounds.is_time_up(); ++round) {
    const std::uint64_t before = rounds.vertices();
    goes_on =
        rounds.repair(grid(round), 1, rounds.repair_options(options.depth.polishes, static_cast<std::uint32_t>(round)));
    const std::uint64_t gain = before - rounds.vertices();
    poor = static_cast<double>(gain) < kWorthARound * static_cast<double>(before) ? poor + 1 : 0;
  }
  if (!goes_on) return fail(ErrorKind::kCancelled, "cancelled while removing vertices");
  return rounds.finish();
}

}  // namespace scarp
