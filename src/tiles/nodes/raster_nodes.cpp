// Heights of nodes from the samples of a raster.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "grid/window.h"
#include "scarp/tile.h"
#include "tiles/nodes/sample_rows.h"

namespace scarp {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
/// Places on the raster are multiples of 1 / kPlaceSteps of a cell, so that a node on a sample is exactly there.
constexpr double kPlaceSteps = 0x1p20;
/// Node steps between exact places on the raster.
constexpr int kAnchorSteps = 16;

/// A place along one axis of the raster, as the weights of the four samples around it.
struct Taps {
  std::int64_t first = 0;  ///< sample of weights[0]; the place lies between the second and third sample
  std::array<double, 4> weights{};
  double part = 0;  ///< position between these two, 0 … 1
};

Taps taps_at(double place) {
  const double rounded = std::floor(place * kPlaceSteps + 0.5) / kPlaceSteps, whole = std::floor(rounded);
  const double t = rounded - whole, tt = t * t, ttt = tt * t;
  return {static_cast<std::int64_t>(whole) - 1,
          {0.5 * (-t + 2 * tt - ttt), 0.5 * (2 - 5 * tt + 3 * ttt), 0.5 * (t + 4 * tt - 3 * ttt), 0.5 * (ttt - tt)},
          t};
}

/// A part of the raster; edge samples are repeated outside.
class Part {
 public:
  static Result<Part> read(const HeightField& field, std::int64_t col, std::int64_t row, int cols, int rows,
                           bool wraps) {
    Part part;
    part.cols_ = cols;
    part.samples_.resize(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
    const auto clamped = [](std::int64_t i, int count) { return std::clamp<std::int64_t>(i, 0, count - 1); };
    const std::int64_t first_row = clamped(row, field.rows), last_row = clamped(row + rows - 1, field.rows);
    const int height = static_cast<int>(last_row - first_row + 1);
    // Runs of columns that are contiguous in the raster.
    for (int k = 0; k < cols;) {
      const std::int64_t from = wraps ? wrap(col + k, field.cols) : clamped(col + k, field.cols);
      int count = 1;
      while (k + count < cols &&
             (wraps ? wrap(col + k + count, field.cols) : clamped(col + k + count, field.cols)) == from + count)
        ++count;
      std::vector<float> run(static_cast<std::size_t>(count) * static_cast<std::size_t>(height));
      SCARP_RETURN_IF_ERROR(grid::read_window(field, static_cast<int>(from), static_cast<int>(first_row), count, height,
                                              run.data(), count));
      for (int y = 0; y < rows; ++y) {
        const std::int64_t source_row = clamped(row + y, field.rows) - first_row;
        std::copy_n(run.data() + source_row * count, count, part.samples_.data() + std::ptrdiff_t{y} * cols + k);
      }
      k += count;
    }
    return part;
  }

  const float* row(std::int64_t y) const { return samples_.data() + y * cols_; }

 private:
  static std::int64_t wrap(std::int64_t col, int cols) { return ((col % cols) + cols) % cols; }

  std::vector<float> samples_;
  int cols_ = 0;
};

/// Bilinear interpolation of the valid ones of four samples; nodata if the nearest sample is.
float bilinear(const float* upper, const float* lower, double tx, double ty) {
  const std::array<float, 4> samples{upper[0], upper[1], lower[0], lower[1]};
  const std::array<double, 4> weights{(1 - tx) * (1 - ty), tx * (1 - ty), (1 - tx) * ty, tx * ty};
  const std::size_t nearest =
      static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  if (std::isnan(samples[nearest])) return kNone;
  double height = 0, weight = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::isnan(samples[k]) || weights[k] == 0) continue;
    height += weights[k] * double{samples[k]};
    weight += weights[k];
  }
  return static_cast<float>(height / weight);
}

class RasterNodes final : public NodeSource {
 public:
  RasterNodes(const HeightField& field, const RasterPlace& place) : field_(field), place_(place) {
    const std::array<double, 6>& a = place.affine;
    determinant_ = a[1] * a[5] - a[2] * a[4];
    if (place.from_degrees == nullptr && a[2] == 0 && a[4] == 0)
      turn_ = std::abs(std::abs(a[1]) * field.cols - 360) < 1e-6 * std::abs(a[1]);
  }

