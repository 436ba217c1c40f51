// Raises nodes from heights above the sea to heights above the ellipsoid.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "globe/row_range.h"
#include "scarp/tile.h"

namespace scarp {
namespace {

/// Distance of places with exact zeros, between which the geoid is linear to less than a centimetre.
constexpr double kAnchorDegrees = 1.0 / 32;
/// Side of a box whose samples are raised at once.
constexpr double kMostDegrees = 8;

class RaisedNodes final : public NodeSource {
 public:
  RaisedNodes(const NodeSource& source, std::shared_ptr<const HeightZero> zero)
      : source_(source), zero_(std::move(zero)) {}

  Result<void> read(const NodeWindow& window, std::span<float> out) const override {
    SCARP_RETURN_IF_ERROR(source_.read(window, out));
    std::int64_t step = 1;
    while (window.grid.largest_step(window.per_turn) * static_cast<double>(2 * step) <= kAnchorDegrees) step *= 2;
    const auto before = [&](std::int64_t i) { return i >= 0 ? i / step : -((-i + step - 1) / step); };
    const std::int64_t first_x = before(window.col), first_y = before(window.row);
    const std::int64_t across = before(window.col + window.cols - 1) + 2 - first_x;
    const std::int64_t down = before(window.row + window.rows - 1) + 2 - first_y;
    std::vector<double> xs, ys;
    for (std::int64_t j = 0; j < down; ++j) {
      for (std::int64_t i = 0; i < across; ++i) {
        const std::int64_t row = std::min((first_y + j) * step, window.last_row());
        // A pole is one place at all longitudes.
        xs.push_back(window.longitude(window.is_pole(row) ? 0 : (first_x + i) * step));
        ys.push_back(window.latitude(row));
      }
    }
    std::vector<double> zeros(xs.size());
    zero_->find(xs, ys, zeros);
    for (std::int64_t j = 0; j < window.rows; ++j) {
      const std::int64_t row = window.row + j, ay = before(row);
      const double ty = static_cast<double>(row - ay * step) / static_cast<double>(step);
      for (std::int64_t i = 0; i < window.cols; ++i) {
        const std::int64_t col = window.col + i, ax = before(col);
        const double tx = static_cast<double>(col - ax * step) / static_cast<double>(step);
        const double* at = zeros.data() + (ay - first_y) * across + (ax - first_x);
        const double upper = at[0] + (at[1] - at[0]) * tx, lower = at[across] + (at[across + 1] - at[across]) * tx;
        float& height = out[static_cast<std::size_t>(j * window.cols + i)];
        if (std::isnan(height)) continue;
        height = static_cast<float>(double{height} + upper + (lower - upper) * ty);
        if (!std::isnan(height)) continue;
        return fail(ErrorKind::kInput,
                    fmt::format("nothing is known of the zero of heights at longitude {:.4f}, latitude {:.4f}",
                                window.longitude(col), window.latitude(row)));
      }
    }
    return {};
  }

  bool has_samples() const override { return source_.has_samples(); }

  Result<void> visit_samples(const DegreeBox& box, const SampleVisitor& visit) const override {
    // Reads a large box in parts to limit the number of exact zeros.
    if (box.east - box.west > kMostDegrees || box.north - box.south > kMostDegrees) {
      const double x = (box.west + box.east) / 2, y = (box.south + box.north) / 2;
      for (const DegreeBox& part : {DegreeBox{box.west, box.south, x, y}, DegreeBox{x, box.south, box.east, y},
                                    DegreeBox{box.west, y, x, box.north}, DegreeBox{x, y, box.east, box.north}}) {
        SCARP_RETURN_IF_ERROR(visit_samples(part, visit));
      }
      return {};
    }
    std::optional<ZeroGrid> zeros;  // zeros of the current part of the earth
    std::vector<float> raised;
    return source_.visit_samples(box, [&](const SampleRow& row) {
      const auto [first, end] = globe::range_within(row.longitude, row.step_longitude, row.latitude, row.step_latitude,
                                                    row.heights.size(), box);
      if (first >= end) return;
      SampleRow part = row;
      part.longitude += row.step_longitude * static_cast<double>(first);
      part.latitude += row.step_latitude * static_cast<double>(first);
      part.heights = row.heights.subspan(first, end - first);
      if (!zeros) zeros.emplace(box, *zero_);
      zeros->raise(part, raised);
      part.heights = raised;
      visit(part);
    });
  }

 private:
  /// Zeros over a box: bilinear between exact ones.
  class ZeroGrid {
   public:
    ZeroGrid(const DegreeBox& box, const HeightZero& zero)
        : west_(box.west), north_(box.north), across_(cells(box.east - box.west)), down_(cells(box.north - box.south)) {
      per_x_ = static_cast<double>(across_) / (box.east - box.west);
      per_y_ = static_cast<double>(down_) / (box.north - box.south);
      std::vector<double> xs, ys;
      for (std::size_t j = 0; j <= down_; ++j) {
        for (std::size_t i = 0; i <= across_; ++i) {
          xs.push_back(west_ + static_cast<double>(i) / per_x_);
          ys.push_back(north_ - static_cast<double>(j) / per_y_);
        }
      }
      zeros_.resize(xs.size());
      zero.find(xs, ys, zeros_);
    }

    void raise(const SampleRow& row, std::vector<float>& raised) const {
      raised.resize(row.heights.size());
      for (std::size_t k = 0; k < raised.size(); ++k) {
        const double x = (row.longitude + row.step_longitude * static_cast<double>(k) - west_) * per_x_;
        const double y = (north_ - row.latitude - row.step_latitude * static_cast<double>(k)) * per_y_;
        const std::size_t i = before(x, across_), j = before(y, down_);
        const double* const at = &zeros_[j * (across_ + 1) + i];
        const double tx = x - static_cast<double>(i), ty = y - static_cast<double>(j);
        const double upper = at[0] + (at[1] - at[0]) * tx;
        const double lower = at[across_ + 1] + (at[across_ + 2] - at[across_ + 1]) * tx;
        raised[k] = static_cast<float>(double{row.heights[k]} + upper + (lower - upper) * ty);
      }
    }

   private:
    static std::size_t cells(double degrees) {
      return static_cast<std::size_t>(std::max(1.0, std::ceil(degrees / kAnchorDegrees)));
    }
    static std::size_t before(double place, std::size_t count) {
      return std::min(static_cast<std::size_t>(std::max(place, 0.0)), count - 1);
    }

    double west_, north_;
    std::size_t across_, down_;
    double per_x_ = 0, per_y_ = 0;
    std::vector<double> zeros_;
  };

  const NodeSource& source_;
  std::shared_ptr<const HeightZero> zero_;
};

}  // namespace

std::unique_ptr<NodeSource> make_raised_source(const NodeSource& source, std::shared_ptr<const HeightZero> zero) {
  return std::make_unique<RaisedNodes>(source, std::move(zero));
}

}  // namespace scarp
