#include "lines/field_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "grid/affine_map.h"
#include "grid/height_range.h"
#include "grid/line_marks.h"
#include "grid/line_positions.h"
#include "grid/mask_samples.h"
#include "grid/sample_runs.h"
#include "scarp/lines.h"

namespace scarp {

namespace {

/// A vertex of a ring, on the map and in samples.
struct RingPoint {
  std::array<double, 3> on_map;
  std::array<double, 2> at;  ///< column, row
};

class RingClipper {
 public:
  RingClipper(const std::array<double, 6>& affine, std::int32_t cols, std::int32_t rows)
      : affine_(affine), to_samples_(affine), last_{cols - 1.0, rows - 1.0} {}

  Line clip(const Line& ring) {
    points_.clear();
    for (std::size_t k = 0; k + 1 < ring.points.size(); ++k) points_.push_back(place(ring.points[k]));
    const bool is_within = std::all_of(points_.begin(), points_.end(), [this](const RingPoint& p) {
      return p.at[0] >= 0 && p.at[1] >= 0 && p.at[0] <= last_[0] && p.at[1] <= last_[1];
    });
    Line clipped = ring;
    if (is_within) {
      for (auto& point : clipped.points) point[2] = std::numeric_limits<double>::quiet_NaN();
      return clipped;
    }
    for (const std::size_t axis : {0, 1}) {
      clip_at(axis, 0, 1);
      clip_at(axis, last_[axis], -1);
    }
    clipped.points.clear();
    for (const RingPoint& p : points_) {
      if (clipped.points.empty() || clipped.points.back() != p.on_map) clipped.points.push_back(p.on_map);
    }
    if (!clipped.points.empty()) clipped.points.push_back(clipped.points.front());
    return clipped;
  }

 private:
  RingPoint place(const std::array<double, 3>& point) const {
    const grid::SamplePosition at = to_samples_.position(point[0], point[1]);
    return {{point[0], point[1], std::numeric_limits<double>::quiet_NaN()}, {at.col, at.row}};
  }

  /// Clips at a line: keeps direction · (coordinate − limit) >= 0.
  void clip_at(std::size_t axis, double limit, double direction) {
    clipped_.clear();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const RingPoint &p = points_[k], &q = points_[k + 1 == points_.size() ? 0 : k + 1];
      const double from = direction * (p.at[axis] - limit), to = direction * (q.at[axis] - limit);
      if (from >= 0) clipped_.push_back(p);
      if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
        RingPoint between;
        between.at[axis] = limit;
        const std::size_t other = 1 - axis;
        between.at[other] = p.at[other] + from / (from - to) * (q.at[other] - p.at[other]);
        between.on_map = {affine_[0] + affine_[1] * between.at[0] + affine_[2] * between.at[1],
                          affine_[3] + affine_[4] * between.at[0] + affine_[5] * between.at[1],
                          std::numeric_limits<double>::quiet_NaN()};
        clipped_.push_back(between);
      }
    }
    std::swap(points_, clipped_);
  }

  std::array<double, 6> affine_;
  grid::MapToSamples to_samples_;
  std::array<double, 2> last_;
  std::vector<RingPoint> points_, clipped_;
};

class SourceWithin final : public SampleSource {
 public:
  SourceWithin(std::shared_ptr<const SampleSource> source, std::shared_ptr<const grid::SampleSet> within)
      : source_(std::move(source)), within_(std::move(within)) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    SCARP_RETURN_IF_ERROR(source_->read(col, row, cols, rows, out, stride));
    for (int y = 0; y < rows; ++y) grid::mask_beside(within_->row(row + y), col, col + cols, out + y * stride);
    return {};
  }
  bool is_in_memory() const override { return source_->is_in_memory(); }

 private:
  std::shared_ptr<const SampleSource> source_;
  std::shared_ptr<const grid::SampleSet> within_;
};

