#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/memory_budget.h"
#include "base/reporter.h"
#include "grid/affine_map.h"
#include "grid/bands.h"
#include "grid/line_marks.h"
#include "grid/sources/lake_source.h"
#include "lines/breaklines.h"
#include "lines/field_lines.h"
#include "lines/line_samples.h"
#include "scarp/features.h"

namespace scarp {
namespace {

using Rings = std::span<const Line>;

/// Samples [col, col + cols) × [row, row + rows).
struct ShoreBox {
  int col = 0, row = 0, cols = 0, rows = 0;
  bool is_empty() const { return cols <= 0 || rows <= 0; }
};

class Shores {
 public:
  Shores(const HeightField& field, const WaterOptions& options)
      : field_(field), options_(options), to_samples_(options.affine) {}

  /// The rings of each polygon that is not entirely outside the raster.
  std::vector<Rings> find_polygons(std::span<const Line> lines) const {
    std::vector<Rings> polygons;
    for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
      end = first + 1;
      if (!lines[first].is_ring()) continue;
      while (end < lines.size() && lines[end].polygon == lines[first].polygon) ++end;
      const Rings rings = lines.subspan(first, end - first);
      if (!box_of(rings).is_empty()) polygons.push_back(rings);
    }
    return polygons;
  }

  Result<lines::LineSamples> read_samples(const std::vector<Rings>& polygons) const {
    if (field_.samples != nullptr) return lines::LineSamples(grid::Raster{field_.samples, field_.cols, field_.rows});
    std::vector<geom::Segment> courses;
    for (const Rings& rings : polygons) {
      SCARP_TRY(const auto& found, lines::find_courses(rings, options_.affine, field_.cols, field_.rows));
      courses.insert(courses.end(), found.begin(), found.end());
    }
    return lines::LineSamples::read(field_, courses);
  }

  /// The percentile of the surface along the rings; nothing if the surface has no valid point there.
  std::optional<double> level_of(Rings rings, const lines::LineSamples& samples) const {
    std::vector<float> heights;
    for (const Line& ring : rings) {
      for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) {
        const auto p = position_of(ring.points[k]), q = position_of(ring.points[k + 1]);
        const double length = std::max(std::abs(q.col - p.col), std::abs(q.row - p.row));
        constexpr double kMostLooks = 1 << 20;
        const auto looks = static_cast<int>(std::min(std::ceil(2 * length), kMostLooks)) + 1;
        for (int i = 0; i < looks; ++i) {
          const double at = static_cast<double>(i) / looks;
          const double height =
              lines::surface_at(samples, {p.col + at * (q.col - p.col), p.row + at * (q.row - p.row)});
          if (!std::isnan(height)) heights.push_back(static_cast<float>(height));
        }
      }
    }
    if (heights.empty()) return std::nullopt;
    const auto rank = static_cast<std::ptrdiff_t>(options_.percentile / 100 * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), heights.begin() + rank, heights.end());
    return double{heights[static_cast<std::size_t>(rank)]};
  }

  /// Calls visit(run) for the samples of a lake, in raster order.
  template <class Visit>
  void each_run(Rings rings, const Visit& visit) const {
    const ShoreBox box = box_of(rings);
    std::array<double, 6> affine = options_.affine;
    affine[0] += box.col * affine[1] + box.row * affine[2];
    affine[3] += box.col * affine[4] + box.row * affine[5];
    grid::LineRuns marks(affine, box.cols, box.rows);
    marks.add_polygons(rings);
    // Lines are rounded to the lattice; samples that the rounding moves into the lake belong to it.
    for (const Line& ring : rings) marks.add_course(ring, 1.0 / 128);
    for (const auto& [row, begin, end] : marks.runs())
      visit(grid::SampleRun{box.row + row, box.col + begin, box.col + end});
  }

 private:
  grid::SamplePosition position_of(const std::array<double, 3>& point) const {
    return to_samples_.position(point[0], point[1]);
  }

  /// Bounding box, plus one sample.
  ShoreBox box_of(Rings rings) const {
    double left = field_.cols, right = 0, top = field_.rows, bottom = 0;
    for (const Line& ring : rings) {
      for (const auto& point : ring.points) {
        const auto [col, row] = position_of(point);
        left = std::min(left, col);
        right = std::max(right, col);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    }
    const auto within = [](double place, int size) {
      return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(size)));
    };
    const int first_col = within(std::floor(left) - 1, field_.cols),
              first_row = within(std::floor(top) - 1, field_.rows);
    return {first_col, first_row, within(std::ceil(right) + 2, field_.cols) - first_col,
            within(std::ceil(bottom) + 2, field_.rows) - first_row};
  }

  HeightField field_;
  const WaterOptions& options_;
  grid::MapToSamples to_samples_;
};

struct LakeRun {
  std::uint32_t lake = 0;
  grid::SampleRun samples;
};

