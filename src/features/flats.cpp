#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/reporter.h"
#include "grid/bands.h"
#include "grid/outline.h"
#include "grid/sample_runs.h"
#include "lines/field_lines.h"
#include "scarp/features.h"

namespace scarp {
namespace {

/// An edge-connected area of samples of equal height, as seen so far.
struct Area {
  std::vector<grid::SampleRun> runs;  // unsorted
  std::uint64_t samples = 0;
  Point first;             // in raster order
  float height = 0;        // height of the first
  std::uint32_t root = 0;  // the area that it was merged into
  std::int32_t seen = 0;   // the last row that contains a part of it
};

/// Finds flat areas from the top down. Passes on complete areas that are large enough, and discards others.
class AreaSweep {
 public:
  explicit AreaSweep(std::uint64_t min_samples) : min_samples_(min_samples) {}

  /// Adds the next row; calls visit(area) for each large area that ends above it.
  template <class Visit>
  void add_row(const float* samples, std::int32_t cols, const Visit& visit) {
    pieces_.clear();
    std::size_t above = 0;
    for (std::int32_t x = 0; x < cols;) {
      const float height = samples[x];
      const std::int32_t begin = x++;
      if (std::isnan(height)) continue;
      while (x < cols && samples[x] == height) ++x;
      std::optional<std::uint32_t> area;
      while (above < above_.size() && above_[above].end <= begin) ++above;
      for (std::size_t i = above; i < above_.size() && above_[i].begin < x; ++i) {
        if (above_[i].height != height) continue;
        const std::uint32_t found = root_of(above_[i].area);
        area = area ? join(*area, found) : found;
      }
      if (!area) area = open({begin, row_}, height);
      areas_[*area].runs.push_back({row_, begin, x});
      areas_[*area].samples += static_cast<std::uint64_t>(x - begin);
      areas_[*area].seen = row_;
      ++runs_;
      pieces_.push_back({begin, x, *area, height});
    }
    end_row(visit);
  }

  /// Call it after the last row.
  template <class Visit>
  void finish(const Visit& visit) {
    pieces_.clear();
    end_row(visit);
  }

  /// Bytes in use, including areas that were passed on and their sorting.
  std::uint64_t bytes() const {
    constexpr std::uint64_t kGrowth = 2;
    return kGrowth * (sizeof(grid::SampleRun) * runs_ + sizeof(Piece) * (pieces_.size() + above_.size())) +
           (sizeof(Area) + kSmallRuns * sizeof(grid::SampleRun)) * areas_.size();
  }

 private:
  /// Samples [begin, end) of the current row.
  struct Piece {
    std::int32_t begin, end;
    std::uint32_t area;
    float height;
  };
  static constexpr std::size_t kSmallRuns = 8;

  std::uint32_t root_of(std::uint32_t area) {
    while (areas_[area].root != area) area = areas_[area].root = areas_[areas_[area].root].root;
    return area;
  }

  std::uint32_t open(Point first, float height) {
    if (free_.empty()) {
      free_.push_back(static_cast<std::uint32_t>(areas_.size()));
      areas_.emplace_back();
    }
    const std::uint32_t number = free_.back();
    free_.pop_back();
    Area& area = areas_[number];
    area.samples = 0;
    area.first = first;
    area.height = height;
    area.root = number;
    return number;
  }

  void release(std::uint32_t number) {
    std::vector<grid::SampleRun>& runs = areas_[number].runs;
    if (runs.capacity() > kSmallRuns) std::vector<grid::SampleRun>().swap(runs);
    runs.clear();
    free_.push_back(number);
  }

  /// Merges two areas; moves the shorter list of runs.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    if (areas_[a].runs.size() < areas_[b].runs.size()) std::swap(a, b);
    Area &stays = areas_[a], &goes = areas_[b];
    stays.runs.insert(stays.runs.end(), goes.runs.begin(), goes.runs.end());
    stays.samples += goes.samples;
    if (before(goes.first, stays.first)) {
      stays.first = goes.first;
      stays.height = goes.height;
    }
    goes.root = a;
    joined_.push_back(b);
    return a;
  }