  bool has_inverse() const { return std::isfinite(determinant_) && determinant_ != 0; }

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    const bool is_aligned = place_.from_degrees == nullptr && place_.affine[2] == 0 && place_.affine[4] == 0;
    SCARP_RETURN_IF_ERROR(is_aligned ? read_aligned(window, out) : read_placed(window, out));
    return level_poles(window, out);
  }

  bool has_samples() const override { return place_.from_degrees == nullptr || place_.to_degrees != nullptr; }

  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    const tiles::SampleRows rows(field_, place_);
    if (place_.from_degrees != nullptr) return rows.visit_placed(box, visit);
    for (const double turn : {-720, -360, 0, 360, 720}) {
      SCARP_RETURN_IF_ERROR(rows.visit_in_degrees(box, turn, visit));
    }
    return {};
  }

 private:
  struct Axis {
    std::vector<Taps> taps;
    std::vector<bool> is_inside;
    std::int64_t first = 0, last = -1;  ///< samples needed by the taps of nodes inside

    void add(double place, int count, bool turns) {
      const bool inside = turns || (place >= -0.5 && place <= count - 0.5);
      taps.push_back(inside ? taps_at(place) : Taps{});
      is_inside.push_back(inside);
      if (!inside) return;
      first = last < first ? taps.back().first : std::min(first, taps.back().first);
      last = std::max(last, taps.back().first + 3);
    }
    bool is_empty() const { return last < first; }
    int count() const { return static_cast<int>(last - first + 1); }
  };

  /// Column of the raster at a longitude. Among the columns of all turns: the one on the raster, or the nearest one
  /// after its start.
  double column_of(double longitude_degrees) const {
    const double cell = place_.affine[1], turn = 360 / std::abs(cell);
    double place = (longitude_degrees - place_.affine[0]) / cell;
    return place - turn * std::floor((place + 0.5) / turn);
  }

  Result<void> read_aligned(const NodeWindow& window, std::span<float> out) const {
    Axis x, y;
    for (int i = 0; i < window.cols; ++i) x.add(column_of(window.longitude(window.col + i)), field_.cols, turn_);
    for (int j = 0; j < window.rows; ++j)
      y.add((window.latitude(window.row + j) - place_.affine[3]) / place_.affine[5], field_.rows, false);
    if (x.is_empty() || y.is_empty()) {
      std::fill(out.begin(), out.end(), kNone);
      return {};
    }
    if (x.count() > 2 * window.cols * std::max(1.0, spacing(window)) + 64) return read_in_halves(window, out);
    SCARP_TRY(auto&& part, Part::read(field_, x.first, y.first, x.count(), y.count(), turn_));
    // Interpolates along rows of samples, of which four are held, then across these to a row of nodes.
    std::array<std::vector<double>, 4> between;
    std::array<std::int64_t, 4> held{-1, -1, -1, -1};
    for (auto& one : between) one.resize(static_cast<std::size_t>(window.cols));
    for (int j = 0; j < window.rows; ++j) {
      float* nodes = out.data() + std::ptrdiff_t{j} * window.cols;
      if (!y.is_inside[static_cast<std::size_t>(j)]) {
        std::fill_n(nodes, window.cols, kNone);
        continue;
      }
      const Taps& down = y.taps[static_cast<std::size_t>(j)];
      std::array<const double*, 4> rows{};
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int64_t row = down.first + static_cast<std::int64_t>(k) - y.first;
        const auto slot = static_cast<std::size_t>(row & 3);
        if (held[slot] != row) {
          const float* samples = part.row(row);
          for (std::size_t i = 0; i < x.taps.size(); ++i) {
            if (!x.is_inside[i]) continue;
            const Taps& along = x.taps[i];
            const float* s = samples + (along.first - x.first);
            between[slot][i] = along.weights[0] * double{s[0]} + along.weights[1] * double{s[1]} +
                               along.weights[2] * double{s[2]} + along.weights[3] * double{s[3]};
          }
          held[slot] = row;
        }
        rows[k] = between[slot].data();
      }
      for (std::size_t i = 0; i < x.taps.size(); ++i) {
        if (!x.is_inside[i]) {
          nodes[i] = kNone;
          continue;
        }
        const double height = down.weights[0] * rows[0][i] + down.weights[1] * rows[1][i] +
                              down.weights[2] * rows[2][i] + down.weights[3] * rows[3][i];
        nodes[i] = static_cast<float>(height);
        if (std::isnan(height)) {
          const std::int64_t row = down.first + 1 - y.first, col = x.taps[i].first + 1 - x.first;
          nodes[i] = bilinear(part.row(row) + col, part.row(row + 1) + col, x.taps[i].part, down.part);
        }
      }
    }
    return {};
  }

  /// Samples per node step along a parallel.
  double spacing(const NodeWindow& window) const {
    return window.grid.largest_step(window.per_turn) / std::abs(place_.affine[1]);
  }

  /// Reads a window across the seam of a raster that spans the whole turn: its first and last columns.
  Result<void> read_in_halves(const NodeWindow& window, std::span<float> out) const {
    const int half = window.cols / 2;
    for (const auto& [first, count] : {std::pair{0, half}, std::pair{half, window.cols - half}}) {
      NodeWindow part = window;
      part.col += first;
      part.cols = count;
      std::vector<float> nodes(static_cast<std::size_t>(count) * static_cast<std::size_t>(window.rows));
      SCARP_RETURN_IF_ERROR(read_aligned(part, nodes));
      for (int j = 0; j < window.rows; ++j)
        std::copy_n(nodes.data() + std::ptrdiff_t{j} * count, count,
                    out.data() + std::ptrdiff_t{j} * window.cols + first);
    }
    return {};
  }

  struct At {
    double col = 0, row = 0;
  };

  At to_raster(double x, double y) const {
    const std::array<double, 6>& a = place_.affine;
    return {((x - a[0]) * a[5] - (y - a[3]) * a[2]) / determinant_,
            ((y - a[3]) * a[1] - (x - a[0]) * a[4]) / determinant_};
  }

  /// Places of nodes on the raster: exact in degrees, else interpolated between every 16th node of the globe.
  class Anchors {
   public:
    Anchors(const RasterNodes& nodes, const NodeWindow& window) : nodes_(nodes), window_(window) {
      const std::array<double, 6>& a = nodes.place_.affine;
      middle_ = a[0] + a[1] * nodes.field_.cols / 2 + a[2] * nodes.field_.rows / 2;
      if (nodes.place_.from_degrees == nullptr) return;
      first_x_ = before(window.col);
      first_y_ = before(window.row);
      across_ = static_cast<std::size_t>(before(window.col + window.cols - 1) + 2 - first_x_);
      const std::int64_t down = before(window.row + window.rows - 1) + 2 - first_y_;
      for (std::int64_t j = 0; j < down; ++j) {
        for (std::size_t i = 0; i < across_; ++i) {
          // Beyond a pole, where no node is, uses the pole's place.
          const std::int64_t row = std::min((first_y_ + j) * kAnchorSteps, window.last_row());
          xs_.push_back(window.longitude((first_x_ + static_cast<std::int64_t>(i)) * kAnchorSteps));
          ys_.push_back(window.latitude(row));
        }
      }
      nodes.place_.from_degrees->apply(xs_, ys_);
    }

    At at(int i, int j) const {
      const std::int64_t x = window_.col + i, y = window_.row + j;
      if (xs_.empty()) {
        const double degrees = window_.longitude(x);
        return nodes_.to_raster(degrees + 360 * std::floor((middle_ - degrees) / 360 + 0.5), window_.latitude(y));
      }
      const std::int64_t ax = before(x), ay = before(y);
      const double tx = static_cast<double>(x - ax * kAnchorSteps) / kAnchorSteps;
      const double ty = static_cast<double>(y - ay * kAnchorSteps) / kAnchorSteps;
      const std::size_t k = static_cast<std::size_t>(ay - first_y_) * across_ + static_cast<std::size_t>(ax - first_x_);
      const auto between = [&](const std::vector<double>& of) {
        const double upper = of[k] + (of[k + 1] - of[k]) * tx;
        const double lower = of[k + across_] + (of[k + across_ + 1] - of[k + across_]) * tx;
        return upper + (lower - upper) * ty;
      };
      return nodes_.to_raster(between(xs_), between(ys_));
    }

   private:
    /// The anchor at or before a node.
    static std::int64_t before(std::int64_t i) {
      return i >= 0 ? i / kAnchorSteps : -((-i + kAnchorSteps - 1) / kAnchorSteps);
    }

    const RasterNodes& nodes_;
    NodeWindow window_;
    double middle_ = 0;  ///< longitude of the raster's middle, for rasters in degrees
    std::int64_t first_x_ = 0, first_y_ = 0;
    std::size_t across_ = 0;
    std::vector<double> xs_, ys_;
  };

  Result<void> read_placed(const NodeWindow& window, std::span<float> out) const {
    const Anchors anchors(*this, window);
    const auto is_inside = [&](const At& place) {
      return place.col >= -0.5 && place.col <= field_.cols - 0.5 && place.row >= -0.5 && place.row <= field_.rows - 0.5;
    };
    std::int64_t left = field_.cols, top = field_.rows, right = -1, bottom = -1;
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) {
        const At place = anchors.at(i, j);
        if (!is_inside(place)) continue;
        const auto col = static_cast<std::int64_t>(std::floor(place.col)),
                   row = static_cast<std::int64_t>(std::floor(place.row));
        left = std::min(left, col - 1);
        top = std::min(top, row - 1);
        right = std::max(right, col + 3);
        bottom = std::max(bottom, row + 3);
      }
    }
    if (right < left) {
      std::fill(out.begin(), out.end(), kNone);
      return {};
    }
    SCARP_TRY(auto&& part, Part::read(field_, left, top, static_cast<int>(right - left + 1),
                                      static_cast<int>(bottom - top + 1), false));
    for (int j = 0; j < window.rows; ++j) {
      for (int i = 0; i < window.cols; ++i) {
        const At place = anchors.at(i, j);
        float& node =
            out[static_cast<std::size_t>(j) * static_cast<std::size_t>(window.cols) + static_cast<std::size_t>(i)];
        node = kNone;
        if (!is_inside(place)) continue;
        const Taps x = taps_at(place.col), y = taps_at(place.row);
        double height = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          const float* s = part.row(y.first + static_cast<std::int64_t>(k) - top) + (x.first - left);
          height += y.weights[k] * (x.weights[0] * double{s[0]} + x.weights[1] * double{s[1]} +
                                    x.weights[2] * double{s[2]} + x.weights[3] * double{s[3]});
        }
        node = static_cast<float>(height);
        if (std::isnan(height)) {
          const float* upper = part.row(y.first + 1 - top) + (x.first + 1 - left);
          const float* lower = part.row(y.first + 2 - top) + (x.first + 1 - left);
          node = bilinear(upper, lower, x.part, y.part);
        }
      }
    }
    return {};
  }

  /// A pole is one place: all its nodes have the height of its node at 180° W.
  Result<void> level_poles(const NodeWindow& window, std::span<float> out) const {
    for (int j = 0; j < window.rows; ++j) {
      const std::int64_t row = window.row + j;
      if (!window.is_pole(row)) continue;
      NodeWindow pole{window.per_turn, 0, row, 1, 1, window.grid};
      float height = kNone;
      const bool is_aligned = place_.from_degrees == nullptr && place_.affine[2] == 0 && place_.affine[4] == 0;
      SCARP_RETURN_IF_ERROR(is_aligned ? read_aligned(pole, {&height, 1}) : read_placed(pole, {&height, 1}));
      std::fill_n(out.begin() + std::ptrdiff_t{j} * window.cols, window.cols, height);
    }
    return {};
  }

  HeightField field_;
  RasterPlace place_;
  double determinant_ = 0;
  bool turn_ = false;  ///< the raster spans the whole turn: its last column is next to its first
};

}  // namespace

Result<std::unique_ptr<NodeSource>> make_node_source(const HeightField& field, const RasterPlace& place) {
  auto nodes = std::make_unique<RasterNodes>(field, place);
  if (!nodes->has_inverse())
    return fail(ErrorKind::kUsage, "the raster's place on the globe maps all samples to a line");
  return nodes;
}

}  // namespace scarp