/// Sets the samples of lakes to their levels, row by row. Only lakes that contain a sample affect the sample, in their
/// order.
class Flattening {
 public:
  /// `runs`: by row, then by lake. `lakes` must have levels.
  Flattening(std::span<const LakeRun> runs, double freeboard, std::int32_t cols, std::vector<Lake>& lakes)
      : runs_(runs), lakes_(lakes), cols_(cols), water_(static_cast<std::size_t>(cols)), rim_(water_) {
    for (const Lake& lake : lakes) rims_.push_back(static_cast<float>(lake.level + freeboard));
  }

  /// The first row from this one on that lakes change; nothing if there is none.
  std::optional<std::int32_t> next_row(std::int32_t row) {
    while (above_ < runs_.size() && runs_[above_].samples.row < row - 1) ++above_;
    if (above_ == runs_.size()) return std::nullopt;
    return std::max(row, runs_[above_].samples.row - 1);
  }

  /// Changes a row. REQUIRES: next_row() returned it.
  void flatten(std::int32_t row, float* samples) {
    const auto end_of = [&](std::size_t from, std::int32_t at) {
      while (from < runs_.size() && runs_[from].samples.row <= at) ++from;
      return from;
    };
    const std::size_t here = end_of(above_, row - 1), below = end_of(here, row), end = end_of(below, row + 1);
    std::array<std::span<const LakeRun>, 3> rest{runs_.subspan(above_, here - above_),
                                                 runs_.subspan(here, below - here), runs_.subspan(below, end - below)};
    for (;;) {
      std::uint32_t lake = kNoLake;
      for (const auto& runs : rest) lake = runs.empty() ? lake : std::min(lake, runs.front().lake);
      if (lake == kNoLake) return;
      std::array<std::span<const LakeRun>, 3> its;
      for (std::size_t k = 0; k < 3; ++k) {
        std::size_t count = 0;
        while (count < rest[k].size() && rest[k][count].lake == lake) ++count;
        its[k] = rest[k].first(count);
        rest[k] = rest[k].subspan(count);
      }
      for (const LakeRun& run : its[1]) fill(run, samples);
      for (const auto& runs : its) {
        for (const LakeRun& run : runs) raise_around(run, samples);
      }
    }
  }

  /// The changes in the last flattened row, for a source.
  void take_runs(std::int32_t row, std::vector<grid::LevelRun>& runs) {
    const auto at = [](std::int32_t x) { return static_cast<std::size_t>(x); };
    for (std::int32_t x = first_; x < last_;) {
      const std::int32_t begin = x;
      const std::uint32_t water = water_[at(x)], rim = water != 0 ? 0 : rim_[at(x)];
      while (x < last_ && water_[at(x)] == water && (water != 0 || rim_[at(x)] == rim)) ++x;
      if (water == 0 && rim == 0) continue;
      Lake& lake = lakes_[std::max(water, rim) - 1];
      lake.bytes += sizeof(grid::LevelRun);
      const float height = water != 0 ? static_cast<float>(lake.level) : rims_[rim - 1];
      runs.push_back({{row, begin, x}, height, water == 0});
    }
  }

  /// Call it before the next row.
  void clear() {
    if (first_ < last_) {
      std::fill(water_.begin() + first_, water_.begin() + last_, 0);
      std::fill(rim_.begin() + first_, rim_.begin() + last_, 0);
    }
    first_ = cols_;
    last_ = 0;
  }

 private:
  static constexpr std::uint32_t kNoLake = 0xffffffff;

  void touch(std::int32_t begin, std::int32_t end) {
    first_ = std::min(first_, begin);
    last_ = std::max(last_, end);
  }

  void fill(const LakeRun& run, float* samples) {
    Lake& lake = lakes_[run.lake];
    const auto level = static_cast<float>(lake.level);
    touch(run.samples.begin, run.samples.end);
    for (std::int32_t x = run.samples.begin; x < run.samples.end; ++x) {
      water_[static_cast<std::size_t>(x)] = run.lake + 1;
      lake.samples += put(samples[x], level, lake);
    }
  }

  void raise_around(const LakeRun& run, float* samples) {
    Lake& lake = lakes_[run.lake];
    const float rim = rims_[run.lake];
    const std::int32_t begin = std::max(run.samples.begin - 1, 0), end = std::min(run.samples.end + 1, cols_);
    touch(begin, end);
    for (std::int32_t x = begin; x < end; ++x) {
      const auto i = static_cast<std::size_t>(x);
      if (water_[i] != 0) continue;
      if (rim_[i] == 0 || rims_[rim_[i] - 1] < rim) rim_[i] = run.lake + 1;
      if (samples[x] < rim) lake.raised += put(samples[x], rim, lake);
    }
  }

  /// Returns 1 if the sample is a height and changed.
  static std::uint64_t put(float& sample, float height, Lake& lake) {
    if (std::isnan(sample) || sample == height) return 0;
    lake.largest_change = std::max(lake.largest_change, std::abs(double{sample} - double{height}));
    sample = height;
    return 1;
  }