  template <class Visit>
  void end_row(const Visit& visit) {
    for (Piece& piece : pieces_) piece.area = root_of(piece.area);
    for (const Piece& piece : above_) {
      const std::uint32_t number = root_of(piece.area);
      Area& area = areas_[number];
      // Several pieces may find the same area complete; the first one ends it.
      if (area.seen == row_ || area.samples == 0) continue;
      if (area.samples >= min_samples_) visit(area);
      runs_ -= area.runs.size();
      area.samples = 0;
      joined_.push_back(number);
    }
    // No piece refers to these areas now.
    for (const std::uint32_t number : joined_) release(number);
    joined_.clear();
    std::swap(above_, pieces_);
    ++row_;
  }

  std::uint64_t min_samples_;
  std::int32_t row_ = 0;
  std::vector<Area> areas_;
  std::vector<std::uint32_t> free_, joined_;  // areas without samples; areas that end with this row
  std::vector<Piece> pieces_, above_;         // pieces of this row and the previous one
  std::uint64_t runs_ = 0;
};

class Flats {
 public:
  Flats(const OwnedHeightField& field, const FlatOptions& options)
      : field_(field.view()),
        options_(options),
        memory_{options.run.memory.limit, options.run.memory.taken, 0},
        reporter_(options.run.progress) {}

  Result<std::vector<Lake>> find() {
    AreaSweep sweep(options_.min_samples);
    const auto add = [this](Area& area) { add_flat(area); };
    grid::RowReader reader(field_);
    for (std::int32_t y = 0; y < field_.rows; ++y) {
      SCARP_TRY(const auto& row, reader.read(y));
      sweep.add_row(row, field_.cols, add);
      const double share = (y + 1.0) / field_.rows;
      SCARP_RETURN_IF_ERROR(check_memory(sweep.bytes(), share));
      if (reporter_.due() && !reporter_.report("flats", share, 0, 0))
        return fail(ErrorKind::kCancelled, "cancelled while looking for flat areas");
    }
    sweep.finish(add);
    SCARP_RETURN_IF_ERROR(check_memory(0, 1));
    std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return before(a.first, b.first); });
    std::vector<Lake> lakes;
    for (auto& [first, lake] : found_) {
      for (Line& ring : lake.shore) ring.polygon = static_cast<std::uint32_t>(lakes.size());
      lakes.push_back(std::move(lake));
    }
    return lakes;
  }

 private:
  /// Shores need more memory than the search until the mesh contains them, unless the search discarded much.
  Result<void> check_memory(std::uint64_t bytes, double share) const {
    constexpr std::uint64_t kBytesPerVertex = 2 * sizeof(std::array<double, 3>);
    return memory_.check_part(std::max(bytes + kBytesPerVertex * vertices_, shore_bytes_), share,
                              "flat areas and their shores", "look for larger areas");
  }

  void add_flat(Area& area) {
    std::sort(area.runs.begin(), area.runs.end());
    Lake lake;
    lake.level = area.height;
    lake.name = fmt::format("flat at column {}, row {}", area.first.x, area.first.y);
    for (const std::vector<Point>& polygon : grid::trace_outline(area.runs)) {
      Line ring;
      ring.role = lake.shore.empty() ? LineRole::kOuter : LineRole::kHole;
      ring.name = lake.name;
      for (const Point p : polygon) ring.points.push_back(place_of(p, lake.level));
      ring.points.push_back(ring.points.front());
      vertices_ += ring.points.size();
      lake.shore.push_back(std::move(ring));
    }
    if (lake.shore.empty()) return;
    shore_bytes_ += lines::line_bytes(field_, lake.shore, options_.affine);
    found_.emplace_back(area.first, std::move(lake));
  }

  std::array<double, 3> place_of(Point p, double height) const {
    const auto& a = options_.affine;
    return {a[0] + p.x * a[1] + p.y * a[2], a[3] + p.x * a[4] + p.y * a[5], height};
  }

  HeightField field_;
  const FlatOptions& options_;
  MemoryBudget memory_;
  Reporter reporter_;
  std::vector<std::pair<Point, Lake>> found_;  // lakes with their first samples
  std::uint64_t vertices_ = 0, shore_bytes_ = 0;
};

}  // namespace

Result<std::vector<Lake>> find_flats(const OwnedHeightField& field, const FlatOptions& options) {
  if (options.min_samples < 3)
    return fail(ErrorKind::kUsage,
                fmt::format("a flat area has at least 3 samples, not {}: fewer have no area", options.min_samples));
  return Flats(field, options).find();
}

}  // namespace scarp