/// Counts heights within runs and outside, row by row from the top.
class OutsideCount {
 public:
  /// `samples`: the original samples of a row.
  void add(std::span<const grid::SampleRun> within, std::span<const float> samples) {
    here_.assign(samples.size(), 0);
    const HeightRange here = grid::range_of(samples);
    range_.add(here);
    std::uint64_t kept = 0;
    for (const grid::SampleRun& run : within) {
      for (auto col = static_cast<std::size_t>(run.begin); col < static_cast<std::size_t>(run.end); ++col)
        kept += here_[col] = std::isnan(samples[col]) ? 0 : 1;
    }
    for (std::size_t col = 0; col + 1 < above_.size() && !result_.has_surface; ++col)
      result_.has_surface = above_[col] + above_[col + 1] + here_[col] + here_[col + 1] >= 3;
    std::swap(above_, here_);
    result_.kept += kept;
    result_.lost += here.valid - kept;
  }
  const MaskedOutside& result() const { return result_; }
  const HeightRange& range() const { return range_; }

 private:
  MaskedOutside result_;
  std::vector<std::uint8_t> above_, here_;  // heights within, by column
  HeightRange range_;
};

}  // namespace

std::vector<Line> lines::clip_rings(const Cutline& cutline, std::int32_t cols, std::int32_t rows) {
  RingClipper clipper(cutline.affine, cols, rows);
  std::vector<Line> clipped;
  for (const Line& ring : cutline.rings) {
    Line within = clipper.clip(ring);
    if (within.points.size() >= 4) clipped.push_back(std::move(within));
  }
  return clipped;
}

Result<std::vector<Line>> close_rings(std::vector<Line> lines) {
  std::uint32_t polygons = 0;
  for (const Line& line : lines) {
    if (line.polygon != kNoPolygon) polygons = std::max(polygons, line.polygon + 1);
  }
  for (Line& line : lines) {
    if (line.is_ring()) continue;
    const auto &first = line.points.front(), &last = line.points.back();
    if (first[0] != last[0] || first[1] != last[1] || line.points.size() < 4)
      return fail(ErrorKind::kInput,
                  fmt::format("{} is an open line, which holds no surface: a cutline needs polygons or closed lines",
                              line.name));
    line.role = LineRole::kOuter;
    line.polygon = polygons++;
  }
  return lines;
}

Result<MaskedOutside> mask_outside(OwnedHeightField& field, const Cutline& cutline, const ProgressCallback& progress) {
  for (const Line& ring : cutline.rings) {
    SCARP_RETURN_IF_ERROR(grid::check_line_positions(ring.name, ring.points, cutline.affine));
  }
  grid::LineRuns runs(cutline.affine, field.cols, field.rows);
  runs.add_polygons(cutline.rings);
  const auto within = std::make_shared<const grid::SampleSet>(runs.runs(), field.rows);
  OutsideCount count;
  field.own();
  if (!field.source) {
    for (std::int32_t row = 0; row < field.rows; ++row) {
      float* samples = &field.samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols)];
      count.add(within->row(row), {samples, static_cast<std::size_t>(field.cols)});
      grid::mask_beside(within->row(row), 0, field.cols, samples);
    }
    return count.result();
  }
  std::vector<float> samples(static_cast<std::size_t>(field.cols));
  for (std::int32_t row = 0; row < field.rows; ++row) {
    constexpr std::int32_t kRowsTogether = 256;
    if (progress && row % kRowsTogether == 0 && !progress({"read", static_cast<double>(row) / field.rows, 0, 0}))
      return fail(ErrorKind::kCancelled, "cancelled while reading");
    SCARP_RETURN_IF_ERROR(field.source->read(0, row, field.cols, 1, samples.data(), field.cols));
    count.add(within->row(row), samples);
  }
  if (!field.info.has_range) grid::set_range(count.range(), field.info);
  field.source = std::make_shared<SourceWithin>(std::move(field.source), within);
  MaskedOutside result = count.result();
  result.bytes =
      sizeof(grid::SampleRun) * runs.runs().size() + sizeof(std::size_t) * static_cast<std::size_t>(field.rows);
  return result;
}

}  // namespace scarp