  std::span<const LakeRun> runs_;
  std::vector<Lake>& lakes_;
  std::int32_t cols_;
  std::vector<float> rims_;                 // rims of the lakes
  std::vector<std::uint32_t> water_, rim_;  // by column: 1 + the last lake that contains the sample; 1 + the lake with
                                            // the highest rim there
  std::int32_t first_ = 0, last_ = 0;       // range of changed columns
  std::size_t above_ = 0;                   // the first run still relevant
};

Result<void> check_options(const WaterOptions& options) {
  if (!(options.percentile >= 0 && options.percentile <= 100))
    return fail(ErrorKind::kUsage,
                fmt::format("the percentile of a shore must lie in 0 … 100, not {}", options.percentile));
  if (!(options.freeboard > 0 && std::isfinite(options.freeboard)))
    return fail(ErrorKind::kUsage, fmt::format("the freeboard must be above 0, not {}", options.freeboard));
  return {};
}

/// By row, then by lake; runs of a lake are in raster order.
std::vector<LakeRun> find_runs(const Shores& shores, const std::vector<Rings>& rings) {
  std::vector<LakeRun> runs;
  for (std::uint32_t lake = 0; lake < rings.size(); ++lake)
    shores.each_run(rings[lake], [&](const grid::SampleRun& samples) { runs.push_back({lake, samples}); });
  std::sort(runs.begin(), runs.end(), [](const LakeRun& a, const LakeRun& b) {
    return std::tuple(a.samples.row, a.lake, a.samples.begin) < std::tuple(b.samples.row, b.lake, b.samples.begin);
  });
  return runs;
}

/// Changes the samples, or their source.
Result<void> flatten_field(std::span<const LakeRun> runs, const WaterOptions& options, std::vector<Lake>& lakes,
                           OwnedHeightField& field) {
  Flattening flattening(runs, options.freeboard, field.cols, lakes);
  Reporter reporter(options.run.progress);
  std::optional<grid::RowReader> reader;
  std::vector<grid::LevelRun> levels;
  if (field.source) reader.emplace(field.view());
  field.own();
  for (auto row = flattening.next_row(0); row && *row < field.rows; row = flattening.next_row(*row + 1)) {
    if (reporter.due() && !reporter.report("water", static_cast<double>(*row) / field.rows, 0, 0))
      return fail(ErrorKind::kCancelled, "cancelled while making lakes flat");
    if (!reader) {
      flattening.flatten(*row, field.samples.data() + std::ptrdiff_t{*row} * field.cols);
    } else {
      SCARP_TRY(const auto& samples, reader->read(*row));
      flattening.flatten(*row, samples);
      flattening.take_runs(*row, levels);
    }
    flattening.clear();
  }
  if (!levels.empty()) field.source = grid::level_source(std::move(field.source), std::move(levels));
  return {};
}

struct LakesFound {
  std::vector<Lake> lakes;
  std::vector<Rings> rings;
};

/// Lakes with a level. All levels are computed before any change, since shores come from the original raster.
Result<LakesFound> find_levels(const Shores& shores, const std::vector<Rings>& polygons) {
  SCARP_TRY(const auto& samples, shores.read_samples(polygons));
  LakesFound found;
  for (const Rings& rings : polygons) {
    const auto level = shores.level_of(rings, samples);
    if (!level) continue;
    Lake lake;
    lake.name = rings.front().name;
    lake.level = *level;
    lake.shore.assign(rings.begin(), rings.end());
    for (Line& ring : lake.shore) {
      for (auto& point : ring.points) point[2] = lake.level;
    }
    found.lakes.push_back(std::move(lake));
    found.rings.push_back(rings);
  }
  return found;
}

}  // namespace

Result<std::vector<Lake>> find_lakes(const HeightField& field, std::span<const Line> lines,
                                     const WaterOptions& options) {
  SCARP_RETURN_IF_ERROR(check_options(options));
  const Shores shores(field, options);
  SCARP_TRY(auto&& found, find_levels(shores, shores.find_polygons(lines)));
  return std::move(found.lakes);
}

Result<std::vector<Lake>> flatten_lakes(OwnedHeightField& field, std::span<const Line> lines,
                                        const WaterOptions& options) {
  SCARP_RETURN_IF_ERROR(check_options(options));
  const Shores shores(field, options);
  const std::vector<Rings> polygons = shores.find_polygons(lines);
  std::uint64_t bytes = 0;
  for (const Rings& rings : polygons) bytes += lines::line_bytes(field, rings, options.affine);
  const MemoryBudget memory{options.run.memory.limit, options.run.memory.taken, 0};
  SCARP_RETURN_IF_ERROR(memory.check_start(bytes));
  SCARP_TRY(auto&& found, find_levels(shores, polygons));
  SCARP_RETURN_IF_ERROR(flatten_field(find_runs(shores, found.rings), options, found.lakes, field));
  return std::move(found.lakes);
}

}  // namespace scarp
